#include "solver/material/elastic.hpp"

#include "solver/material/hypoelastic.hpp"

#include <limits>

namespace taylorcal::material {

namespace {

struct ElasticRule {
    template <class V>
    V plastic_increment(const YieldQuestion<V>&) const {
        return V{};
    }
    double yield_stress(double) const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace

template <class Real>
std::unique_ptr<Strength<Real>> make_elastic(const Parameters&, std::size_t grains) {
    return make_hypoelastic<Real>(ElasticRule{}, grains);
}

template std::unique_ptr<Strength<float>> make_elastic(const Parameters&, std::size_t);
template std::unique_ptr<Strength<double>> make_elastic(const Parameters&, std::size_t);

}  // namespace taylorcal::material
