#include "solver/material/johnson_cook.hpp"

#include "solver/material/hypoelastic.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::material {

namespace {

class JohnsonCookRule {
  public:
    explicit JohnsonCookRule(const Parameters& parameters) : p_(parameters) {}

    template <class V>
    V plastic_increment(const YieldQuestion<V>& question) const {
        V increment;
        for (std::size_t k = 0; k < lane_count<typename V::Lane>; ++k) {
            increment[k] = static_cast<typename V::Lane>(lane_increment(
                static_cast<double>(question.trial_stress[k]),
                static_cast<double>(question.plastic_strain[k]),
                thermal_factor(static_cast<double>(question.temperature[k])),
                3 * static_cast<double>(question.shear_modulus[k]),
                static_cast<double>(question.time_step)));
        }
        return increment;
    }
    double yield_stress(double plastic_strain) const {
        return p_.jc_a + p_.jc_b * std::pow(plastic_strain, p_.jc_n);
    }

  private:
    double thermal_factor(double temperature) const {
        const double homologous =
            std::clamp((temperature - p_.reference_temperature) /
                           (p_.jc_melting_temperature - p_.reference_temperature),
                       0.0, 1.0);
        return 1 - std::pow(homologous, p_.jc_m);
    }

    /// Root of trial - 3G x = Y(strain + x, x/dt) in [0, trial/3G]: the left side falls
    /// and the right one grows, so that the root is bracketed from the start.
    double lane_increment(double trial, double strain, double softening, double modulus,
                          double dt) const {
        const auto excess = [&](double x) {
            const double rate_factor = 1 + p_.jc_c * std::log(std::max(x / dt, 1.0));
            return trial - modulus * x -
                   yield_stress(strain + x) * rate_factor * softening;
        };
        double low = 0, high = trial / modulus;
        double at_low = excess(low), at_high = excess(high);
        if (!(at_low > 0)) return 0;
        double x = low;
        // False position; halving the kept end's value (Illinois) keeps both ends moving.
        for (int i = 0; i < 60 && high - low > 1e-9 * high; ++i) {
            x = (low * at_high - high * at_low) / (at_high - at_low);
            const double at_x = excess(x);
            if (std::abs(at_x) < 1e-7 * trial) break;
            if (at_x > 0) {
                low = x, at_low = at_x, at_high /= 2;
            } else {
                high = x, at_high = at_x, at_low /= 2;
            }
        }
        return x;
    }

    Parameters p_;
};

}  // namespace

template <class Real>
std::unique_ptr<Strength<Real>> make_johnson_cook(const Parameters& parameters,
                                                  std::size_t grains) {
    return make_hypoelastic<Real>(JohnsonCookRule(parameters), grains);
}

template std::unique_ptr<Strength<float>> make_johnson_cook(const Parameters&,
                                                            std::size_t);
template std::unique_ptr<Strength<double>> make_johnson_cook(const Parameters&,
                                                             std::size_t);

}  // namespace taylorcal::material
