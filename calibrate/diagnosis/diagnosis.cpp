#include "calibrate/diagnosis/diagnosis.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::calibrate {
namespace {

constexpr double least_share = 0.05;
constexpr std::size_t most_modes = 4;

struct Peak {
    Refit fit;
    double height;
};

/// Distinct fits, the highest first. Fits whose predictions lie within one standard error
/// in all are points of one ridge.
std::vector<Peak> find_peaks(const DiagnosisProblem& problem, const RowMatrix& starts) {
    constexpr double same = 1;
    const Whitening whiten(problem.covariance);
    std::vector<Peak> all;
    for (Eigen::Index i = 0; i < starts.rows(); ++i) {
        Refit fit =
            refit(problem, whiten, {}, starts.row(i).transpose(), Eigen::VectorXd());
        const double height = log_average_likelihood(fit, whiten.log_determinant());
        all.push_back({std::move(fit), height});
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const auto& a, const auto& b) { return a.height > b.height; });
    std::vector<Peak> peaks;
    for (Peak& peak : all) {
        const bool is_known = std::any_of(peaks.begin(), peaks.end(), [&](const Peak& p) {
            return (p.fit.residual - peak.fit.residual).norm() < same;
        });
        if (is_known || peak.height < all.front().height + std::log(least_share))
            continue;
        if (peaks.size() < most_modes) peaks.push_back(std::move(peak));
    }
    return peaks;
}

/// Scatter about the best fit near `start`, under the errors that are stated.
std::vector<UnstatedScatter> scatter_at(const DiagnosisProblem& problem,
                                        const Eigen::VectorXd& start) {
    const Whitening whiten(problem.covariance);
    const Refit fit = refit(problem, whiten, {}, start, Eigen::VectorXd());
    return unstated_scatter(problem, whiten.colour(fit.residual).col(0));
}

bool names_effects(VerdictKind kind) {
    return kind == VerdictKind::effect || kind == VerdictKind::one_of;
}

bool same_suspects(const Verdict& a, const Verdict& b) {
    if (a.suspects.size() != b.suspects.size()) return false;
    for (std::size_t i = 0; i < a.suspects.size(); ++i)
        if (a.suspects[i].shot != b.suspects[i].shot) return false;
    return true;
}

}  // namespace

Verdict worst_case(const std::vector<Verdict>& verdicts) {
    Verdict verdict = verdicts.front();
    for (const Verdict& other : verdicts) {
        if (!other.is_flagged) return other;
        if (other.kind == verdict.kind && other.effects == verdict.effects &&
            same_suspects(other, verdict))
            continue;
        for (const std::size_t k : other.effects)
            if (std::count(verdict.effects.begin(), verdict.effects.end(), k) == 0)
                verdict.effects.push_back(k);
        if (!same_suspects(other, verdict))
            verdict.suspects.insert(verdict.suspects.end(), other.suspects.begin(),
                                    other.suspects.end());
        verdict.kind = names_effects(other.kind) && names_effects(verdict.kind)
                           ? VerdictKind::one_of
                           : VerdictKind::not_distinguishable;
    }
    return verdict;
}

void ask_second_network(Diagnosis& diagnosis, const Verdict& second) {
    diagnosis.by_network = {diagnosis.verdict, second};
    diagnosis.verdict = worst_case(diagnosis.by_network);
}

Diagnosis diagnose(const ProblemAt& problem_at, const RowMatrix& starts) {
    Diagnosis diagnosis;
    DiagnosisProblem first = problem_at(starts.row(0).transpose());
    diagnosis.scatter = scatter_at(first, starts.row(0).transpose());
    count_scatter(diagnosis.scatter, first);
    const NormalTable table(first.seed, most_statistics(first));
    for (const Peak& peak : find_peaks(first, starts)) {
        DiagnosisProblem problem = problem_at(peak.fit.unit);
        count_scatter(diagnosis.scatter, problem);
        diagnosis.modes.push_back(diagnose_mode(problem, peak.fit.unit, table));
    }
    const auto higher = [](const auto& a, const auto& b) {
        return a.log_height > b.log_height;
    };
    std::stable_sort(diagnosis.modes.begin(), diagnosis.modes.end(), higher);
    double sum = 0;
    const double highest = diagnosis.modes.front().log_height;
    for (const ModeDiagnosis& mode : diagnosis.modes)
        sum += std::exp(mode.log_height - highest);
    for (ModeDiagnosis& mode : diagnosis.modes)
        mode.share = std::exp(mode.log_height - highest) / sum;
    std::vector<Verdict> verdicts;
    for (const ModeDiagnosis& mode : diagnosis.modes) verdicts.push_back(mode.verdict);
    diagnosis.verdict = worst_case(verdicts);
    return diagnosis;
}

}  // namespace taylorcal::calibrate
