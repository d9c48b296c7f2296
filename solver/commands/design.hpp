#pragma once

#include "common/hdf5_file.hpp"
#include "solver/commands/shot.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace taylorcal::commands {

/// The inputs of many runs, one row a run (schema taylorcal/design/1).
struct Design {
    std::vector<std::string> input_names;
    std::vector<std::int64_t> run_id;
    std::vector<std::int64_t> seed;
    std::vector<std::string> shape;
    RowMatrix inputs;  ///< one column a name

    std::size_t rows() const { return run_id.size(); }
    /// The chosen rows, in the order given.
    Design subset(const std::vector<std::size_t>& rows) const;
    /// The rows' order by run_id.
    std::vector<std::size_t> order_by_run_id() const;
};

/// Rows "first:last" of a design, from 0, `last` excluded; either may be left out.
/// InputError when malformed or empty.
std::vector<std::size_t> parse_rows(const std::string& text, std::size_t count);

/// InputError that begins with `where` unless a design may have an input of this name.
void require_known_input(const std::string& name, const std::string& where);

/// Reads the datasets that a design and a database share. InputError when their lengths
/// differ, an input or shape is unknown, a run_id occurs twice, or there is no row.
Design read_design_tables(const Hdf5Reader& file, const std::filesystem::path& path);

/// Reads a design file.
Design read_design(const std::filesystem::path& path);

/// The cases of all rows. InputError that names the run when a value is out of range.
std::vector<impact::ImpactCase> make_cases(const Design& design,
                                           const Configuration& configuration,
                                           const std::filesystem::path& path);

/// Sets the constant of the material or the amplitude that an input stands for; false
/// when it is an input of the shot. InputError for a value out of range.
bool set_input(Configuration& of_run, const std::string& name, double value);

/// Writes the tables that `read_design_tables` reads.
void write_design_tables(Hdf5Writer& file, const Design& design);

}  // namespace taylorcal::commands
