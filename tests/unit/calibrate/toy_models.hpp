#pragma once

#include "calibrate/measurements/data_set.hpp"
#include "calibrate/prediction/predictor.hpp"
#include "calibrate/settings/settings.hpp"

#include <functional>
#include <string>
#include <vector>

namespace taylorcal::calibrate::toys {

/// A closed form in place of the network: sizes from (shot, parameters).
class ClosedForm final : public Predictor {
  public:
    using Function = std::function<Eigen::VectorXd(const Shot&, const Eigen::VectorXd&)>;
    ClosedForm(Function function, Eigen::MatrixXd covariance)
        : function_(std::move(function)), covariance_(std::move(covariance)) {}

    RowMatrix predict(const Shot& shot, const RowMatrix& parameters) const override {
        RowMatrix all(parameters.rows(), covariance_.rows());
        for (Eigen::Index i = 0; i < all.rows(); ++i)
            all.row(i) = function_(shot, parameters.row(i).transpose()).transpose();
        return all;
    }
    Eigen::MatrixXd error_covariance(const Shot&, const Eigen::VectorXd&) const override {
        return covariance_;
    }
    /// In shares of 100 m/s.
    double apart(const Shot& a, const Shot& b) const override {
        return std::abs(a.velocity_m_s - b.velocity_m_s) / 100;
    }
    double lowest_velocity_m_s() const override { return 1; }
    double highest_velocity_m_s() const override { return 1000; }

  private:
    Function function_;
    Eigen::MatrixXd covariance_;
};

inline Shot shot(const std::string& id, const std::string& lot, double velocity_m_s,
                 std::vector<Measurement> sizes) {
    Shot made;
    made.id = id;
    made.lot = lot;
    made.shape = "uniform_cylinder";
    made.source = "closed form";
    made.velocity_m_s = velocity_m_s;
    made.initial_temperature_K = 295;
    made.initial_diameter_mm = 8;
    made.initial_length_mm = 40;
    made.sizes = std::move(sizes);
    return made;
}

}  // namespace taylorcal::calibrate::toys
