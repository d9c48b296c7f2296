#include "solver/material/dislocation_strength.hpp"
#include "solver/material/elastic.hpp"
#include "solver/material/j2.hpp"
#include "solver/material/johnson_cook.hpp"
#include "solver/material/strength.hpp"

namespace taylorcal::material {

template <class Real>
std::unique_ptr<Strength<Real>> make_strength(
    const Parameters& parameters, const std::vector<Eigen::Quaterniond>& orientations) {
    switch (parameters.strength) {
        case StrengthModel::elastic:
            return make_elastic<Real>(parameters, orientations.size());
        case StrengthModel::j2:
            return make_j2<Real>(parameters, orientations.size());
        case StrengthModel::johnson_cook:
            return make_johnson_cook<Real>(parameters, orientations.size());
        case StrengthModel::dislocation:
            break;
    }
    return make_dislocation_strength<Real>(parameters, orientations);
}

template std::unique_ptr<Strength<float>> make_strength(
    const Parameters&, const std::vector<Eigen::Quaterniond>&);
template std::unique_ptr<Strength<double>> make_strength(
    const Parameters&, const std::vector<Eigen::Quaterniond>&);

}  // namespace taylorcal::material
