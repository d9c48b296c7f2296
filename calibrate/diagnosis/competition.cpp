#include "calibrate/diagnosis/competition.hpp"

#include "calibrate/diagnosis/extra_error.hpp"
#include "calibrate/diagnosis/leave_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>

namespace taylorcal::calibrate {
namespace {

/// Evidence below which an explanation is no better than none.
constexpr double least_gain = 1;

std::vector<std::size_t> by_gain(const ModeDiagnosis& mode) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < mode.candidates.size(); ++k)
        if (mode.candidates[k].evidence) order.push_back(k);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
        return mode.candidates[a].evidence->log_gain >
               mode.candidates[b].evidence->log_gain;
    });
    return order;
}

bool is_explanation(const DiagnosisProblem& problem, const Refit& fit,
                    const NormalTable& table, double p_before) {
    const Whitening whiten(covariance_with(problem, fit.effects, fit.amplitudes));
    const Adequacy after = test_adequacy(problem, whiten, fit, table);
    return !after.is_flagged(alpha_of_rest) && after.smallest_p() > p_before;
}

}  // namespace

void weigh_candidates(const DiagnosisProblem& problem, ModeDiagnosis& mode) {
    const std::vector<std::size_t> groups = groups_to_leave_out(problem);
    const double base_score =
        leave_out_score(problem, mode.base, problem.covariance, groups);
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic) num_threads(problem.threads)
    for (std::size_t k = 0; k < mode.candidates.size(); ++k) {
        CandidateRecord& record = mode.candidates[k];
        if (record.abstain) continue;
        try {
            record.evidence = effect_evidence(problem, mode.whiten, mode.base, k);
            const Refit& fit = record.evidence->fit;
            // A fit far from none may have a sign that the score at none has not.
            record.has_physical_sign =
                record.has_physical_sign ||
                problem.candidates[k].is_allowed(fit.amplitudes(0));
            record.leave_out_gain =
                leave_out_score(problem, fit,
                                covariance_with(problem, fit.effects, fit.amplitudes),
                                groups) -
                base_score;
        } catch (...) {
#pragma omp critical(diagnosis_candidate_failure)
            failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

void find_set(const DiagnosisProblem& problem, const NormalTable& table,
              ModeDiagnosis& mode) {
    double best = 0;
    bool does_any = false;
    std::vector<std::size_t> members;
    for (const std::size_t k : by_gain(mode)) {
        CandidateRecord& record = mode.candidates[k];
        const double gain = record.evidence->log_gain;
        if (gain < least_gain || (does_any && gain < best - indistinguishable)) break;
        if (!record.has_physical_sign) continue;
        record.explains = is_explanation(problem, record.evidence->fit, table,
                                         mode.adequacy.smallest_p());
        if (record.explains && !does_any) best = gain;
        does_any = does_any || record.explains;
        members.push_back(k);
    }
    if (!does_any) return;
    // One that fails to explain by a little may still be the truth, its signature not
    // quite straight: it stays beside those that explain, if the evidence is for it.
    for (const std::size_t k : members) {
        mode.candidates[k].in_set = true;
        for (std::size_t l = 0; l < mode.candidates.size(); ++l)
            if (mode.candidates[l].evidence && mode.candidates[l].has_physical_sign &&
                std::abs(mode.cosine(static_cast<Eigen::Index>(k),
                                     static_cast<Eigen::Index>(l))) > alike)
                mode.candidates[l].in_set = true;
    }
}

std::vector<const PairRecord*> explaining_pairs(const ModeDiagnosis& mode) {
    std::vector<const PairRecord*> found;
    for (const PairRecord& pair : mode.pairs)
        if (pair.explains && pair.log_gain > 0 &&
            (found.empty() ||
             pair.log_gain > found.front()->log_gain - indistinguishable))
            found.push_back(&pair);
    return found;
}

std::vector<std::size_t> enough_alone(const ModeDiagnosis& mode,
                                      const std::vector<const PairRecord*>& pairs) {
    if (pairs.size() < 2) return {};
    for (const std::size_t k : pairs.front()->effects) {
        const CandidateRecord& record = mode.candidates[k];
        const bool is_shared = std::ranges::all_of(pairs, [&](const PairRecord* pair) {
            return std::ranges::count(pair->effects, k) > 0;
        });
        if (!is_shared || !record.evidence || !record.has_physical_sign ||
            record.evidence->log_gain <= pairs.front()->log_gain - worth_a_second)
            continue;
        std::vector<std::size_t> found = {k};
        for (std::size_t other = 0; other < mode.candidates.size(); ++other)
            if (other != k && mode.candidates[other].evidence &&
                std::abs(mode.cosine(static_cast<Eigen::Index>(k),
                                     static_cast<Eigen::Index>(other))) > alike)
                found.push_back(other);
        return found;
    }
    return {};
}

void weigh_pairs(const DiagnosisProblem& problem, const NormalTable& table,
                 ModeDiagnosis& mode) {
    constexpr std::size_t most_refitted = 8;
    struct Promise {
        std::vector<std::size_t> effects;
        double gain;
    };
    std::vector<Promise> promises;
    const std::vector<std::size_t> seen = by_gain(mode);
    for (std::size_t i = 0; i < seen.size(); ++i)
        for (std::size_t j = i + 1; j < seen.size(); ++j) {
            const std::size_t k = seen[i], l = seen[j];
            const Screening& a = mode.candidates[k].screening;
            const Screening& b = mode.candidates[l].screening;
            const double r =
                mode.cosine(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(l));
            if (std::abs(r) > alike) continue;
            const double za = (a.score - r * b.score) / (1 - r * r);
            const double zb = (b.score - r * a.score) / (1 - r * r);
            // The signs of both together must be physical; za and zb have those signs.
            if (!problem.candidates[k].is_allowed(za) ||
                !problem.candidates[l].is_allowed(zb))
                continue;
            // ln Z of the pair in Laplace's approximation but for the priors' densities.
            const double width =
                a.projected.norm() * std::abs(problem.candidates[k].typical()) *
                b.projected.norm() * std::abs(problem.candidates[l].typical()) *
                std::sqrt(1 - r * r);
            promises.push_back(
                {{k, l}, 0.5 * (za * a.score + zb * b.score) - std::log1p(width)});
        }
    std::stable_sort(promises.begin(), promises.end(),
                     [](const auto& a, const auto& b) { return a.gain > b.gain; });
    promises.resize(std::min(promises.size(), most_refitted));
    for (const Promise& promise : promises) {
        std::optional<Whitening> whiten = mode.whiten;
        const Refit fit = refit_with(problem, whiten, promise.effects, mode.base);
        mode.pairs.push_back(
            {promise.effects, pair_evidence(problem, *whiten, mode.base, fit),
             is_explanation(problem, fit, table, mode.adequacy.smallest_p())});
    }
    std::stable_sort(
        mode.pairs.begin(), mode.pairs.end(),
        [](const auto& a, const auto& b) { return a.log_gain > b.log_gain; });
}

double unlisted_gain(const DiagnosisProblem& problem, const ModeDiagnosis& mode) {
    constexpr std::array per_cent{0.5, 1.0, 2.0, 4.0};
    const Projector project(mode.base.all_slopes());
    return gain_of_extra_error(project(mode.whiten(smooth_patterns(problem))),
                               project(mode.base.residual), per_cent);
}

}  // namespace taylorcal::calibrate
