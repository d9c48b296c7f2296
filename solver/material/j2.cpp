#include "solver/material/j2.hpp"

#include "solver/material/hypoelastic.hpp"

namespace taylorcal::material {

namespace {

template <class Real>
class J2 final : public HypoelasticStrength<Real> {
  public:
    J2(const Parameters& parameters, std::size_t grains)
        : HypoelasticStrength<Real>(grains),
          yield_(static_cast<Real>(parameters.j2_yield_stress)),
          hardening_(static_cast<Real>(parameters.j2_hardening_modulus)) {}

  protected:
    Lanes<Real> plastic_increment(const YieldQuestion<Real>& question) const override {
        const Lanes<Real> excess =
            question.trial_stress - yield_ - hardening_ * question.plastic_strain;
        const Lanes<Real> increment = excess / (3 * question.shear_modulus + hardening_);
        return excess > 0 ? increment : Lanes<Real>{};
    }
    double yield_stress(double plastic_strain) const override {
        return static_cast<double>(yield_) +
               static_cast<double>(hardening_) * plastic_strain;
    }

  private:
    Real yield_;      // Y0 [Pa]
    Real hardening_;  // H [Pa]
};

}  // namespace

template <class Real>
std::unique_ptr<Strength<Real>> make_j2(const Parameters& parameters,
                                        std::size_t grains) {
    return std::make_unique<J2<Real>>(parameters, grains);
}

template std::unique_ptr<Strength<float>> make_j2(const Parameters&, std::size_t);
template std::unique_ptr<Strength<double>> make_j2(const Parameters&, std::size_t);

}  // namespace taylorcal::material
