#include "calibrate/diagnosis/candidate.hpp"

#include "calibrate/diagnosis/tail_probability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace taylorcal::calibrate {

double AmplitudePrior::log_density(double amplitude) const {
    constexpr double impossible = -std::numeric_limits<double>::infinity();
    const double z = amplitude / scale;
    const double normal =
        -0.5 * z * z - std::log(scale * std::sqrt(2 * std::numbers::pi));
    switch (kind) {
        case Kind::normal:
            return normal;
        case Kind::half_normal:
            return amplitude < 0 ? impossible : normal + std::numbers::ln2;
        case Kind::uniform:
            return std::abs(z) <= 1 ? -std::log(scale) : impossible;
    }
    return impossible;
}

double AmplitudePrior::mass(double lower, double upper) const {
    const auto between = [&](double low, double high) {
        return normal_tail(low / scale) - normal_tail(high / scale);
    };
    switch (kind) {
        case Kind::normal:
            return between(lower, upper);
        case Kind::half_normal:
            return upper > 0 ? 2 * between(std::max(lower, 0.0), upper) : 0;
        case Kind::uniform:
            return std::max(std::min(upper, scale) - std::max(lower, -scale), 0.0) /
                   scale;
    }
    return 0;
}

double Candidate::typical() const {
    const double up = std::min(prior.scale, upper());
    const double down = std::max(-prior.scale, lower());
    return up >= -down ? up : down;
}

}  // namespace taylorcal::calibrate
