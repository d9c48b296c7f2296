#include "calibrate/diagnosis/shot_design.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/LU>
#include <Eigen/QR>
#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::calibrate {
namespace {

constexpr int steps_of_velocity = 9;

/// One way to explain the data: parameters and at most one candidate.
struct Explanation {
    std::string name;
    double weight = 1;
    Eigen::VectorXd unit;
    std::optional<std::size_t> candidate;
    double amplitude = 0;
};

Explanation with_candidate(const DiagnosisProblem& problem, const ModeDiagnosis& mode,
                           std::size_t k) {
    const EffectEvidence& evidence = *mode.candidates[k].evidence;
    return {in_words(problem.candidates[k].name),
            std::exp(std::min(evidence.log_gain, 300.0)), evidence.fit.unit, k,
            evidence.fit.amplitudes(0)};
}

/// The least visible candidate at the amplitude that would just be seen, the parameters
/// following it as far as they can.
Explanation least_visible(const DiagnosisProblem& problem, const ModeDiagnosis& mode) {
    std::optional<std::size_t> least;
    const auto visibility = [&](std::size_t k) {
        return std::abs(problem.candidates[k].typical()) /
               mode.candidates[k].smallest_detectable;
    };
    for (std::size_t k = 0; k < mode.candidates.size(); ++k)
        if (mode.candidates[k].evidence && (!least || visibility(k) < visibility(*least)))
            least = k;
    if (!least) return {"", 1, mode.base.unit, std::nullopt, 0};
    const Candidate& c = problem.candidates[*least];
    const double amplitude = std::clamp(
        std::copysign(mode.candidates[*least].smallest_detectable, c.typical()),
        c.lower(), c.upper());
    const Eigen::VectorXd absorbed =
        mode.base.slope.completeOrthogonalDecomposition().solve(
            mode.candidates[*least].screening.direction) *
        amplitude;
    return {in_words(c.name), 1, (mode.base.unit - absorbed).cwiseMax(0.0).cwiseMin(1.0),
            *least, amplitude};
}

std::vector<Explanation> explanations_of(const DiagnosisProblem& problem,
                                         const ModeDiagnosis& mode,
                                         const std::vector<std::size_t>& set) {
    std::vector<Explanation> all;
    for (const std::size_t k : set)
        if (mode.candidates[k].evidence) all.push_back(with_candidate(problem, mode, k));
    if (all.size() == 1) {
        std::optional<std::size_t> rival;
        const auto gain = [&](std::size_t k) {
            return mode.candidates[k].evidence->log_gain;
        };
        for (std::size_t k = 0; k < mode.candidates.size(); ++k)
            if (k != *all.front().candidate && mode.candidates[k].evidence &&
                (!rival || gain(k) > gain(*rival)))
                rival = k;
        if (rival) all.push_back(with_candidate(problem, mode, *rival));
    }
    if (all.size() < 2)
        all = {{"the model as it is", 1, mode.base.unit, std::nullopt, 0},
               least_visible(problem, mode)};
    // The question is which of them it is, so that none may weigh nothing.
    double highest = 0;
    for (const Explanation& e : all) highest = std::max(highest, e.weight);
    for (Explanation& e : all) e.weight = std::max(e.weight / highest, 0.05);
    return all;
}

/// Shots to choose from: shapes x velocities x proportions, other inputs in the middle.
std::vector<Shot> possible_shots(const CorrectedPredictor& predictor) {
    std::vector<Shot> shots;
    for (const auto& [shape, signature] : predictor.shapes()) {
        const Eigen::VectorXd low = signature.inputs.colwise().minCoeff(),
                              high = signature.inputs.colwise().maxCoeff();
        const int proportions = high(1) > 1.02 * low(1) ? 3 : 1;
        for (int v = 0; v < steps_of_velocity; ++v)
            for (int l = 0; l < proportions; ++l) {
                const auto between = [&](Eigen::Index i, double t) {
                    return low(i) + t * (high(i) - low(i));
                };
                Shot shot;
                shot.shape = shape;
                shot.velocity_m_s =
                    between(0, static_cast<double>(v) / (steps_of_velocity - 1));
                shot.initial_diameter_mm = between(2, 0.5);
                shot.initial_length_mm =
                    shot.initial_diameter_mm *
                    between(1, proportions == 1 ? 0.5 : 0.5 * static_cast<double>(l));
                shot.initial_temperature_K = between(3, 0.5);
                shots.push_back(shot);
            }
    }
    return shots;
}

/// Relative sd of each fitted size in the table, in the mean; 1 % where it has none.
Eigen::VectorXd usual_sd(const DiagnosisStudy& study) {
    const auto n = static_cast<Eigen::Index>(study.inputs().settings.fit_sizes.size());
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n), count = sum;
    for (const Datum& datum : study.data())
        for (std::size_t i = 0; i < datum.columns.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            sum(datum.columns[i]) += datum.sd_mm(at) / datum.scale_mm(at);
            count(datum.columns[i]) += 1;
        }
    return (count.array() > 0).select(sum.array() / count.array().max(1), 0.01);
}

/// The lot with most fitted shots, of several the first by name.
std::size_t lot_to_shoot(const DiagnosisStudy& study) {
    const std::vector<std::string>& names = study.inputs().set.lots;
    std::vector<std::size_t> shots(names.size());
    for (const Datum& datum : study.data()) ++shots[datum.lot];
    std::size_t best = 0;
    for (std::size_t lot = 1; lot < names.size(); ++lot)
        if (shots[lot] > shots[best] ||
            (shots[lot] == shots[best] && names[lot] < names[best]))
            best = lot;
    return best;
}

class ShotJudge {
  public:
    ShotJudge(const DiagnosisStudy& study, const ModeDiagnosis& mode,
              std::vector<Explanation> explanations, std::size_t lot)
        : study_(study),
          mode_(mode),
          lot_(lot),
          explanations_(std::move(explanations)),
          relative_sd_(usual_sd(study)) {
        Eigen::MatrixXd information = mode.base.slope.transpose() * mode.base.slope;
        information.diagonal().array() += 12;  // of the uniform prior
        open_ = information.inverse();
    }
    double operator()(const Shot& shot) const {
        const CorrectedPredictor& predictor = study_.predictor();
        const auto& sizes = predictor.signature(shot.shape).sizes;
        const auto parameters = [&](const RowMatrix& units) {
            return study_.inputs().space.lot_parameters(units, lot_);
        };
        std::vector<Prediction> predictions;
        for (const Explanation& e : explanations_) {
            const RowMatrix at = parameters(e.unit.transpose());
            Eigen::VectorXd mean = predictor.predict(shot, at).row(0).transpose()(sizes);
            if (e.candidate)
                mean += predictor
                            .shift(*e.candidate, shot, at,
                                   Eigen::VectorXd::Constant(1, e.amplitude))
                            .row(0)
                            .transpose()(sizes);
            predictions.push_back({e.weight, mean});
        }
        return separation(predictions, covariance(shot, sizes, parameters));
    }

  private:
    /// Errors of the measurement and what the parameters leave open.
    Eigen::MatrixXd covariance(const Shot& shot, const std::vector<Eigen::Index>& sizes,
                               const auto& parameters) const {
        constexpr double step = 2e-3;
        const Eigen::VectorXd& unit = mode_.base.unit;
        const Eigen::Index p = unit.size();
        RowMatrix points(2 * p, p);
        for (Eigen::Index j = 0; j < p; ++j) {
            points.row(2 * j) = points.row(2 * j + 1) = unit.transpose();
            points(2 * j, j) = std::min(1.0, unit(j) + step);
            points(2 * j + 1, j) = std::max(0.0, unit(j) - step);
        }
        const RowMatrix sizes_at =
            study_.predictor().predict(shot, parameters(points))(Eigen::all, sizes);
        Eigen::MatrixXd slope(sizes_at.cols(), p);
        for (Eigen::Index j = 0; j < p; ++j)
            slope.col(j) = (sizes_at.row(2 * j) - sizes_at.row(2 * j + 1)).transpose() /
                           (points(2 * j, j) - points(2 * j + 1, j));
        return covariance_of_new_shot(study_.predictor(), study_.inputs().settings, shot,
                                      parameters(unit.transpose()), relative_sd_) +
               slope * open_ * slope.transpose();
    }

    const DiagnosisStudy& study_;
    const ModeDiagnosis& mode_;
    std::size_t lot_;
    std::vector<Explanation> explanations_;
    Eigen::VectorXd relative_sd_;
    Eigen::MatrixXd open_;  // covariance of the parameters
};

}  // namespace

std::vector<NextExperiment> design_shots(const DiagnosisStudy& study,
                                         const DiagnosisProblem& problem,
                                         const ModeDiagnosis& mode,
                                         const std::vector<std::size_t>& set,
                                         std::size_t count) {
    const std::vector<Explanation> explanations = explanations_of(problem, mode, set);
    std::vector<std::string> names;
    names.reserve(explanations.size());
    for (const Explanation& e : explanations) names.push_back(e.name);
    if (names.back().empty()) return {};
    const std::vector<std::string>& lots = study.inputs().set.lots;
    const std::size_t lot = lot_to_shoot(study);
    const std::string of_lot =
        lots.size() > 1 ? " of lot " + in_words(lots[lot]) : std::string();
    const ShotJudge judge(study, mode, explanations, lot);
    std::vector<NextExperiment> all;
    for (Shot& shot : possible_shots(study.predictor())) {
        shot.lot = lots[lot];
        NextExperiment experiment{shot, judge(shot), ""};
        experiment.words = fmt::format(
            "{}{} at {:.0f} m/s, {:.2f} mm diameter, L/D {:.2f}, {:.0f} K: tells {} "
            "apart (mean squared distance {:.2g} in standard errors)",
            in_words(shot.shape), of_lot, shot.velocity_m_s, shot.initial_diameter_mm,
            shot.length_to_diameter(), shot.initial_temperature_K,
            fmt::join(names, " and "), experiment.separation);
        all.push_back(std::move(experiment));
    }
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a.separation > b.separation;
    });
    all.resize(std::min(all.size(), count));
    return all;
}

}  // namespace taylorcal::calibrate
