#include "calibrate/diagnosis/adequacy.hpp"

#include "calibrate/diagnosis/bad_data.hpp"
#include "calibrate/diagnosis/tail_probability.hpp"

#include <algorithm>
#include <set>

namespace taylorcal::calibrate {
namespace {

/// Secant of the effect from absence to half its typical amplitude.
Eigen::VectorXd effect_direction(const DiagnosisProblem& problem, const Whitening& whiten,
                                 std::size_t k, const Eigen::VectorXd& unit) {
    const double amplitude = 0.5 * problem.candidates[k].typical();
    const RowMatrix shift =
        problem.model.shift(k, unit.transpose(), Eigen::VectorXd::Constant(1, amplitude));
    return whiten(shift.transpose()) / amplitude;
}

Screening screen(const DiagnosisProblem& problem, const Whitening& whiten,
                 const Refit& refit, const Projector& project, std::size_t k) {
    Screening screening;
    screening.direction = effect_direction(problem, whiten, k, refit.unit);
    screening.projected = project(screening.direction);
    const double norm = screening.projected.norm(), whole = screening.direction.norm();
    if (!(whole > 0)) return screening;
    screening.identifiability = norm / whole;
    if (!(norm > 0)) return screening;
    screening.score = screening.projected.dot(refit.residual) / norm;
    screening.amplitude = screening.score / norm;
    const bool is_present = std::count(refit.effects.begin(), refit.effects.end(), k) > 0;
    screening.is_screened =
        !is_present && screening.identifiability >= least_identifiability;
    return screening;
}

Side side_of(const Candidate& candidate) {
    if (candidate.may_rise() && candidate.may_fall()) return Side::both;
    return candidate.may_rise() ? Side::positive : Side::negative;
}

void test_scores(Adequacy& adequacy, const DiagnosisProblem& problem,
                 const NormalTable& table) {
    std::vector<Side> sides;
    std::vector<std::size_t> tested;
    for (std::size_t k = 0; k < adequacy.screening.size(); ++k) {
        if (!adequacy.screening[k].is_screened) continue;
        tested.push_back(k);
        sides.push_back(side_of(problem.candidates[k]));
    }
    Eigen::MatrixXd directions(problem.measured.size(),
                               static_cast<Eigen::Index>(tested.size()));
    for (std::size_t i = 0; i < tested.size(); ++i)
        directions.col(static_cast<Eigen::Index>(i)) =
            adequacy.screening[tested[i]].projected;
    const MaximumTest test(directions, sides, table);
    adequacy.critical_score = test.critical(Adequacy::level_of_test(problem.alpha));
    for (std::size_t i = 0; i < tested.size(); ++i)
        adequacy.p_score = std::min(
            adequacy.p_score,
            test.probability(test.strength(i, adequacy.screening[tested[i]].score)));
}

}  // namespace

Adequacy test_adequacy(const DiagnosisProblem& problem, const Whitening& whiten,
                       const Refit& refit, const NormalTable& table) {
    const Eigen::MatrixXd slopes = refit.all_slopes();
    const Projector project(slopes);
    Adequacy adequacy;
    adequacy.n = problem.measured.size();
    adequacy.parameters = project.rank();
    adequacy.chi2 = project(refit.residual).squaredNorm();
    adequacy.p_chi2 =
        chi2_tail(adequacy.chi2, static_cast<double>(adequacy.n - adequacy.parameters));
    adequacy.battery = battery_contrasts(problem);
    for (Contrast& contrast : adequacy.battery)
        contrast.direction = whiten(contrast.direction);
    adequacy.p_battery = test_contrasts(adequacy.battery, project, refit.residual, table);
    for (const Suspect& suspect : suspect_data(problem, whiten, refit))
        adequacy.p_bad_data = std::min(adequacy.p_bad_data, suspect.p);
    adequacy.drift = drift_contrasts(problem, refit.slope);
    adequacy.p_drift = test_contrasts(adequacy.drift, project, refit.residual, table);
    for (std::size_t k = 0; k < problem.candidates.size(); ++k)
        adequacy.screening.push_back(problem.model.why_unseen(k).empty()
                                         ? screen(problem, whiten, refit, project, k)
                                         : Screening{Eigen::VectorXd::Zero(adequacy.n),
                                                     Eigen::VectorXd::Zero(adequacy.n)});
    test_scores(adequacy, problem, table);
    return adequacy;
}

Eigen::Index most_statistics(const DiagnosisProblem& problem) {
    std::set<std::string> shapes;
    for (const ShotLabel& shot : problem.shots) shapes.insert(shot.shape);
    return static_cast<Eigen::Index>(
        std::max({problem.candidates.size(), battery_contrasts(problem).size(),
                  shapes.size() * problem.parameters.size()}));
}

}  // namespace taylorcal::calibrate
