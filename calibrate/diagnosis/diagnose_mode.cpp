#include "calibrate/diagnosis/competition.hpp"
#include "calibrate/diagnosis/tail_probability.hpp"

#include <algorithm>

namespace taylorcal::calibrate {
namespace {

constexpr double power = 0.9;
constexpr std::size_t most_that_say_something = 5;

void screen_candidates(const DiagnosisProblem& problem, ModeDiagnosis& mode) {
    const auto count = static_cast<Eigen::Index>(problem.candidates.size());
    Eigen::MatrixXd directions(mode.adequacy.n, count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        CandidateRecord record;
        record.screening = mode.adequacy.screening[at];
        record.why_unseen = problem.model.why_unseen(at);
        record.abstain = !record.screening.is_screened;
        const double norm = record.screening.projected.norm();
        if (norm > 0)
            record.smallest_detectable =
                (mode.adequacy.critical_score + normal_quantile_of_tail(1 - power)) /
                norm;
        record.has_physical_sign =
            problem.candidates[at].is_allowed(record.screening.amplitude);
        directions.col(k) = norm > 0 ? Eigen::VectorXd(record.screening.projected / norm)
                                     : Eigen::VectorXd::Zero(mode.adequacy.n);
        mode.candidates.push_back(std::move(record));
    }
    mode.cosine = directions.transpose() * directions;
    for (Eigen::Index k = 0; k < count; ++k)
        mode.candidates[static_cast<std::size_t>(k)].alike =
            static_cast<std::size_t>((mode.cosine.col(k).array().abs() > alike).count() -
                                     (mode.cosine(k, k) > alike ? 1 : 0));
}

/// The most likely wrong shot or number, if it is beyond the bound and explains.
std::optional<Suspect> culprit(const DiagnosisProblem& problem, const ModeDiagnosis& mode,
                               const NormalTable& table) {
    const auto best = std::max_element(
        mode.suspects.begin(), mode.suspects.end(),
        [](const auto& a, const auto& b) { return a.log_gain < b.log_gain; });
    if (best == mode.suspects.end() || best->p >= Adequacy::level_of_test(problem.alpha))
        return std::nullopt;
    if (!is_adequate_without(problem, mode.base, *best, table)) return std::nullopt;
    return *best;
}

std::vector<std::size_t> members_of_set(const ModeDiagnosis& mode) {
    std::vector<std::size_t> members;
    for (std::size_t k = 0; k < mode.candidates.size(); ++k)
        if (mode.candidates[k].in_set) members.push_back(k);
    std::stable_sort(members.begin(), members.end(), [&](auto a, auto b) {
        return mode.candidates[a].evidence->log_gain >
               mode.candidates[b].evidence->log_gain;
    });
    return members;
}

void name_pairs(Verdict& verdict, const std::vector<const PairRecord*>& pairs) {
    verdict.effects.clear();
    for (const PairRecord* pair : pairs)
        for (const std::size_t k : pair->effects)
            if (std::count(verdict.effects.begin(), verdict.effects.end(), k) == 0)
                verdict.effects.push_back(k);
    verdict.kind = pairs.size() == 1 ? VerdictKind::effect : VerdictKind::one_of;
}

/// Too many that the evidence does not tell from each other are not named.
void name_set(Verdict& verdict) {
    if (verdict.effects.size() > most_that_say_something)
        verdict.kind = VerdictKind::not_distinguishable;
    else
        verdict.kind =
            verdict.effects.size() == 1 ? VerdictKind::effect : VerdictKind::one_of;
}

void judge(const DiagnosisProblem& problem, const NormalTable& table,
           ModeDiagnosis& mode) {
    Verdict& verdict = mode.verdict;
    verdict.is_flagged = mode.adequacy.is_flagged(problem.alpha);
    if (!verdict.is_flagged) return;
    const std::optional<Suspect> suspect = culprit(problem, mode, table);
    find_set(problem, table, mode);
    weigh_pairs(problem, table, mode);
    verdict.effects = members_of_set(mode);
    const std::vector<const PairRecord*> pairs = explaining_pairs(mode);
    if (verdict.effects.empty()) verdict.effects = enough_alone(mode, pairs);
    double best = 0;  // ln Z of what the list can say
    for (const std::size_t k : verdict.effects)
        best = std::max(best, mode.candidates[k].evidence->log_gain);
    const bool needs_two =
        !pairs.empty() &&
        (verdict.effects.empty() || pairs.front()->log_gain > best + worth_a_second);
    if (needs_two) best = pairs.front()->log_gain;
    const bool none = verdict.effects.empty() && !needs_two;
    const double rival = std::max(best, mode.unlisted_gain);
    if (suspect && suspect->log_gain > rival + indistinguishable) {
        verdict.kind = VerdictKind::bad_data;
        verdict.effects.clear();
        verdict.suspects = {*suspect};
    } else if (suspect && suspect->log_gain > rival - indistinguishable) {
        verdict.kind = VerdictKind::not_distinguishable;
        verdict.suspects = {*suspect};
    } else if (none || mode.unlisted_gain > best + indistinguishable) {
        verdict.kind = VerdictKind::outside_the_list;
        verdict.effects.clear();
    } else {
        if (needs_two)
            name_pairs(verdict, pairs);
        else
            name_set(verdict);
        // What the evidence does not tell from nothing at all is not named.
        if (best < indistinguishable) verdict.kind = VerdictKind::not_distinguishable;
    }
}

/// The residual left by the best explanation there is, or by the base model.
Eigen::VectorXd remaining_residual(const ModeDiagnosis& mode) {
    const Refit* fit = &mode.base;
    if (mode.verdict.kind == VerdictKind::effect && mode.verdict.effects.size() == 1)
        fit = &mode.candidates[mode.verdict.effects.front()].evidence->fit;
    return Projector(fit->all_slopes())(fit->residual);
}

}  // namespace

std::string verdict_word(VerdictKind kind) {
    switch (kind) {
        case VerdictKind::no_effect_supported:
            return "no effect supported";
        case VerdictKind::effect:
            return "effect";
        case VerdictKind::one_of:
            return "one of";
        case VerdictKind::not_distinguishable:
            return "not distinguishable";
        case VerdictKind::outside_the_list:
            return "outside the list";
        case VerdictKind::bad_data:
            return "bad data";
    }
    return "";
}

ModeDiagnosis diagnose_mode(const DiagnosisProblem& problem, const Eigen::VectorXd& start,
                            const NormalTable& table) {
    Whitening whiten(problem.covariance);
    Refit base = refit(problem, whiten, {}, start, Eigen::VectorXd());
    ModeDiagnosis mode{std::move(whiten), std::move(base)};
    mode.log_height = log_average_likelihood(mode.base, mode.whiten.log_determinant());
    mode.adequacy = test_adequacy(problem, mode.whiten, mode.base, table);
    screen_candidates(problem, mode);
    mode.suspects = suspect_data(problem, mode.whiten, mode.base);
    weigh_candidates(problem, mode);
    mode.unlisted_gain = unlisted_gain(problem, mode);
    judge(problem, table, mode);
    mode.unexplained = describe_unexplained(problem, remaining_residual(mode));
    return mode;
}

}  // namespace taylorcal::calibrate
