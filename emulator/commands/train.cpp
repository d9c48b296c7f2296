#include "common/atomic_file.hpp"
#include "common/program_code.hpp"
#include "common/sha256.hpp"
#include "common/simd.hpp"
#include "emulator/commands/commands.hpp"
#include "emulator/inference/emulator.hpp"
#include "emulator/training/quality.hpp"
#include "emulator/training/train_emulator.hpp"

#include <spdlog/spdlog.h>

namespace taylorcal::emulator {

namespace {

/// Digest of all that the network's bytes follow from.
std::string training_key(const TrainArguments& arguments) {
    std::string all = program_code() + ' ' + simd::name(simd::variant());
    for (const auto& file :
         {arguments.database, arguments.better, arguments.config, arguments.from})
        all += ' ' + (file.empty() ? std::string("none") : sha256_of_file(file));
    return sha256(all);
}

}  // namespace

int train(const TrainArguments& arguments) {
    require_writable(arguments.out, {arguments.database, arguments.config,
                                     arguments.better, arguments.from});
    const TrainConfig config = read_train_config(arguments.config);
    std::vector<std::string> inputs, outputs;
    for (const InputChoice& input : config.inputs) inputs.push_back(input.name);
    for (const OutputChoice& output : config.outputs) outputs.push_back(output.name);
    Dataset data = read_dataset(arguments.database, inputs, config.category, outputs);
    if (!arguments.better.empty())
        data = with_better_runs(
            std::move(data),
            read_dataset(arguments.better, inputs, config.category, outputs),
            arguments.better.string());
    const Checkpoints checkpoints(arguments.out.string() + ".checkpoint",
                                  training_key(arguments));
    const Model model =
        arguments.from.empty()
            ? train_emulator(config, data, arguments.threads, checkpoints)
            : train_further(read_model(arguments.from), arguments.from.string(), config,
                            data, arguments.threads, checkpoints);
    write_text_atomically(arguments.out, to_json(model).dump() + "\n");
    checkpoints.remove(model.members.size());
    spdlog::info(
        "held-out rows: RMS {:.3f} %, largest error {:.2f} % (of each output's mean); "
        "best is member {} of {}",
        100 * model.validation.at("rms_relative").get<double>(),
        100 * model.validation.at("largest_relative").get<double>(), model.best,
        model.members.size());
    return 0;
}

}  // namespace taylorcal::emulator
