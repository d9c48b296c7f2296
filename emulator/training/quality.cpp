#include "emulator/training/quality.hpp"

#include "emulator/training/samples.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace taylorcal::emulator {

namespace {

std::vector<std::string> category_values(const Emulator& emulator) {
    const auto& values = emulator.category().values;
    return values.empty() ? std::vector<std::string>{no_category} : values;
}

/// Rows of one category value.
std::vector<Eigen::Index> rows_of(const Dataset& data,
                                  const std::vector<Eigen::Index>& rows,
                                  const std::string& category) {
    std::vector<Eigen::Index> chosen;
    for (const Eigen::Index row : rows) {
        if (data.categories[static_cast<std::size_t>(row)] == category)
            chosen.push_back(row);
    }
    return chosen;
}

}  // namespace

RowMatrix predict_rows(const Emulator& emulator, const Dataset& data,
                       const std::vector<Eigen::Index>& rows) {
    RowMatrix predicted =
        RowMatrix::Constant(data.rows(), data.outputs.cols(), std::nan(""));
    Workspace workspace;
    for (const std::string& value : category_values(emulator)) {
        const std::vector<Eigen::Index> chosen = rows_of(data, rows, value);
        if (chosen.empty()) continue;
        const Block points =
            data.inputs(chosen, Eigen::all).transpose().array().cast<float>();
        Block results;
        emulator.evaluate(points, emulator.category_index(value), results, workspace);
        predicted(chosen, Eigen::all) = results.matrix().transpose().cast<double>();
    }
    return predicted(rows, Eigen::all);
}

std::vector<OutputError> errors_by_output(const Emulator& emulator, const Dataset& data,
                                          const std::vector<Eigen::Index>& rows,
                                          const RowMatrix& predicted) {
    const RowMatrix divided = divided_outputs(emulator.model(), data);
    std::vector<OutputError> errors;
    for (Eigen::Index k = 0; k < data.outputs.cols(); ++k) {
        for (const std::string& value : category_values(emulator)) {
            OutputError part;
            part.output = emulator.outputs()[static_cast<std::size_t>(k)].name;
            part.category = value;
            double squares = 0, divided_squares = 0, divided_largest = 0, magnitude = 0;
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const double known = data.outputs(rows[i], k);
                const bool here =
                    data.categories[static_cast<std::size_t>(rows[i])] == value;
                if (!here || !std::isfinite(known)) continue;
                const double error = predicted(static_cast<Eigen::Index>(i), k) - known;
                const double per_unit = known == 0 ? 0 : divided(rows[i], k) / known;
                ++part.n;
                squares += error * error;
                part.largest = std::max(part.largest, std::abs(error));
                divided_squares += error * error * per_unit * per_unit;
                divided_largest = std::max(divided_largest, std::abs(error * per_unit));
                magnitude += std::abs(divided(rows[i], k));
            }
            if (part.n == 0) continue;
            const auto n = static_cast<double>(part.n);
            part.rms = std::sqrt(squares / n);
            part.rms_relative = std::sqrt(divided_squares / n) / (magnitude / n);
            part.largest_relative = divided_largest / (magnitude / n);
            errors.push_back(part);
        }
    }
    return errors;
}

OutputError overall(const std::vector<OutputError>& parts) {
    OutputError whole;
    whole.output = "all";
    whole.category = "all";
    whole.rms = whole.largest = std::nan("");
    double squares = 0;
    for (const OutputError& part : parts) {
        whole.n += part.n;
        squares += static_cast<double>(part.n) * part.rms_relative * part.rms_relative;
        whole.largest_relative = std::max(whole.largest_relative, part.largest_relative);
    }
    whole.rms_relative = std::sqrt(squares / static_cast<double>(whole.n));
    return whole;
}

std::string error_table(const std::vector<OutputError>& errors) {
    std::string table = "output,shape,n,rms,largest,rms_percent,largest_percent\n";
    std::vector<OutputError> lines = errors;
    lines.push_back(overall(errors));
    for (const OutputError& line : lines) {
        const auto own = [](double value) {
            return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string();
        };
        table += fmt::format("{},{},{},{},{},{:.3f},{:.3f}\n", line.output, line.category,
                             line.n, own(line.rms), own(line.largest),
                             100 * line.rms_relative, 100 * line.largest_relative);
    }
    return table;
}

nlohmann::json to_json(const OutputError& error) {
    return {{"output", error.output},
            {"shape", error.category},
            {"rms", error.rms},
            {"largest", error.largest},
            {"rms_relative", error.rms_relative},
            {"largest_relative", error.largest_relative},
            {"n", error.n}};
}

}  // namespace taylorcal::emulator
