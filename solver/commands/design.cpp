#include "solver/commands/design.hpp"

#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <charconv>
#include <numeric>
#include <set>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal::commands {
namespace {

/// The inputs that every row has, besides parameters of the material and effects.
const std::vector<std::string> shot_inputs = {
    "velocity_m_s", "initial_diameter_mm", "length_to_diameter", "initial_temperature_K"};

bool is_effect(const std::string& name) {
    const std::vector<std::string> names = effects::effect_names();
    return std::find(names.begin(), names.end(), name) != names.end();
}

void check_input_names(const Design& design, const std::string& where) {
    std::set<std::string> seen;
    for (const std::string& name : design.input_names) {
        require_known_input(name, where);
        require(
            seen.insert(name).second,
            fmt::format("{}: input \"{}\" occurs twice. Keep one column.", where, name));
    }
    for (const std::string& name : shot_inputs)
        require(seen.contains(name),
                fmt::format("{}: input \"{}\" is missing. Add the column.", where, name));
}

void check_tables(const Design& design, const std::string& where) {
    const std::size_t rows = design.rows();
    require(rows > 0, where + ": there is no row. Give at least one run.");
    require(
        design.seed.size() == rows && design.shape.size() == rows &&
            static_cast<std::size_t>(design.inputs.rows()) == rows &&
            static_cast<std::size_t>(design.inputs.cols()) == design.input_names.size(),
        fmt::format("{}: run_id has {} rows, seed {}, shape {}, inputs {} x {} with {} "
                    "names (all must agree). Make the file again.",
                    where, rows, design.seed.size(), design.shape.size(),
                    design.inputs.rows(), design.inputs.cols(),
                    design.input_names.size()));
    std::set<std::int64_t> seen;
    for (const std::int64_t id : design.run_id)
        require(seen.insert(id).second,
                fmt::format("{}: run_id {} occurs twice. Number the runs uniquely.",
                            where, id));
}

std::size_t parse_index(const std::string& text, const std::string& rows) {
    std::size_t value = 0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), value);
    require(error == std::errc{} && end == text.data() + text.size(),
            fmt::format("--rows {} (expected first:last, as in 0:50).", rows));
    return value;
}

}  // namespace

void require_known_input(const std::string& name, const std::string& where) {
    std::vector<std::string> known = shot_inputs;
    for (const auto& info : material::parameter_list()) known.push_back(info.name);
    for (const std::string& effect : effects::effect_names()) known.push_back(effect);
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    throw InputError(fmt::format(
        "{}: input \"{}\" is unknown{}. Inputs are {} and the names that \"solver "
        "parameters\" and \"solver effects\" list.",
        where, name, nearest_hint(name, known), fmt::join(shot_inputs, ", ")));
}

Design Design::subset(const std::vector<std::size_t>& rows) const {
    Design part;
    part.input_names = input_names;
    part.inputs.resize(static_cast<Eigen::Index>(rows.size()), inputs.cols());
    for (const std::size_t row : rows) {
        part.inputs.row(static_cast<Eigen::Index>(part.rows())) =
            inputs.row(static_cast<Eigen::Index>(row));
        part.run_id.push_back(run_id[row]);
        part.seed.push_back(seed[row]);
        part.shape.push_back(shape[row]);
    }
    return part;
}

std::vector<std::size_t> Design::order_by_run_id() const {
    std::vector<std::size_t> order(rows());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return run_id[a] < run_id[b]; });
    return order;
}

std::vector<std::size_t> parse_rows(const std::string& text, std::size_t count) {
    const std::size_t colon = text.find(':');
    require(colon != std::string::npos,
            fmt::format("--rows {} (expected first:last, as in 0:50).", text));
    const std::string before = text.substr(0, colon);
    const std::string after = text.substr(colon + 1);
    const std::size_t first = before.empty() ? 0 : parse_index(before, text);
    const std::size_t last = after.empty() ? count : parse_index(after, text);
    require(first < last && last <= count,
            fmt::format("--rows {} (the design has rows 0:{}). Choose rows within it.",
                        text, count));
    std::vector<std::size_t> rows(last - first);
    std::iota(rows.begin(), rows.end(), first);
    return rows;
}

Design read_design_tables(const Hdf5Reader& file, const std::filesystem::path& path) {
    Design design;
    design.run_id = file.integers("run_id");
    design.seed = file.integers("seed");
    design.shape = file.texts("shape");
    design.inputs = file.matrix("inputs");
    design.input_names = file.texts_attribute("names", "inputs");
    check_tables(design, path.string());
    check_input_names(design, path.string());
    return design;
}

Design read_design(const std::filesystem::path& path) {
    const Hdf5Reader file(path);
    file.expect_schema("taylorcal/design/1");
    return read_design_tables(file, path);
}

std::vector<impact::ImpactCase> make_cases(const Design& design,
                                           const Configuration& configuration,
                                           const std::filesystem::path& path) {
    std::vector<impact::ImpactCase> cases;
    for (std::size_t row = 0; row < design.rows(); ++row) {
        const std::string where =
            fmt::format("{}, run {}", path.string(), design.run_id[row]);
        Configuration of_run = configuration;
        Shot shot;
        double length_to_diameter = 0;
        try {
            shot.shape = design.shape[row];
            require(design.seed[row] >= 0,
                    fmt::format("seed = {} (expected 0 or more).", design.seed[row]));
            shot.seed = static_cast<std::uint64_t>(design.seed[row]);
            for (std::size_t i = 0; i < design.input_names.size(); ++i) {
                const std::string& name = design.input_names[i];
                const double value = design.inputs(static_cast<Eigen::Index>(row),
                                                   static_cast<Eigen::Index>(i));
                if (name == "velocity_m_s")
                    shot.velocity_m_s = value;
                else if (name == "initial_diameter_mm")
                    shot.initial_diameter_mm = value;
                else if (name == "length_to_diameter")
                    length_to_diameter = value;
                else if (name == "initial_temperature_K")
                    shot.initial_temperature_K = value;
                else
                    set_input(of_run, name, value);
            }
        } catch (const InputError& error) {
            throw InputError(where + ": " + error.what());
        }
        shot.initial_length_mm = length_to_diameter * shot.initial_diameter_mm;
        cases.push_back(make_case(shot, of_run, where));
    }
    return cases;
}

bool set_input(Configuration& of_run, const std::string& name, double value) {
    if (std::find(shot_inputs.begin(), shot_inputs.end(), name) != shot_inputs.end())
        return false;
    if (is_effect(name))
        effects::set_amplitude(of_run.effects, name, value);
    else
        material::set_parameter(of_run.material, name, value);
    return true;
}

void write_design_tables(Hdf5Writer& file, const Design& design) {
    file.integers("run_id", design.run_id);
    file.integers("seed", design.seed);
    file.texts("shape", design.shape);
    file.matrix("inputs", design.inputs);
    file.attribute("names", design.input_names, "inputs");
}

}  // namespace taylorcal::commands
