#include "common/atomic_file.hpp"
#include "emulator/commands/commands.hpp"
#include "emulator/inference/emulator.hpp"
#include "emulator/training/quality.hpp"
#include "emulator/training/train_emulator.hpp"

#include <spdlog/spdlog.h>

namespace taylorcal::emulator {

int train(const TrainArguments& arguments) {
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
    const Model model =
        arguments.from.empty()
            ? train_emulator(config, data, arguments.threads)
            : train_further(Emulator::from_file(arguments.from).model(),
                            arguments.from.string(), config, data, arguments.threads);
    write_text_atomically(arguments.out, to_json(model).dump() + "\n");
    spdlog::info(
        "held-out rows: RMS {:.3f} %, largest error {:.2f} % (of each output's mean); "
        "best is member {} of {}",
        100 * model.validation.at("rms_relative").get<double>(),
        100 * model.validation.at("largest_relative").get<double>(), model.best,
        model.members.size());
    return 0;
}

}  // namespace taylorcal::emulator
