#include "solver/commands/deformation_path.hpp"

#include "common/errors.hpp"
#include "solver/commands/configuration.hpp"

#include <cmath>

#include <fmt/core.h>

namespace taylorcal::commands {

namespace {

// Typing errors in a quaternion are larger, rounded digits smaller.
constexpr double norm_tolerance = 1e-3;
// A path that takes more steps is a unit gone wrong: at 5e6 steps a second it is minutes.
constexpr double most_steps = 1e9;
constexpr double most_outputs = 1e7;

double positive(const JsonReader& reader, std::string_view key) {
    const double value = reader.number(key);
    if (!(value > 0 && std::isfinite(value)))
        reader.fail(key,
                    fmt::format("= {} (expected a positive time in seconds).", value));
    return value;
}

Eigen::Quaterniond read_orientation(const JsonReader& reader) {
    constexpr std::string_view key = "orientation_quaternion_wxyz";
    const std::vector<double> q = reader.numbers(key);
    if (q.size() != 4)
        reader.fail(key,
                    fmt::format("has {} numbers (expected four: w, x, y, z).", q.size()));
    const Eigen::Quaterniond orientation(q[0], q[1], q[2], q[3]);
    if (!(std::abs(orientation.norm() - 1) <= norm_tolerance))
        reader.fail(key, fmt::format("has norm {} (a rotation has norm 1). Divide the "
                                     "four numbers by it.",
                                     orientation.norm()));
    return orientation.normalized();
}

Eigen::Matrix3d read_velocity_gradient(const JsonReader& reader) {
    constexpr std::string_view key = "velocity_gradient_per_s";
    const auto wrong_shape = [&] {
        reader.fail(key,
                    "is not a 3 x 3 matrix (expected three rows of three numbers, "
                    "L_ij = dv_i/dx_j in 1/s).");
    };
    if (!reader.has(key)) reader.fail(key, "is missing. Add it.");
    const nlohmann::json& rows = reader.json()[key];
    if (!rows.is_array() || rows.size() != 3) wrong_shape();
    Eigen::Matrix3d gradient;
    for (int i = 0; i < 3; ++i) {
        const nlohmann::json& row = rows[static_cast<std::size_t>(i)];
        if (!row.is_array() || row.size() != 3) wrong_shape();
        for (int j = 0; j < 3; ++j) {
            const nlohmann::json& entry = row[static_cast<std::size_t>(j)];
            if (!entry.is_number()) wrong_shape();
            gradient(i, j) = entry.get<double>();
        }
    }
    return gradient;
}

PathSegment read_segment(const JsonReader& reader) {
    reader.only({"velocity_gradient_per_s", "duration_s", "outputs"});
    PathSegment segment{read_velocity_gradient(reader), positive(reader, "duration_s"),
                        reader.integer("outputs")};
    if (segment.outputs < 1 || static_cast<double>(segment.outputs) > most_outputs)
        reader.fail("outputs", fmt::format("= {} (expected 1 to {:.0f} rows).",
                                           segment.outputs, most_outputs));
    return segment;
}

material::Parameters read_parameters(const JsonReader& reader) {
    material::Parameters parameters;
    material::set_model(
        parameters, "equation_of_state",
        reader.word("equation_of_state", material::equation_of_state_names()));
    material::set_model(
        parameters, "strength",
        reader.word("strength", material::strength_names(), "dislocation"));
    const JsonReader values = reader.object_or_empty("parameters");
    for (const std::string& name : values.keys()) {
        if (name == "strength" || name == "equation_of_state")
            values.fail(name, "does not belong here. Put it beside \"parameters\".");
        const double value = values.number(name);
        try {
            material::set_parameter(parameters, name, value);
        } catch (const InputError& error) {
            throw InputError(
                fmt::format("{}: parameters: {}", reader.where(), error.what()));
        }
    }
    check_strength(reader, parameters);
    return parameters;
}

}  // namespace

DeformationPath read_deformation_path(const JsonReader& reader) {
    reader.only({"equation_of_state", "strength", "parameters",
                 "orientation_quaternion_wxyz", "time_step_s", "segments"});
    DeformationPath path{read_parameters(reader),
                         read_orientation(reader),
                         positive(reader, "time_step_s"),
                         {}};
    for (const JsonReader& segment : reader.objects("segments"))
        path.segments.push_back(read_segment(segment));
    if (path.segments.empty())
        reader.fail("segments", "is empty. Give at least one segment.");
    double steps = 0;
    for (const PathSegment& segment : path.segments)
        steps += segment.duration / path.time_step;
    if (steps > most_steps)
        reader.fail("time_step_s", fmt::format("= {} makes {:.3g} steps of the segments "
                                               "(at most {:.0e}). Choose a larger step.",
                                               path.time_step, steps, most_steps));
    return path;
}

}  // namespace taylorcal::commands
