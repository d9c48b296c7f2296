#include "calibrate/comparison/words.hpp"
#include "calibrate/diagnosis/competition.hpp"
#include "calibrate/diagnosis/diagnosis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::calibrate {
namespace {

std::string with_unit(double value, const std::string& unit) {
    return unit == "1" || unit.empty() ? fmt::format("{:.3g}", value)
                                       : fmt::format("{:.3g} {}", value, unit);
}

/// "0.08 +- 0.01", or for a constant the value that it would have.
std::string amplitude_words(const Candidate& c, const EffectEvidence& evidence) {
    const double amplitude = evidence.fit.amplitudes(0);
    const std::string sd = with_unit(evidence.sd, c.unit);
    if (!c.is_constant) return fmt::format("{:.3g} +- {}", amplitude, sd);
    return fmt::format("{:.3g} +- {} instead of {:.3g}", c.base + amplitude, sd, c.base);
}

std::string misfit_words(const Contrast& contrast) {
    const std::string what = fmt::format("{} of shape {}", size_in_words(contrast.size),
                                         in_words(contrast.shape));
    const std::string reference = reference_in_words(contrast.size);
    if (contrast.what == "mean")
        return fmt::format(
            "measured {} is {:.1f} %{} {} than the model says (z = {:.1f})", what,
            std::abs(contrast.amount), reference,
            contrast.amount > 0 ? "larger" : "smaller", contrast.z);
    return fmt::format(
        "measured {} {} with velocity against the model, by {:.1f} %{} from the slowest "
        "shot to the fastest (z = {:.1f})",
        what, contrast.amount > 0 ? "rises" : "falls", 2 * std::abs(contrast.amount),
        reference, contrast.z);
}

std::string adequacy_words(const Adequacy& adequacy, bool is_flagged, double level) {
    const std::string numbers = fmt::format(
        "chi^2 {:.0f} on {} degrees of freedom, p = {:.2g}; patterns by shape and size "
        "p = {:.2g}; listed candidates p = {:.2g}; the wildest shot p = {:.2g}",
        adequacy.chi2, adequacy.n - adequacy.parameters, adequacy.p_chi2,
        adequacy.p_battery, adequacy.p_score, adequacy.p_bad_data);
    const bool fails = std::min({adequacy.p_chi2, adequacy.p_battery, adequacy.p_score,
                                 adequacy.p_bad_data}) < level;
    if (!is_flagged && fails)
        return fmt::format(
            "Whether the calibrated model explains the {} measured numbers within their "
            "errors depends on where it is asked ({}). ",
            adequacy.n, numbers);
    if (!is_flagged)
        return fmt::format(
            "The calibrated model explains all {} measured numbers within their errors "
            "({}). ",
            adequacy.n, numbers);
    std::string words = fmt::format(
        "The calibrated model does not explain the measurements ({})", numbers);
    if (!adequacy.battery.empty()) words += ": " + misfit_words(adequacy.battery.front());
    return words + ". ";
}

std::string explanation_words(const DiagnosisProblem& problem, const ModeDiagnosis& mode,
                              std::size_t k) {
    const Candidate& c = problem.candidates[k];
    const std::string name =
        c.is_constant ? "another " + in_words(c.name) : in_words(c.name);
    const auto& evidence = mode.candidates[k].evidence;
    if (!evidence) return name;
    return fmt::format("{} ({}; ln Z {:+.1f}; other shots predicted {} by {:.1f})", name,
                       amplitude_words(c, *evidence), evidence->log_gain,
                       mode.candidates[k].leave_out_gain > 0 ? "better" : "worse",
                       std::abs(mode.candidates[k].leave_out_gain));
}

std::string suspect_words(const DiagnosisProblem& problem, const Suspect& suspect) {
    const std::string shot = "shot " + problem.shots[suspect.shot].id;
    return suspect.size.empty()
               ? shot
               : fmt::format("{} of {}", size_in_words(suspect.size), shot);
}

/// What came nearest though it does not explain.
std::string nearest_words(const DiagnosisProblem& problem, const ModeDiagnosis& mode) {
    const CandidateRecord* best = nullptr;
    std::size_t nearest = 0;
    for (std::size_t k = 0; k < mode.candidates.size(); ++k) {
        const CandidateRecord& record = mode.candidates[k];
        if (!record.evidence || !record.has_physical_sign) continue;
        if (best && record.evidence->log_gain <= best->evidence->log_gain) continue;
        best = &record;
        nearest = k;
    }
    if (!best || best->evidence->log_gain < indistinguishable) return "";
    return fmt::format("Nearest comes {}, and leaves a misfit. ",
                       explanation_words(problem, mode, nearest));
}

/// What it means when deviations are too large but nothing about them is regular.
std::string patternless_words(const DiagnosisProblem& problem, const Adequacy& adequacy) {
    const double level = Adequacy::level_of_test(problem.alpha);
    if (std::min({adequacy.p_battery, adequacy.p_score, adequacy.p_bad_data}) < level)
        return "";
    const double excess =
        std::sqrt(adequacy.chi2 / static_cast<double>(adequacy.n - adequacy.parameters));
    return fmt::format(
        "The deviations are {:.1f} times their errors but follow no pattern by size, "
        "shape or velocity, and no single shot stands out: the stated errors may be too "
        "small, or shots of different metal may share a lot. ",
        excess);
}

/// Wild shots beside whatever else was found.
std::string wild_words(const DiagnosisProblem& problem, const Diagnosis& diagnosis) {
    if (!diagnosis.verdict.suspects.empty()) return "";
    std::vector<std::string> wild;
    for (const Suspect& suspect : diagnosis.modes.front().suspects)
        if (suspect.size.empty() && suspect.p < Adequacy::level_of_test(problem.alpha))
            wild.push_back(fmt::format("{} ({:.1f} standard errors)",
                                       problem.shots[suspect.shot].id, suspect.z));
    if (wild.empty()) return "";
    return fmt::format("Besides, far from what the others say: {}; check the record. ",
                       fmt::join(wild, ", "));
}

/// Sizes that scatter from shot to shot much more than their errors say.
std::string scatter_words(const Diagnosis& diagnosis) {
    std::vector<std::string> sizes;
    for (const UnstatedScatter& scatter : diagnosis.scatter)
        if (scatter.over_stated > 1)
            sizes.push_back(fmt::format(
                "{} by {:.1f} % beyond {:.1f} %", size_in_words(scatter.size),
                100 * scatter.over_stated * scatter.stated_sd, 100 * scatter.stated_sd));
    if (sizes.empty()) return "";
    return fmt::format(
        "From shot to shot, without a trend, sizes scatter more than their errors say: "
        "{}. That is counted as an error and not as missing physics; see whether the "
        "stated errors are too small. ",
        fmt::join(sizes, ", "));
}

std::string finding_words(const DiagnosisProblem& problem, const Diagnosis& diagnosis) {
    const Verdict& verdict = diagnosis.verdict;
    const ModeDiagnosis& mode = diagnosis.modes.front();
    std::vector<std::string> effects, suspects;
    bool has_constant = false, has_effect = false;
    for (const std::size_t k : verdict.effects) {
        effects.push_back(explanation_words(problem, mode, k));
        (problem.candidates[k].is_constant ? has_constant : has_effect) = true;
    }
    for (const Suspect& suspect : verdict.suspects)
        suspects.push_back(suspect_words(problem, suspect));
    const std::string mixed =
        has_constant && has_effect
            ? "A constant of the material and an effect explain it alike: measure the "
              "constant independently. "
            : "";
    switch (verdict.kind) {
        case VerdictKind::no_effect_supported:
            return "No missing effect is supported. ";
        case VerdictKind::effect:
            if (effects.size() > 1)
                return fmt::format(
                    "Two causes together would explain it, one alone does not: "
                    "{}. {}",
                    fmt::join(effects, " and "), mixed);
            return fmt::format(
                "It would be explained by {}{}. ", effects.front(),
                mode.candidates[verdict.effects.front()].explains
                    ? ""
                    : ", but for a rest that no second cause explains clearly better");
        case VerdictKind::one_of:
            return fmt::format(
                "These shots do not tell which of these explains it: {}. {}",
                fmt::join(effects, "; "), mixed);
        case VerdictKind::not_distinguishable:
            effects.insert(effects.end(), suspects.begin(), suspects.end());
            return fmt::format("What explains it cannot be told from these shots{}{}. {}",
                               effects.empty() ? "" : "; possible are ",
                               fmt::join(effects, "; "), mixed);
        case VerdictKind::outside_the_list:
            return fmt::format(
                "No listed candidate, nor two together, explains it well enough: the "
                "cause is outside the list (smooth patterns without a cause gain ln Z "
                "{:+.1f}). {}{}{}",
                mode.unlisted_gain, patternless_words(problem, mode.adequacy),
                nearest_words(problem, mode), unexplained_words(mode.unexplained));
        case VerdictKind::bad_data:
            return fmt::format(
                "One measurement stands apart from all others: {} ({:.1f} "
                "standard errors); without it the model explains the rest. "
                "Check it before looking for physics. ",
                fmt::join(suspects, ", "), std::abs(verdict.suspects.front().z));
    }
    return "";
}

/// Whether a second network of the same runs says the same, and else what each says.
std::string network_words(const DiagnosisProblem& problem, const Diagnosis& diagnosis) {
    if (diagnosis.by_network.empty()) return "";
    std::vector<std::string> answers;
    for (const Verdict& verdict : diagnosis.by_network) {
        std::vector<std::string> names;
        for (const std::size_t k : verdict.effects)
            names.push_back(in_words(problem.candidates[k].name));
        for (const Suspect& suspect : verdict.suspects)
            names.push_back(suspect_words(problem, suspect));
        answers.push_back(fmt::format("{}{}{}", verdict_word(verdict.kind),
                                      names.empty() ? "" : ": ", fmt::join(names, ", ")));
    }
    if (answers.front() == answers.back())
        return "A second network of the same runs says the same. ";
    return fmt::format(
        "Two networks of the same runs say different things ({}; {}): what is said here "
        "holds for both. ",
        answers.front(), answers.back());
}

/// What these data could not have shown.
std::string blind_words(const DiagnosisProblem& problem, const Diagnosis& diagnosis) {
    std::vector<std::string> absorbed, unseen, small;
    const ModeDiagnosis& mode = diagnosis.modes.front();
    for (std::size_t k = 0; k < problem.candidates.size(); ++k) {
        const CandidateRecord& record = mode.candidates[k];
        const Candidate& c = problem.candidates[k];
        const std::string name = in_words(c.name);
        if (!record.why_unseen.empty())
            unseen.push_back(name);
        else if (record.abstain)
            absorbed.push_back(name);
        else if (!diagnosis.verdict.is_flagged)
            small.push_back(fmt::format("{} below {}", name,
                                        with_unit(record.smallest_detectable, c.unit)));
    }
    std::string words;
    if (!small.empty())
        words += fmt::format("Would probably not have been seen (90 % power): {}. ",
                             fmt::join(small, ", "));
    if (!absorbed.empty())
        words += fmt::format(
            "Could not have been seen, as a change of the calibrated "
            "parameters looks the same here: {}. ",
            fmt::join(absorbed, ", "));
    if (!unseen.empty())
        words += fmt::format("Could not have been seen, for want of signature runs: {}. ",
                             fmt::join(unseen, ", "));
    return words;
}

}  // namespace

std::string in_words(const std::string& name) {
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

std::string verdict_words(const DiagnosisProblem& problem, const Diagnosis& diagnosis) {
    std::string words =
        adequacy_words(diagnosis.modes.front().adequacy, diagnosis.verdict.is_flagged,
                       Adequacy::level_of_test(problem.alpha)) +
        finding_words(problem, diagnosis) + network_words(problem, diagnosis) +
        wild_words(problem, diagnosis) + scatter_words(diagnosis) +
        blind_words(problem, diagnosis);
    while (!words.empty() && words.back() == ' ') words.pop_back();
    return words;
}

std::string candidate_words(const Candidate& c, const CandidateRecord& record) {
    const std::string name = in_words(c.name);
    if (!record.why_unseen.empty())
        return fmt::format("{}: could not be seen ({})", name, record.why_unseen);
    if (record.abstain)
        return fmt::format(
            "{}: a change of the parameters would look the same here "
            "({:.0f} % of it is left)",
            name, 100 * record.screening.identifiability);
    std::string words =
        fmt::format("{}: {}, ln Z {:+.1f}", name, amplitude_words(c, *record.evidence),
                    record.evidence->log_gain);
    if (!record.has_physical_sign) words += ", the wrong sign";
    if (record.evidence->is_at_end_of_runs)
        words += ", held where its signature runs end";
    if (record.in_set)
        words += ", would explain the misfit";
    else
        words += fmt::format(", an amplitude of {} would have been seen",
                             with_unit(record.smallest_detectable, c.unit));
    return words;
}

std::string unexplained_words(const Unexplained& unexplained) {
    constexpr double clear = 0.01;
    const auto& all = unexplained.correlations;
    if (all.empty() || all.front().p * static_cast<double>(all.size()) > clear)
        return "The unexplained part follows no state of the metal closely. ";
    const Unexplained::Correlation& best = all.front();
    return fmt::format(
        "The unexplained part of {} {} with the {} of the runs (rank "
        "correlation {:.2f}, p = {:.1g}). ",
        size_in_words(best.size), best.rank_correlation > 0 ? "rises" : "falls",
        in_words(best.descriptor), best.rank_correlation, best.p);
}

}  // namespace taylorcal::calibrate
