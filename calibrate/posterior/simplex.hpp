#pragma once

#include <functional>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// The highest point that Nelder and Mead's simplex (1965, doi 10.1093/comjnl/7.4.308)
/// finds from `start` in the unit cube; `size`: its first edges, one a coordinate.
Eigen::VectorXd climb_simplex(const std::function<double(const Eigen::VectorXd&)>& height,
                              const Eigen::VectorXd& start, const Eigen::VectorXd& size);

}  // namespace taylorcal::calibrate
