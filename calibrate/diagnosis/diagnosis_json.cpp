#include "calibrate/diagnosis/diagnosis_json.hpp"

#include "calibrate/diagnosis/competition.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

namespace taylorcal::calibrate {
namespace {

using nlohmann::json;

json names_of(const DiagnosisProblem& problem, const std::vector<std::size_t>& effects) {
    json names = json::array();
    for (const std::size_t k : effects) names.push_back(problem.candidates[k].name);
    return names;
}

json verdict_json(const DiagnosisProblem& problem, const Verdict& verdict) {
    json shots = json::array();
    for (const Suspect& suspect : verdict.suspects)
        shots.push_back(problem.shots[suspect.shot].id);
    return {{"kind", verdict_word(verdict.kind)},
            {"effects", names_of(problem, verdict.effects)},
            {"shots", shots},
            {"flagged", verdict.is_flagged}};
}

json adequacy_json(const Adequacy& adequacy, double alpha) {
    json battery = json::array(), drift = json::array();
    for (const Contrast& c : adequacy.battery)
        battery.push_back({{"shape", c.shape},
                           {"size", c.size},
                           {"contrast", c.what},
                           {"z", c.z},
                           {"p", c.p},
                           {"percent", c.amount}});
    for (const Contrast& c : adequacy.drift)
        drift.push_back(
            {{"parameter", c.what}, {"shape", c.shape}, {"shift_sd", c.z}, {"p", c.p}});
    return {{"n", adequacy.n},
            {"p_parameters", adequacy.parameters},
            {"chi2", adequacy.chi2},
            {"p_chi2", adequacy.p_chi2},
            {"p_battery", adequacy.p_battery},
            {"battery", battery},
            {"p_score", adequacy.p_score},
            {"p_bad_data", adequacy.p_bad_data},
            {"alpha", alpha},
            {"level_of_test", Adequacy::level_of_test(alpha)},
            {"drift", drift},
            {"p_drift", adequacy.p_drift}};
}

json candidate_json(const Candidate& c, const CandidateRecord& record, bool in_set) {
    json entry{{"name", c.name},
               {"kind", c.is_constant ? "constant" : "effect"},
               {"unit", c.unit},
               {"base", c.base},
               {"identifiability", record.screening.identifiability},
               {"score", record.screening.score},
               {"amplitude", record.screening.amplitude},
               {"amplitude_linear", record.screening.amplitude},
               {"physical_sign", record.has_physical_sign},
               {"smallest_detectable", record.smallest_detectable},
               {"signal_per_unit", record.screening.projected.norm()},
               {"leave_shape_out_gain", record.leave_out_gain},
               {"alike", record.alike},
               {"explains", record.explains},
               {"in_set", in_set},
               {"abstain", record.abstain},
               {"words", candidate_words(c, record)}};
    if (record.evidence) {
        const EffectEvidence& e = *record.evidence;
        entry.update(json{{"amplitude", e.fit.amplitudes(0)},
                          {"amplitude_sd", e.sd},
                          {"lower95", e.interval.lower95},
                          {"upper95", e.interval.upper95},
                          {"log_evidence_gain", e.log_gain},
                          {"log_evidence_gain_half_width", e.log_gain_half_width},
                          {"log_evidence_gain_double_width", e.log_gain_double_width},
                          {"at_end_of_runs", e.is_at_end_of_runs},
                          {"chi2_after", e.fit.chi2()}});
    } else {
        for (const char* key :
             {"amplitude", "amplitude_sd", "lower95", "upper95", "log_evidence_gain",
              "log_evidence_gain_half_width", "log_evidence_gain_double_width",
              "at_end_of_runs", "chi2_after", "leave_shape_out_gain"})
            entry[key] = nullptr;
    }
    return entry;
}

/// Candidates by evidence, those that abstain last.
std::vector<std::size_t> order_of(const ModeDiagnosis& mode) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < mode.candidates.size(); ++k) order.push_back(k);
    const auto gain = [&](std::size_t k) {
        const auto& evidence = mode.candidates[k].evidence;
        return evidence ? evidence->log_gain : -1e300;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return gain(a) > gain(b); });
    return order;
}

json unexplained_json(const Unexplained& unexplained) {
    json pattern = json::array(), correlations = json::array();
    for (const auto& cell : unexplained.pattern)
        pattern.push_back({{"shape", cell.shape},
                           {"size", cell.size},
                           {"velocity_third", cell.velocity_third},
                           {"mean_whitened", cell.mean_whitened},
                           {"n", cell.n}});
    for (const auto& c : unexplained.correlations)
        correlations.push_back({{"descriptor", c.descriptor},
                                {"size", c.size},
                                {"rank_correlation", c.rank_correlation},
                                {"p", c.p}});
    return {{"pattern", pattern},
            {"correlations", correlations},
            {"words", unexplained_words(unexplained)}};
}

json bad_data_json(const DiagnosisProblem& problem, const ModeDiagnosis& mode) {
    json list = json::array();
    for (const Suspect& suspect : mode.suspects) {
        if (suspect.p >= problem.alpha) continue;
        json entry{{"id", problem.shots[suspect.shot].id},
                   {"z", suspect.z},
                   {"p", suspect.p},
                   {"log_evidence_gain", suspect.log_gain}};
        if (!suspect.size.empty()) entry["size"] = suspect.size;
        list.push_back(entry);
    }
    return list;
}

json scatter_json(const std::vector<UnstatedScatter>& scatters) {
    json list = json::array();
    for (const UnstatedScatter& scatter : scatters)
        list.push_back({{"size", scatter.size},
                        {"percent", 100 * scatter.over_stated * scatter.stated_sd},
                        {"stated_percent", 100 * scatter.stated_sd}});
    return list;
}

json residuals_json(const DiagnosisProblem& problem, const ModeDiagnosis& mode) {
    std::vector<double> z_shot(problem.shots.size(), 0);
    for (const Suspect& suspect : mode.suspects)
        if (suspect.size.empty()) z_shot[suspect.shot] = suspect.z;
    json list = json::array();
    for (std::size_t i = 0; i < problem.data.size(); ++i) {
        const MeasuredNumber& datum = problem.data[i];
        const ShotLabel& shot = problem.shots[datum.shot];
        list.push_back({{"id", shot.id},
                        {"shape", shot.shape},
                        {"size", datum.size},
                        {"velocity_m_s", shot.velocity_m_s},
                        {"whitened", mode.base.residual(static_cast<Eigen::Index>(i))},
                        {"z_shot", z_shot[datum.shot]}});
    }
    return list;
}

}  // namespace

json to_json(const std::vector<NextExperiment>& experiments) {
    json list = json::array();
    for (const NextExperiment& e : experiments)
        list.push_back({{"shape", e.shot.shape},
                        {"lot", e.shot.lot},
                        {"velocity_m_s", e.shot.velocity_m_s},
                        {"initial_diameter_mm", e.shot.initial_diameter_mm},
                        {"length_to_diameter", e.shot.length_to_diameter()},
                        {"initial_temperature_K", e.shot.initial_temperature_K},
                        {"separation", e.separation},
                        {"words", e.words}});
    return list;
}

json to_json(const DiagnosisProblem& problem, const Diagnosis& diagnosis,
             const DiagnosisFacts& facts) {
    const ModeDiagnosis& mode = diagnosis.modes.front();
    json verdict = verdict_json(problem, diagnosis.verdict);
    verdict["words"] = verdict_words(problem, diagnosis);
    verdict["networks"] = json::array();
    for (const Verdict& of_network : diagnosis.by_network)
        verdict["networks"].push_back(verdict_json(problem, of_network));
    json candidates = json::array(), names = json::array(), cosine = json::array();
    json pairs = json::array(), modes = json::array(), residual_sd = json::object();
    for (const std::size_t k : order_of(mode)) {
        const auto& set = diagnosis.verdict.effects;
        candidates.push_back(candidate_json(problem.candidates[k], mode.candidates[k],
                                            std::count(set.begin(), set.end(), k) > 0));
    }
    for (Eigen::Index k = 0; k < mode.cosine.rows(); ++k) {
        names.push_back(problem.candidates[static_cast<std::size_t>(k)].name);
        const Eigen::RowVectorXd row = mode.cosine.row(k);
        cosine.push_back(std::vector<double>(row.begin(), row.end()));
    }
    for (const PairRecord& pair : mode.pairs)
        pairs.push_back({{"effects", names_of(problem, pair.effects)},
                         {"log_evidence_gain", pair.log_gain},
                         {"explains", pair.explains}});
    for (std::size_t m = 0; m < diagnosis.modes.size(); ++m) {
        json parameters = json::object();
        for (std::size_t j = 0; j < problem.parameters.size(); ++j)
            parameters[problem.parameters[j]] = facts.mode_parameters[m][j];
        modes.push_back({{"share", diagnosis.modes[m].share},
                         {"parameters", parameters},
                         {"verdict", verdict_json(problem, diagnosis.modes[m].verdict)}});
    }
    for (std::size_t k = 0; k < facts.signature_residual_sd.size(); ++k)
        if (std::isfinite(facts.signature_residual_sd[k]))
            residual_sd[problem.candidates[k].name] = facts.signature_residual_sd[k];
    return {{"schema", "taylorcal/diagnosis/1"},
            {"verdict", verdict},
            {"adequacy", adequacy_json(mode.adequacy, problem.alpha)},
            {"candidates", candidates},
            {"confounding", {{"names", names}, {"cosine", cosine}}},
            {"pairs", pairs},
            {"unlisted_pattern", {{"log_evidence_gain", mode.unlisted_gain}}},
            {"unexplained", unexplained_json(mode.unexplained)},
            {"bad_data", bad_data_json(problem, mode)},
            {"modes", modes},
            {"signatures",
             {{"points", facts.signature_points}, {"residual_sd", residual_sd}}},
            {"errors",
             {{"words", facts.errors_in_words},
              {"unstated_scatter", scatter_json(diagnosis.scatter)}}},
            {"next_experiments", to_json(facts.next_experiments)},
            {"residuals", residuals_json(problem, mode)}};
}

}  // namespace taylorcal::calibrate
