#include "calibrate/sampling/parameter_space.hpp"

#include "calibrate/sampling/truncated_normal.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::calibrate {
namespace {

TruncatedNormal normal_prior(const Parameter& parameter) {
    return {*parameter.normal_scale, parameter.lower, parameter.upper};
}

}  // namespace

double place_in_range(const Parameter& parameter, double value) {
    if (!parameter.log_uniform)
        return (value - parameter.lower) / (parameter.upper - parameter.lower);
    return std::log(value / parameter.lower) /
           std::log(parameter.upper / parameter.lower);
}

ParameterSpace::ParameterSpace(std::vector<Parameter> parameters,
                               std::vector<std::string> lots)
    : parameters_(std::move(parameters)), lots_(std::move(lots)) {
    for (std::size_t j = 0; j < parameters_.size(); ++j)
        (parameters_[j].per_lot ? per_lot_ : shared_).push_back(j);
}

std::vector<std::string> ParameterSpace::names() const {
    std::vector<std::string> all;
    for (const std::size_t j : shared_) all.push_back(parameters_[j].name);
    for (const std::string& lot : lots_)
        for (const std::size_t j : per_lot_)
            all.push_back(parameters_[j].name + "[" + lot + "]");
    return all;
}

const Parameter& ParameterSpace::parameter(std::size_t i) const {
    if (i < shared_.size()) return parameters_[shared_[i]];
    return parameters_[per_lot_[(i - shared_.size()) % per_lot_.size()]];
}

double ParameterSpace::plain(const Parameter& parameter, double unit) {
    const double u = std::clamp(unit, 0.0, 1.0);
    if (parameter.normal_scale) return normal_prior(parameter).quantile(u);
    if (!parameter.log_uniform)
        return parameter.lower + u * (parameter.upper - parameter.lower);
    const double low = std::log(parameter.lower), high = std::log(parameter.upper);
    return std::clamp(std::exp(low + u * (high - low)), parameter.lower, parameter.upper);
}

double ParameterSpace::value(std::size_t i, double unit) const {
    return plain(parameter(i), unit);
}

double ParameterSpace::unit(std::size_t i, double value) const {
    const Parameter& p = parameter(i);
    if (p.normal_scale) return normal_prior(p).cdf(value);
    return place_in_range(p, value);
}

Eigen::VectorXd ParameterSpace::values(const Eigen::VectorXd& unit) const {
    Eigen::VectorXd plain_values(unit.size());
    for (Eigen::Index i = 0; i < unit.size(); ++i)
        plain_values(i) = value(static_cast<std::size_t>(i), unit(i));
    return plain_values;
}

RowMatrix ParameterSpace::lot_parameters(const RowMatrix& units, std::size_t lot) const {
    RowMatrix plain_values(units.rows(), index(parameters_.size()));
    for (Eigen::Index i = 0; i < units.rows(); ++i)
        fill(units.row(i).head(index(shared_.size())),
             units.row(i).segment(index(lot_offset(lot)), index(per_lot_.size())),
             plain_values.row(i));
    return plain_values;
}

}  // namespace taylorcal::calibrate
