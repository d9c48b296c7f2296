#pragma once

#include "calibrate/diagnosis/paired_runs.hpp"
#include "calibrate/diagnosis/smooth_fit.hpp"
#include "calibrate/prediction/predictor.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace taylorcal::calibrate {

/// Inputs that signatures depend on: velocity, proportions, diameter, temperature and the
/// calibrated parameters by their place in the prior. `parameters`: plain.
Eigen::VectorXd signature_inputs(const Shot& shot, const Eigen::VectorXd& parameters,
                                 const std::vector<Parameter>& priors);

/// What is left of a fit is partly grains, new for every shot, and partly what the
/// polynomial misses, alike for shots of neighbouring velocity. Paired runs have other
/// parameters each, so that they cannot tell the one from the other: half of the variance
/// each.
inline constexpr double missed_share = 0.5;

/// What the paired runs of one shape teach. All sizes are divided by the initial
/// diameter.
struct ShapeSignature {
    InputScaling scaling;
    std::vector<Eigen::Index> sizes;  ///< fitted sizes that the shape has
    SmoothFit network_error;  ///< solver, at the finest fidelity there is, - network
    /// Covariance of the sizes' scatter from one set of grains to another, from the base
    /// runs: specimens are taken to scatter no less.
    Eigen::MatrixXd grain_scatter;
    std::vector<std::optional<SmoothFit>> effects;  ///< change / (amplitude / typical)
    std::optional<SmoothFit> resolution;            ///< finer - present fidelity
    SmoothFit descriptors;
    std::size_t points = 0;
    Eigen::MatrixXd inputs;      ///< of the base runs, unscaled
    Eigen::MatrixXd parameters;  ///< of the base runs, plain
    /// Lowest and highest amplitude run of each candidate, 0 among them.
    std::vector<std::pair<double, double>> amplitudes;

    /// Position of a fitted size in the fits' outputs, or -1.
    Eigen::Index output_of(Eigen::Index size) const;
    /// Terms of a fit at a shot.
    Eigen::VectorXd terms(const SmoothFit& fit, const Eigen::VectorXd& unscaled,
                          double amplitude = 0) const {
        return fit.terms(scaling(unscaled), amplitude);
    }
};

/// Nothing if the shape has fewer than four finished base runs. `finer`: changes by base
/// run, empty where there are none.
std::optional<ShapeSignature> shape_signature(const PairedRuns& runs,
                                              const std::string& shape,
                                              const Predictor& network,
                                              const Settings& settings,
                                              const std::vector<Candidate>& candidates,
                                              const std::vector<Eigen::VectorXd>& finer);

}  // namespace taylorcal::calibrate
