#include "calibrate/comparison/comparison.hpp"
#include "common/provenance.hpp"

#include <nlohmann/json.hpp>

namespace taylorcal::calibrate {
namespace {

using nlohmann::json;

json to_json(const ShotComparison& shot, const std::vector<std::string>& sizes) {
    const Datum& datum = *shot.datum;
    json entry{{"id", datum.shot.id},
               {"lot", datum.shot.lot},
               {"shape", datum.shot.shape},
               {"use", use_word(datum.shot.use)},
               {"velocity_m_s", datum.shot.velocity_m_s},
               {"initial_diameter_mm", datum.shot.initial_diameter_mm},
               {"initial_length_mm", datum.shot.initial_length_mm},
               {"source", datum.shot.source},
               {"sizes", json::array()}};
    for (const auto& row : shot.covariance.rowwise())
        entry["covariance_mm2"].push_back(std::vector<double>(row.begin(), row.end()));
    for (Eigen::Index i = 0; i < shot.residual.size(); ++i) {
        const auto column = datum.columns[static_cast<std::size_t>(i)];
        entry["sizes"].push_back({{"size", sizes[static_cast<std::size_t>(column)]},
                                  {"measured", datum.measured_mm(i)},
                                  {"sd", datum.sd_mm(i)},
                                  {"predicted", shot.predicted(i)},
                                  {"predictive_mean", shot.predictive_mean(i)},
                                  {"predictive_lower", shot.predictive_lower(i)},
                                  {"predictive_upper", shot.predictive_upper(i)},
                                  {"predictive_sd", shot.predictive_sd(i)},
                                  {"residual", shot.residual(i)},
                                  {"standardised", shot.standardised(i)},
                                  {"whitened", shot.whitened(i)}});
    }
    return entry;
}

json to_json(const ResidualGroup& group) {
    return {{"by", group.by},
            {"key", group.key},
            {"n", group.n},
            {"rms_relative", group.rms_relative},
            {"mean_relative", group.mean_relative},
            {"mean_standardised", group.mean_standardised},
            {"mean_standardised_sd", group.mean_standardised_sd},
            {"mean_whitened", group.mean_whitened},
            {"whitened_rms", group.whitened_rms},
            {"whitened_rms_sd", group.whitened_rms_sd},
            {"words", group.words}};
}

json to_json(const Misfit& misfit) {
    return {{"n", misfit.n},
            {"chi2", misfit.chi2},
            {"chi2_with_spread", misfit.chi2_with_spread},
            {"rms_relative", misfit.rms_relative},
            {"whitened_rms", misfit.whitened_rms}};
}

json to_json(const ParameterSummary& p) {
    return {{"name", p.name},       {"mean", p.mean},     {"sd", p.sd},
            {"lower95", p.lower95}, {"median", p.median}, {"upper95", p.upper95},
            {"maximum", p.maximum}};
}

json to_json(const Conflict& c) {
    return {{"id", c.id},
            {"size", c.size},
            {"measured", c.measured_mm},
            {"nearest", c.nearest_mm},
            {"distance_sd", c.distance_sd},
            {"words", c.words}};
}

json to_json(const Influence& i) {
    return {{"id", i.id},
            {"largest_shift_sd", i.largest_shift_sd},
            {"parameter", i.parameter},
            {"chi2_left_out", i.chi2_left_out},
            {"n", i.n},
            {"effective_draws", i.effective_draws}};
}

json to_json(const Curve& c) {
    return {{"lot", c.lot},
            {"shape", c.shape},
            {"size", c.size},
            {"initial_diameter_mm", c.initial_diameter_mm},
            {"initial_length_mm", c.initial_length_mm},
            {"initial_temperature_K", c.initial_temperature_K},
            {"velocity_m_s", c.velocity_m_s},
            {"predicted", c.predicted},
            {"mean", c.mean},
            {"lower", c.lower},
            {"upper", c.upper}};
}

template <class Item>
json list_of(const std::vector<Item>& items) {
    json list = json::array();
    for (const Item& item : items) list.push_back(to_json(item));
    return list;
}

}  // namespace

json to_json(const Comparison& comparison, const ComparisonInputs& inputs) {
    const ThirdsOfVelocity thirds = thirds_of(comparison.shots);
    json shots = json::array();
    for (const ShotComparison& shot : comparison.shots)
        shots.push_back(to_json(shot, inputs.set.sizes));
    return {{"schema", "taylorcal/comparison/1"},
            {"sign", "residual = measured - predicted; lengths in mm"},
            {"parameters", list_of(comparison.parameters)},
            {"misfit",
             {{"calibrate", to_json(comparison.fitted)},
              {"validate", to_json(comparison.held_back)}}},
            {"findings", findings(comparison)},
            {"velocity_thirds_m_s", {thirds.middle_from(), thirds.high_from()}},
            {"groups", list_of(comparison.groups)},
            {"conflicts", list_of(comparison.conflicts)},
            {"influence", list_of(comparison.influence)},
            {"shots", shots},
            {"curves", list_of(comparison.curves)},
            {"provenance",
             provenance("calibrate", inputs.settings.seed, inputs.settings.source)}};
}

}  // namespace taylorcal::calibrate
