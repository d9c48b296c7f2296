#include "emulator/training/train_emulator.hpp"

#include "common/errors.hpp"
#include "common/progress.hpp"
#include "common/provenance.hpp"
#include "emulator/training/covariance.hpp"
#include "emulator/training/quality.hpp"
#include "emulator/training/samples.hpp"
#include "emulator/training/train_member.hpp"
#include "emulator/training/widen.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

namespace taylorcal::emulator {

namespace {

std::vector<MemberSettings> member_settings(const TrainConfig& config,
                                            const Samples& samples) {
    std::vector<MemberSettings> all(static_cast<std::size_t>(config.members));
    for (std::size_t i = 0; i < all.size(); ++i) {
        MemberSettings& settings = all[i];
        settings.seed = config.seed + i;
        settings.batch_size = config.batch_sizes[i % config.batch_sizes.size()];
        settings.learning_rate = config.learning_rates[i % config.learning_rates.size()];
        settings.epochs = config.epochs;
        settings.weight_decay = config.weight_decay;
        settings.widths.push_back(samples.inputs.rows());
        settings.widths.insert(settings.widths.end(),
                               static_cast<std::size_t>(config.hidden_layers),
                               config.neurons);
        settings.widths.push_back(samples.targets.rows());
    }
    return all;
}

std::vector<Member> train_members(const std::vector<MemberSettings>& settings,
                                  const Samples& training, const Samples& validation,
                                  int threads, const Checkpoints& checkpoints) {
    std::vector<Member> members(settings.size());
    const auto count = static_cast<int>(settings.size());
    const auto epochs = static_cast<std::uint64_t>(settings.front().epochs);
    Progress progress("training, epochs of all members", epochs * settings.size());
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (int i = 0; i < count; ++i) {
        const auto member = static_cast<std::size_t>(i);
        MemberWatch watch;
        watch.interval_s = checkpoints.interval_s();
        watch.found = checkpoints.found(member);
        watch.keep = [&](const MemberState& state) { checkpoints.keep(member, state); };
        watch.after_epoch = [&](double rms) {
            progress.advance(1, fmt::format("member {} at {:.4f}", i, rms));
        };
        if (watch.found) {
            spdlog::info("member {} goes on after {} of {} epochs", i,
                         watch.found->epochs, epochs);
            progress.advance(static_cast<std::uint64_t>(watch.found->epochs));
        }
        members[member] = train_member(settings[member], training, validation, watch);
    }
    return members;
}

/// Some held-out values beside the network's, spread over rows, for plots.
nlohmann::json sample_pairs(const Emulator& emulator, const Dataset& data,
                            const std::vector<Eigen::Index>& rows,
                            const RowMatrix& predicted) {
    constexpr std::size_t most_rows = 200;
    nlohmann::json pairs = nlohmann::json::array();
    const std::size_t stride = rows.size() / most_rows + 1;
    for (std::size_t i = 0; i < rows.size(); i += stride) {
        for (std::size_t k = 0; k < emulator.outputs().size(); ++k) {
            const auto column = static_cast<Eigen::Index>(k);
            if (!std::isfinite(data.outputs(rows[i], column))) continue;
            pairs.push_back(
                {{"output", emulator.outputs()[k].name},
                 {"shape", data.categories[static_cast<std::size_t>(rows[i])]},
                 {"solver", data.outputs(rows[i], column)},
                 {"network", predicted(static_cast<Eigen::Index>(i), column)}});
        }
    }
    return pairs;
}

/// Measures the best member on held-out rows and writes the figures into the model.
void judge(Model& model, const Dataset& data, const Split& split) {
    const Emulator emulator(model);
    const RowMatrix predicted = predict_rows(emulator, data, split.validation);
    const auto errors = errors_by_output(emulator, data, split.validation, predicted);
    const OutputError whole = overall(errors);
    model.validation = {
        {"rows", split.validation.size()},
        {"training_rows", split.training.size()},
        {"dropped_rows", data.dropped_rows},
        {"cheaper_rows", std::ranges::count(data.cheaper, 1.0F)},
        {"rms_relative", whole.rms_relative},
        {"largest_relative", whole.largest_relative},
        {"pairs", sample_pairs(emulator, data, split.validation, predicted)}};
    for (const OutputError& error : errors) {
        model.validation["by_output"].push_back(to_json(error));
    }

    Dataset answered = data;
    answered.outputs(split.validation, Eigen::all) = predicted;
    const RowMatrix difference =
        divided_outputs(model, data) - divided_outputs(model, answered);
    std::vector<std::string> categories;
    for (const Eigen::Index row : split.validation) {
        categories.push_back(data.categories[static_cast<std::size_t>(row)]);
    }
    std::vector<std::string> names;
    for (const OutputInfo& output : model.outputs) names.push_back(output.name);
    const RowMatrix held_out = difference(split.validation, Eigen::all);
    model.covariances =
        covariances(held_out, categories, data.outputs, data.categories, names);
    const Eigen::MatrixXf seen = standardise(model, data, split.validation).inputs;
    model.held_out = {categories,
                      seen.topRows(static_cast<Eigen::Index>(used_inputs(model)))
                          .transpose()
                          .cast<double>(),
                      held_out};
}

/// Trains the members of a described model: from random weights, or from its members if
/// it has some.
void learn(Model& model, const TrainConfig& config, const Dataset& data,
           const Split& split, int threads, const Checkpoints& checkpoints) {
    const Samples training = standardise(model, data, split.training);
    const Samples validation = standardise(model, data, split.validation);
    std::vector<MemberSettings> settings = member_settings(config, training);
    if (!model.members.empty())
        for (std::size_t i = 0; i < settings.size(); ++i)
            settings[i].start = model.members[i % model.members.size()].layers;
    spdlog::info("{} rows to learn from, {} held out, {} dropped; {} members{}",
                 split.training.size(), split.validation.size(), data.dropped_rows,
                 config.members, model.members.empty() ? "" : ", trained before");

    const auto start = std::chrono::steady_clock::now();
    model.members = train_members(settings, training, validation, threads, checkpoints);
    const std::chrono::duration<double> elapsed =
        std::chrono::steady_clock::now() - start;
    const double shown =
        static_cast<double>(training.rows()) * config.epochs * config.members;
    spdlog::info("{:.0f} thousand samples a second", 1e-3 * shown / elapsed.count());

    const auto best =
        std::ranges::min_element(model.members, {}, &Member::validation_rms);
    if (!std::isfinite(best->validation_rms)) {
        throw NumericalError(
            "every member of the emulator diverged. Lower learning_rates.");
    }
    model.best = static_cast<std::size_t>(best - model.members.begin());
    model.provenance = provenance("emulator train", config.seed, config.as_given);
    judge(model, data, split);
}

}  // namespace

Model train_emulator(const TrainConfig& given, const Dataset& data, int threads,
                     const Checkpoints& checkpoints) {
    TrainConfig config = given;
    const Split split = split_rows(data, config.validation_fraction, config.seed);
    Model model = describe(config, data, split);
    if (config.neurons == 0) {
        const auto varying = std::ranges::count_if(model.inputs, &InputInfo::used);
        config.neurons = static_cast<int>(4 * varying + 1);
    }
    learn(model, config, data, split, threads, checkpoints);
    return model;
}

Model train_further(const Model& old, const std::string& where, const TrainConfig& config,
                    const Dataset& data, int threads, const Checkpoints& checkpoints) {
    const Split split = split_rows(data, config.validation_fraction, config.seed);
    Model model = describe(config, data, split);
    widen(model, old, where);
    learn(model, config, data, split, threads, checkpoints);
    model.provenance["from"] = old.provenance;
    return model;
}

}  // namespace taylorcal::emulator
