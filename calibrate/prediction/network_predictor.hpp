#pragma once

#include "calibrate/measurements/data_set.hpp"
#include "calibrate/prediction/predictor.hpp"
#include "calibrate/settings/settings.hpp"
#include "emulator/inference/emulator.hpp"

#include <vector>

namespace taylorcal::calibrate {

/// The held-out runs' covariance is taken so many times, which the intervals of twenty
/// metals of known parameters needed (tests/verification, study `twins`, which tells how
/// many of twenty other metals are inside). The answering member was chosen by those
/// runs, and its errors have longer tails than normal ones.
inline constexpr double held_out_understate = 3;

/// The network as the model: velocity, geometry, temperature and shape come from the
/// shot, everything else that it takes from the calibrated parameters.
class NetworkPredictor final : public Predictor {
  public:
    /// InputError unless every parameter is an input whose range holds its prior, every
    /// other input is known and every fitted size is an output.
    NetworkPredictor(emulator::Emulator emulator, const Settings& settings);

    RowMatrix predict(const Shot& shot, const RowMatrix& parameters) const override;
    /// From the held-out runs next to the point.
    Eigen::MatrixXd error_covariance(const Shot& shot,
                                     const Eigen::VectorXd& parameters) const override;
    double apart(const Shot& a, const Shot& b) const override;
    double lowest_velocity_m_s() const override;
    double highest_velocity_m_s() const override;

    /// InputError naming shot, value, range and remedy if a shot that is fitted or held
    /// back lies outside what the network was trained on.
    void check_ranges(const DataSet& set) const;

    const emulator::Emulator& emulator() const { return emulator_; }
    /// All inputs of the network for a shot, plain; those of parameters are placeholders.
    Eigen::VectorXd shot_point(const Shot& shot) const;
    /// The calibrated parameter that feeds input `i`; negative if the shot does.
    Eigen::Index parameter_of_input(std::size_t i) const {
        return parameter_of_input_[i];
    }
    /// The network's outputs that are the fitted sizes.
    const std::vector<int>& outputs() const { return outputs_; }

  private:
    void bind_inputs(const Settings& settings);
    void check_shot(const Datum& datum) const;
    const emulator::InputInfo& velocity() const;

    emulator::Emulator emulator_;
    std::vector<Eigen::Index> parameter_of_input_;  // not_a_parameter: from the shot
    std::vector<std::string> sizes_;
    std::vector<int> outputs_;  // of the fitted sizes
};

}  // namespace taylorcal::calibrate
