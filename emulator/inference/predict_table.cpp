#include "emulator/inference/predict_table.hpp"

#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::emulator {

namespace {

/// All inputs unknown but those that are constant in the emulator.
Point blank_point(const Emulator& emulator, const std::string& where) {
    const std::vector<InputInfo>& inputs = emulator.inputs();
    Point point{
        Eigen::VectorXd::Constant(static_cast<Eigen::Index>(inputs.size()), std::nan("")),
        "", where};
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        if (!inputs[i].used) point.inputs[static_cast<Eigen::Index>(i)] = inputs[i].lower;
    }
    return point;
}

/// What a table may call the shape that a network without category learnt from.
const std::string shape_column = "shape";

void check_columns(const Emulator& emulator, const CsvTable& table) {
    std::vector<std::string> known;
    for (const InputInfo& input : emulator.inputs()) known.push_back(input.name);
    const bool has_category = !emulator.category().values.empty();
    known.push_back(has_category ? emulator.category().name : shape_column);
    for (const std::string& column : table.columns())
        require(std::ranges::find(known, column) != known.end(),
                fmt::format("{}, line 1: unknown column \"{}\"{}. Leave it out; the "
                            "emulator takes {}.",
                            table.file(), column,
                            nearest_hint(column, known, " (is \"", "\" meant?)"),
                            fmt::join(known, ", ")));
}

/// The point's category by its position. InputError for one that was not learnt from.
int category_of(const Emulator& emulator, const Point& point) {
    try {
        if (!point.category.empty()) emulator.check_shape(point.category);
        return emulator.category_index(point.category);
    } catch (const InputError& error) {
        throw InputError(point.where + ": " + error.what());
    }
}

void check(const Emulator& emulator, const Point& point) {
    for (std::size_t i = 0; i < emulator.inputs().size(); ++i) {
        const InputInfo& input = emulator.inputs()[i];
        const double value = point.inputs[static_cast<Eigen::Index>(i)];
        require(!std::isnan(value),
                fmt::format(
                    "{}: input \"{}\" is missing. Give a value from {:.6g} to {:.6g}.",
                    point.where, input.name, input.lower, input.upper));
        emulator.check_range(input.name, value, point.where);
    }
}

}  // namespace

std::vector<Point> points_of(const Emulator& emulator, const CsvTable& table) {
    check_columns(emulator, table);
    std::vector<Point> points;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        Point point = blank_point(emulator, table.place(row));
        for (std::size_t i = 0; i < emulator.inputs().size(); ++i) {
            const std::string& name = emulator.inputs()[i].name;
            if (!table.has(name)) continue;
            const auto value = table.number(row, name);
            if (value) point.inputs[static_cast<Eigen::Index>(i)] = *value;
        }
        if (!emulator.category().values.empty()) {
            point.category = table.text(row, emulator.category().name);
        } else if (table.has(shape_column)) {
            point.category = table.text(row, shape_column);
        }
        points.push_back(std::move(point));
    }
    return points;
}

Point point_of(const Emulator& emulator, const std::vector<std::string>& assignments,
               const std::string& category) {
    Point point = blank_point(emulator, "--set");
    point.category = category;
    std::set<std::string> given;
    for (const std::string& assignment : assignments) {
        const std::size_t equals = assignment.find('=');
        double value = 0;
        const char* end = assignment.data() + assignment.size();
        const bool has_name = equals != std::string::npos && equals > 0;
        const char* begin = has_name ? assignment.data() + equals + 1 : end;
        const auto [stopped, problem] = std::from_chars(begin, end, value);
        require(
            has_name && problem == std::errc{} && stopped == end && std::isfinite(value),
            fmt::format("--set \"{}\" (expected name=number).", assignment));
        const std::string name = assignment.substr(0, equals);
        require(given.insert(name).second,
                fmt::format("--set {}: {} is given twice. Keep one value.", assignment,
                            name));
        point.inputs[emulator.input_index(name)] = value;
    }
    return point;
}

std::string predict_table(const Emulator& emulator, const std::vector<Point>& points) {
    const bool has_category = !emulator.category().values.empty();
    std::string table = has_category ? emulator.category().name : "";
    for (const OutputInfo& output : emulator.outputs()) {
        table += fmt::format("{}{},{}_member_sd", table.empty() ? "" : ",", output.name,
                             output.name);
    }
    table += '\n';
    Workspace workspace;
    for (const Point& point : points) {
        check(emulator, point);
        const int category = category_of(emulator, point);
        const Block input = point.inputs.cast<float>().array();
        Block best, other;
        emulator.evaluate(input, category, best, workspace);
        Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(best.rows());
        Eigen::ArrayXd squares = sum;
        for (std::size_t member = 0; member < emulator.members(); ++member) {
            emulator.evaluate_member(member, input, category, other, workspace);
            const Eigen::ArrayXd difference = (other - best).col(0).cast<double>();
            sum += difference;
            squares += difference.square();
        }
        const auto n = static_cast<double>(emulator.members());
        const Eigen::ArrayXd sd = ((squares / n - (sum / n).square()).max(0)).sqrt();
        std::string line = has_category ? point.category : "";
        for (Eigen::Index k = 0; k < best.rows(); ++k) {
            const std::string& name =
                emulator.outputs()[static_cast<std::size_t>(k)].name;
            const bool known = emulator.has_output(name, point.category);
            line += line.empty() ? "" : ",";
            line += known ? fmt::format("{},{:.3g}", best(k, 0), sd[k]) : ",";
        }
        table += line + '\n';
    }
    return table;
}

}  // namespace taylorcal::emulator
