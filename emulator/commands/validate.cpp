#include "common/errors.hpp"
#include "emulator/commands/commands.hpp"
#include "emulator/training/quality.hpp"

#include <iostream>

#include <spdlog/spdlog.h>

namespace taylorcal::emulator {

int validate(const std::filesystem::path& emulator_file,
             const std::filesystem::path& database) {
    const Emulator emulator = Emulator::from_file(emulator_file);
    std::vector<std::string> inputs, outputs;
    for (const InputInfo& input : emulator.inputs()) inputs.push_back(input.name);
    for (const OutputInfo& output : emulator.outputs()) outputs.push_back(output.name);
    const Dataset data =
        read_dataset(database, inputs, emulator.category().name, outputs);
    std::vector<Eigen::Index> within;
    for (Eigen::Index row = 0; row < data.rows(); ++row) {
        try {
            for (std::size_t i = 0; i < inputs.size(); ++i) {
                emulator.check_range(inputs[i],
                                     data.inputs(row, static_cast<Eigen::Index>(i)), "");
            }
            const auto at = static_cast<std::size_t>(row);
            if (!data.shapes.empty()) emulator.check_shape(data.shapes[at]);
            emulator.category_index(data.categories[at]);
            within.push_back(row);
        } catch (const InputError&) {
            continue;
        }
    }
    spdlog::info(
        "{} rows compared, {} beyond the emulator's range, {} dropped for their status",
        within.size(), data.rows() - static_cast<Eigen::Index>(within.size()),
        data.dropped_rows);
    require(!within.empty(), database.string() +
                                 ": no row lies within the emulator's range. "
                                 "Give the database it was trained on, or one "
                                 "with runs in its range.");
    const RowMatrix predicted = predict_rows(emulator, data, within);
    std::cout << error_table(errors_by_output(emulator, data, within, predicted));
    return 0;
}

}  // namespace taylorcal::emulator
