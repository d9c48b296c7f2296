#include "common/errors.hpp"
#include "emulator/commands/commands.hpp"
#include "emulator/inference/predict_table.hpp"

#include <iostream>

namespace taylorcal::emulator {

int predict(const PredictArguments& arguments) {
    const Emulator emulator = Emulator::from_file(arguments.emulator);
    require(arguments.table.empty() != arguments.set.empty(),
            "predict needs either a table or --set. Give one of them.");
    std::vector<Point> points;
    if (arguments.table.empty()) {
        points.push_back(point_of(emulator, arguments.set, arguments.category));
    } else {
        points = points_of(emulator, CsvTable::from_file(arguments.table));
    }
    std::cout << predict_table(emulator, points);
    return 0;
}

}  // namespace taylorcal::emulator
