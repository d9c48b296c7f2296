#include "emulator/inference/held_out.hpp"

#include "common/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace taylorcal::emulator {
namespace {

using nlohmann::json;

/// Rows of numbers; null for what is not finite.
json rows_to_json(const Eigen::MatrixXd& matrix) {
    json rows = json::array();
    for (const auto& line : matrix.rowwise()) {
        json row = json::array();
        for (const double value : line)
            row.push_back(std::isfinite(value) ? json(value) : json());
        rows.push_back(std::move(row));
    }
    return rows;
}

Eigen::MatrixXd rows_from(const JsonReader& reader, const std::string& key,
                          std::size_t count) {
    const json& rows = reader.json().at(key);
    const std::size_t width = rows.is_array() && !rows.empty() ? rows.front().size() : 0;
    if (width == 0 || rows.size() != count)
        reader.fail(key, "has not one row for each category. Train again.");
    Eigen::MatrixXd matrix(static_cast<Eigen::Index>(count),
                           static_cast<Eigen::Index>(width));
    for (std::size_t i = 0; i < count; ++i) {
        if (rows[i].size() != width)
            reader.fail(key, "has rows of different lengths. Train again.");
        for (std::size_t j = 0; j < width; ++j)
            matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                rows[i][j].is_number() ? rows[i][j].get<double>()
                                       : std::numeric_limits<double>::quiet_NaN();
    }
    return matrix;
}

}  // namespace

Eigen::MatrixXd covariance_near(const HeldOut& held_out, const std::string& category,
                                const Eigen::VectorXd& place,
                                const std::vector<Eigen::Index>& columns,
                                const Eigen::MatrixXd& whole) {
    std::vector<std::pair<double, Eigen::Index>> near;
    for (Eigen::Index row = 0; row < held_out.errors.rows(); ++row)
        if (held_out.categories[static_cast<std::size_t>(row)] == category &&
            held_out.errors(row, columns).allFinite())
            near.emplace_back(
                (held_out.places.row(row).transpose() - place).squaredNorm(), row);
    if (std::ssize(near) <= neighbours) return whole;
    std::ranges::nth_element(near, near.begin() + neighbours);
    Eigen::MatrixXd sum = whole;
    for (auto one = near.begin(); one != near.begin() + neighbours; ++one) {
        const Eigen::RowVectorXd error = held_out.errors(one->second, columns);
        sum += error.transpose() * error;
    }
    return sum / static_cast<double>(neighbours + 1);
}

json to_json(const HeldOut& held_out) {
    return {{"categories", held_out.categories},
            {"places", rows_to_json(held_out.places)},
            {"errors", rows_to_json(held_out.errors)}};
}

HeldOut held_out_from(const JsonReader& reader) {
    HeldOut held_out;
    held_out.categories = reader.texts("categories");
    held_out.places = rows_from(reader, "places", held_out.categories.size());
    held_out.errors = rows_from(reader, "errors", held_out.categories.size());
    return held_out;
}

}  // namespace taylorcal::emulator
