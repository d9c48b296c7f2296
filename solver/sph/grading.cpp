#include "solver/sph/grading.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::sph {

namespace {

// Of the lattice over the section, both as shares of the rear's: where the rear has six
// particles across its radius, a head or the tip of a cone has 3.4.
constexpr double widening = 1.75;
// Of the radius, by which the lattice widens in a cone.
constexpr double cone_power = 0.75;
constexpr double rim_slope = 0.3;  // of a column at the rim, above a step
constexpr int samples = 400;       // of a stretch, for its length

}  // namespace

Grading::Grading(const specimen::Shape& shape) : shape_(shape) {
    double below = wanted(shape.station_radius.front());
    for (std::size_t s = 0; s + 1 < shape.station_height.size(); ++s) {
        lowest_share_.push_back(below);
        const double rise = shape.station_height[s + 1] - shape.station_height[s];
        auto& sums = stretched_.emplace_back(1, 0.0);
        for (int i = 0; i < samples; ++i) {
            const double middle = shape.station_height[s] + rise * (i + 0.5) / samples;
            sums.push_back(sums.back() + rise / samples / share(s, middle));
        }
        if (rise > 0) below = share(s, shape.station_height[s + 1]);
    }
}

double Grading::share(std::size_t lower, double height) const {
    const double bottom = shape_.station_height[lower],
                 top = shape_.station_height[lower + 1];
    const double r0 = shape_.station_radius[lower], r1 = shape_.station_radius[lower + 1];
    if (r0 != r1) {
        const double radius = std::lerp(r0, r1, (height - bottom) / (top - bottom));
        return std::min(1.0, wanted(r0) * std::pow(radius / r0, cone_power));
    }
    return std::min(wanted(r0),
                    lowest_share_[lower] * std::exp(rim_slope * (height - bottom) / r0));
}

double Grading::wanted(double radius) const {
    return std::min(1.0, widening * radius / shape_.rear_radius());
}

double Grading::stretched_length(std::size_t lower) const {
    return stretched_[lower].back();
}

double Grading::height_at(std::size_t lower, double stretched) const {
    const std::vector<double>& sums = stretched_[lower];
    const auto above = std::upper_bound(sums.begin() + 1, sums.end() - 1, stretched);
    const auto cell = static_cast<double>(above - sums.begin() - 1);
    const double part = (stretched - *(above - 1)) / (*above - *(above - 1));
    return std::lerp(shape_.station_height[lower], shape_.station_height[lower + 1],
                     (cell + part) / samples);
}

}  // namespace taylorcal::sph
