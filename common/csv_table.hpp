#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace taylorcal {

/// A comma-separated table in UTF-8 with a header line; quoted cells may hold commas and
/// doubled quotes. Blanks around a cell's text do not count, nor do rows of empty cells;
/// lines end in LF, CR LF or CR. Errors name file, line (the header is line 1), column
/// and value.
class CsvTable {
  public:
    static CsvTable from_file(const std::filesystem::path& path);

    std::string file() const { return path_.string(); }
    std::size_t rows() const { return cells_.size(); }
    const std::vector<std::string>& columns() const { return columns_; }
    bool has(const std::string& column) const;
    /// The cell's text; InputError if the column is missing.
    const std::string& text(std::size_t row, const std::string& column) const;
    /// The cell's number, or nothing when the cell is empty. InputError if not a number.
    std::optional<double> number(std::size_t row, const std::string& column) const;
    /// "<file>, line n" of a row, to start a message with.
    std::string place(std::size_t row) const;
    /// Throws InputError "<file>, line n, column c: value "v" <problem>".
    [[noreturn]] void fail(std::size_t row, const std::string& column,
                           const std::string& problem) const;

  private:
    std::size_t index(const std::string& column) const;
    std::filesystem::path path_;
    std::vector<std::string> columns_;
    std::vector<std::vector<std::string>> cells_;
    std::vector<std::size_t> lines_;
};

}  // namespace taylorcal
