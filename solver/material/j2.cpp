#include "solver/material/j2.hpp"

#include "solver/material/hypoelastic.hpp"

namespace taylorcal::material {

namespace {

struct J2Rule {
    double yield;      // Y0 [Pa]
    double hardening;  // H [Pa]

    template <class V>
    V plastic_increment(const YieldQuestion<V>& question) const {
        const V excess =
            question.trial_stress - yield - hardening * question.plastic_strain;
        const V increment = excess / (3 * question.shear_modulus + hardening);
        return lane_select(excess > 0, increment, V{});
    }
    double yield_stress(double plastic_strain) const {
        return yield + hardening * plastic_strain;
    }
};

}  // namespace

template <class Real>
std::unique_ptr<Strength<Real>> make_j2(const Parameters& parameters,
                                        std::size_t grains) {
    return make_hypoelastic<Real>(
        J2Rule{parameters.j2_yield_stress, parameters.j2_hardening_modulus}, grains);
}

template std::unique_ptr<Strength<float>> make_j2(const Parameters&, std::size_t);
template std::unique_ptr<Strength<double>> make_j2(const Parameters&, std::size_t);

}  // namespace taylorcal::material
