#include "solver/material/elastic.hpp"

#include "solver/material/hypoelastic.hpp"

#include <limits>

namespace taylorcal::material {

namespace {

template <class Real>
class Elastic final : public HypoelasticStrength<Real> {
  public:
    using HypoelasticStrength<Real>::HypoelasticStrength;

  protected:
    Lanes<Real> plastic_increment(const YieldQuestion<Real>&) const override {
        return Lanes<Real>{};
    }
    double yield_stress(double) const override {
        return std::numeric_limits<double>::infinity();
    }
};

}  // namespace

template <class Real>
std::unique_ptr<Strength<Real>> make_elastic(const Parameters&, std::size_t grains) {
    return std::make_unique<Elastic<Real>>(grains);
}

template std::unique_ptr<Strength<float>> make_elastic(const Parameters&, std::size_t);
template std::unique_ptr<Strength<double>> make_elastic(const Parameters&, std::size_t);

}  // namespace taylorcal::material
