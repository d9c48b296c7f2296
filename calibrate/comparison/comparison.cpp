#include "calibrate/comparison/comparison.hpp"

#include <algorithm>

namespace taylorcal::calibrate {

Comparison compare_with_measurements(const ComparisonInputs& inputs) {
    const StoredPosterior& posterior = inputs.posterior;
    const double best_spread = inputs.levels.values[posterior.maxima_levels.front()];
    Comparison result;
    result.parameters = summarise(column_names(inputs.space, inputs.levels),
                                  posterior.draws, posterior.maxima.row(0));
    result.shots = compare_shots(inputs);
    result.groups = group_residuals(result.shots, inputs.set.sizes,
                                    joint_errors(inputs, result.shots));
    result.fitted = misfit(result.shots, Use::calibrate, best_spread);
    result.held_back = misfit(result.shots, Use::validate, best_spread);
    result.conflicts = find_conflicts(inputs, result.shots);
    result.influence = leave_one_out(inputs, result.shots);
    result.curves = predict_curves(inputs);
    return result;
}

std::vector<std::string> findings(const Comparison& comparison) {
    std::vector<const ResidualGroup*> found;
    for (const ResidualGroup& group : comparison.groups)
        if (group.by != "use" &&
            group.words.find("within the errors") == std::string::npos)
            found.push_back(&group);
    std::stable_sort(found.begin(), found.end(), [](const auto* a, const auto* b) {
        return a->whitened_rms > b->whitened_rms;
    });
    std::vector<std::string> words;
    for (const Conflict& conflict : comparison.conflicts) words.push_back(conflict.words);
    for (const ResidualGroup* group : found)
        if (std::find(words.begin(), words.end(), group->words) == words.end())
            words.push_back(group->words);
    return words;
}

}  // namespace taylorcal::calibrate
