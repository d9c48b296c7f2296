#pragma once

#include "common/csv_table.hpp"
#include "emulator/inference/emulator.hpp"

#include <string>
#include <vector>

namespace taylorcal::emulator {

/// One point to predict: all inputs in the emulator's order.
struct Point {
    Eigen::VectorXd inputs;
    std::string category;
    std::string where;  ///< Starts messages about this point.
};

/// The points of a table with one column for each input that varies (others may be left
/// out) and one for the category. InputError for a missing cell.
std::vector<Point> points_of(const Emulator& emulator, const CsvTable& table);

/// One point from texts "name=value".
Point point_of(const Emulator& emulator, const std::vector<std::string>& assignments,
               const std::string& category);

/// A comma-separated table: the category, each output by the best member, and the
/// standard deviation of the members. InputError for a point beyond the range.
std::string predict_table(const Emulator& emulator, const std::vector<Point>& points);

}  // namespace taylorcal::emulator
