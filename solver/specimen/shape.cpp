#include "solver/specimen/shape.hpp"

#include "common/errors.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace taylorcal::specimen {

double Shape::radius_at(double height) const {
    const auto above =
        std::upper_bound(station_height.begin(), station_height.end(), height);
    if (above == station_height.begin()) return station_radius.front();
    if (above == station_height.end()) return station_radius.back();
    const auto upper = static_cast<std::size_t>(above - station_height.begin());
    const std::size_t lower = upper - 1;
    const double share = (height - station_height[lower]) /
                         (station_height[upper] - station_height[lower]);
    return station_radius[lower] +
           share * (station_radius[upper] - station_radius[lower]);
}

Shape make_shape(const Profile& profile, double diameter, double length) {
    require(
        diameter > 0 && length > 0,
        fmt::format("specimen of diameter {} m and length {} m (both must be positive)",
                    diameter, length));
    const double rear = diameter / 2;
    const double end = profile.end_radius * rear;
    const double head = profile.head_length * length;
    switch (profile.kind) {
        case ProfileKind::stepped:
            return {profile, {0, head, head, length}, {end, end, rear, rear}, head};
        case ProfileKind::tapered:
            return {profile, {0, head, length}, {end, rear, rear}, head};
        case ProfileKind::cylinder:
            break;
    }
    return {profile, {0, length}, {rear, rear}, head};
}

}  // namespace taylorcal::specimen
