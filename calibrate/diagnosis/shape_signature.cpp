#include "calibrate/diagnosis/shape_signature.hpp"

#include "calibrate/sampling/parameter_space.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::calibrate {
namespace {

/// Rows gathered for one fit.
class Rows {
  public:
    void add(const Eigen::VectorXd& scaled, double amplitude,
             const Eigen::VectorXd& target) {
        if (!target.allFinite()) return;
        scaled_.push_back(scaled);
        amplitudes_.push_back(amplitude);
        targets_.push_back(target);
    }
    std::optional<SmoothFit> fit() const {
        const auto n = static_cast<Eigen::Index>(scaled_.size());
        if (n < fewest_points) return std::nullopt;
        Eigen::MatrixXd scaled(n, scaled_.front().size());
        Eigen::MatrixXd targets(n, targets_.front().size());
        for (Eigen::Index i = 0; i < n; ++i) {
            scaled.row(i) = scaled_[static_cast<std::size_t>(i)].transpose();
            targets.row(i) = targets_[static_cast<std::size_t>(i)].transpose();
        }
        return fit_smoothly(
            scaled, Eigen::Map<const Eigen::VectorXd>(amplitudes_.data(), n), targets);
    }

  private:
    std::vector<Eigen::VectorXd> scaled_, targets_;
    std::vector<double> amplitudes_;
};

/// Sizes that most of the runs have.
std::vector<Eigen::Index> sizes_of(const PairedRuns& runs,
                                   const std::vector<std::size_t>& bases) {
    std::vector<Eigen::Index> sizes;
    for (Eigen::Index c = 0; c < runs.bases[bases.front()].sizes_mm.size(); ++c) {
        const auto finite = std::count_if(bases.begin(), bases.end(), [&](std::size_t i) {
            return std::isfinite(runs.bases[i].sizes_mm(c));
        });
        if (2 * static_cast<std::size_t>(finite) > bases.size()) sizes.push_back(c);
    }
    return sizes;
}

}  // namespace

Eigen::VectorXd signature_inputs(const Shot& shot, const Eigen::VectorXd& parameters,
                                 const std::vector<Parameter>& priors) {
    Eigen::VectorXd inputs(4 + parameters.size());
    inputs.head(4) << shot.velocity_m_s, shot.length_to_diameter(),
        shot.initial_diameter_mm, shot.initial_temperature_K;
    for (Eigen::Index j = 0; j < parameters.size(); ++j)
        inputs(4 + j) =
            place_in_range(priors[static_cast<std::size_t>(j)], parameters(j));
    return inputs;
}

Eigen::Index ShapeSignature::output_of(Eigen::Index size) const {
    const auto at = std::find(sizes.begin(), sizes.end(), size);
    return at == sizes.end() ? -1 : at - sizes.begin();
}

std::optional<ShapeSignature> shape_signature(const PairedRuns& runs,
                                              const std::string& shape,
                                              const Predictor& network,
                                              const Settings& settings,
                                              const std::vector<Candidate>& candidates,
                                              const std::vector<Eigen::VectorXd>& finer) {
    const std::vector<std::size_t> bases = runs.bases_of(shape);
    if (static_cast<Eigen::Index>(bases.size()) < fewest_points) return std::nullopt;
    ShapeSignature signature;
    signature.points = bases.size();
    signature.sizes = sizes_of(runs, bases);
    const auto inputs_of = [&](const BaseRun& run) {
        return signature_inputs(run.shot, run.parameters, settings.parameters);
    };
    signature.inputs.resize(static_cast<Eigen::Index>(bases.size()),
                            inputs_of(runs.bases[bases.front()]).size());
    signature.parameters.resize(static_cast<Eigen::Index>(bases.size()),
                                runs.bases[bases.front()].parameters.size());
    for (std::size_t i = 0; i < bases.size(); ++i) {
        const BaseRun& run = runs.bases[bases[i]];
        const auto at = static_cast<Eigen::Index>(i);
        signature.inputs.row(at) = inputs_of(run).transpose();
        signature.parameters.row(at) = run.parameters.transpose();
    }
    signature.scaling = InputScaling(signature.inputs);

    // The finest runs there are say what the network lacks; too few of them, the base
    // runs.
    const bool has_finer =
        std::count_if(bases.begin(), bases.end(), [&](std::size_t i) {
            return finer[i].size() > 0 && finer[i](signature.sizes).allFinite();
        }) >= fewest_points;
    Rows network_error, base_error, resolution, descriptors;
    for (const std::size_t i : bases) {
        const BaseRun& run = runs.bases[i];
        const Eigen::VectorXd scaled = signature.scaling(inputs_of(run));
        const double diameter = run.shot.initial_diameter_mm;
        const Eigen::VectorXd predicted =
            network.predict(run.shot, run.parameters.transpose()).row(0).transpose();
        descriptors.add(scaled, 1, run.descriptors);
        Eigen::VectorXd error = run.sizes_mm - predicted;
        base_error.add(scaled, 1, error(signature.sizes) / diameter);
        if (has_finer) {
            if (finer[i].size() == 0) continue;
            resolution.add(scaled, 1, finer[i](signature.sizes) / diameter);
            error += finer[i];
        }
        network_error.add(scaled, 1, error(signature.sizes) / diameter);
    }
    const std::optional<SmoothFit> error = network_error.fit();
    if (!error) return std::nullopt;
    signature.network_error = *error;
    signature.grain_scatter = has_finer
                                  ? base_error.fit()->noise
                                  : Eigen::MatrixXd((1 - missed_share) * error->noise);
    signature.resolution = resolution.fit();
    signature.descriptors = descriptors.fit().value_or(SmoothFit{});

    std::vector<Rows> effects(candidates.size());
    signature.amplitudes.resize(candidates.size());
    for (const EffectRun& run : runs.effects) {
        const BaseRun& base = runs.bases[run.base];
        if (base.shot.shape != shape) continue;
        auto& [lowest, highest] = signature.amplitudes[run.candidate];
        lowest = std::min(lowest, run.amplitude);
        highest = std::max(highest, run.amplitude);
        const double amplitude =
            run.amplitude / std::abs(candidates[run.candidate].typical());
        effects[run.candidate].add(
            signature.scaling(inputs_of(base)), amplitude,
            run.change_mm(signature.sizes) / (base.shot.initial_diameter_mm * amplitude));
    }
    for (const Rows& rows : effects) signature.effects.push_back(rows.fit());
    return signature;
}

}  // namespace taylorcal::calibrate
