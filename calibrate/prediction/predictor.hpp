#pragma once

#include "calibrate/measurements/shot.hpp"
#include "common/hdf5_file.hpp"

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// The model as calibration sees it: sizes of a shot for a block of parameter points. The
/// network is one, a closed form in the tests another. Must be safe to call from threads.
class Predictor {
  public:
    virtual ~Predictor() = default;
    /// Sizes [mm] of `shot`: a row for each row of `parameters` (plain values in the
    /// order of the configuration), columns in the order of the fitted sizes.
    virtual RowMatrix predict(const Shot& shot, const RowMatrix& parameters) const = 0;
    /// Covariance [mm^2] of (solver - predictor) for the shot and one point of the
    /// parameters, in the same order.
    virtual Eigen::MatrixXd error_covariance(const Shot& shot,
                                             const Eigen::VectorXd& parameters) const = 0;
    /// How different two shots are to the predictor: differences of velocity, geometry
    /// and temperature in shares of their ranges, added.
    virtual double apart(const Shot& a, const Shot& b) const = 0;
    /// Range of impact velocity [m/s] in which it may be asked.
    virtual double lowest_velocity_m_s() const = 0;
    virtual double highest_velocity_m_s() const = 0;
};

}  // namespace taylorcal::calibrate
