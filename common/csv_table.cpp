#include "common/csv_table.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal {

namespace {

struct Record {
    std::vector<std::string> cells;
    std::size_t line;
};

/// Splits a whole text into records (RFC 4180); lines without any text are skipped.
class RecordSplitter {
  public:
    RecordSplitter(const std::string& text, std::string file)
        : text_(text), file_(std::move(file)) {}

    std::vector<Record> split() {
        skip_byte_order_mark();
        while (position_ < text_.size()) read_record();
        return std::move(records_);
    }

  private:
    void skip_byte_order_mark() {
        if (text_.starts_with("\xEF\xBB\xBF")) position_ = 3;
    }

    void read_record() {
        Record record{{}, line_};
        bool more = true;
        while (more) {
            record.cells.push_back(at('"') ? quoted_cell() : plain_cell());
            more = at(',');
            if (more) ++position_;
        }
        if (at('\r')) ++position_;
        require(position_ == text_.size() || at('\n'),
                fmt::format("{}, line {}: text after a closing quote. Double the quotes "
                            "inside a quoted cell.",
                            file_, line_));
        if (at('\n')) ++line_;
        ++position_;
        const bool blank = record.cells.size() == 1 && record.cells.front().empty();
        if (!blank) records_.push_back(std::move(record));
    }

    std::string plain_cell() {
        const std::size_t end =
            std::min(text_.find_first_of(",\r\n", position_), text_.size());
        const std::string cell = text_.substr(position_, end - position_);
        position_ = end;
        const std::size_t first = cell.find_first_not_of(" \t");
        if (first == std::string::npos) return "";
        return cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
    }

    std::string quoted_cell() {
        const std::size_t opened = line_;
        std::string cell;
        for (++position_; position_ < text_.size(); ++position_) {
            if (at('"')) {
                ++position_;
                if (!at('"')) return cell;
            }
            if (at('\n')) ++line_;
            cell += text_[position_];
        }
        throw InputError(fmt::format(
            "{}, line {}: a quoted cell is never closed. Add the missing quote.", file_,
            opened));
    }

    bool at(char character) const {
        return position_ < text_.size() && text_[position_] == character;
    }

    const std::string& text_;
    std::string file_;
    std::size_t position_ = 0;
    std::size_t line_ = 1;
    std::vector<Record> records_;
};

}  // namespace

CsvTable CsvTable::from_file(const std::filesystem::path& path) {
    const std::string text = read_text(path);
    std::vector<Record> records = RecordSplitter(text, path.string()).split();
    require(!records.empty(),
            fmt::format("{}: the table is empty. Its first line must name the columns.",
                        path.string()));
    CsvTable table;
    table.path_ = path;
    table.columns_ = std::move(records.front().cells);
    for (const std::string& column : table.columns_) {
        require(std::ranges::count(table.columns_, column) == 1,
                fmt::format("{}, line {}: column \"{}\" appears twice. Keep one of them.",
                            path.string(), records.front().line, column));
    }
    for (std::size_t i = 1; i < records.size(); ++i) {
        Record& record = records[i];
        require(
            record.cells.size() == table.columns_.size(),
            fmt::format("{}, line {}: {} cells (expected {}, as in the header). Quote "
                        "a cell that holds a comma.",
                        path.string(), record.line, record.cells.size(),
                        table.columns_.size()));
        table.cells_.push_back(std::move(record.cells));
        table.lines_.push_back(record.line);
    }
    require(table.rows() > 0,
            fmt::format(
                "{}: the table is empty: it has a header but no rows. Add at least one "
                "row.",
                path.string()));
    return table;
}

bool CsvTable::has(const std::string& column) const {
    return std::ranges::find(columns_, column) != columns_.end();
}

std::size_t CsvTable::index(const std::string& column) const {
    const auto found = std::ranges::find(columns_, column);
    if (found == columns_.end()) {
        throw InputError(fmt::format(
            "{}: column \"{}\" is missing{}. The columns are: {}.", path_.string(),
            column, nearest_hint(column, columns_, " (is \"", "\" meant?)"),
            fmt::join(columns_, ", ")));
    }
    return static_cast<std::size_t>(found - columns_.begin());
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
    return cells_.at(row)[index(column)];
}

std::optional<double> CsvTable::number(std::size_t row, const std::string& column) const {
    const std::string& cell = text(row, column);
    if (cell.empty()) return std::nullopt;
    double value = 0;
    const char* end = cell.data() + cell.size();
    const auto [stopped, problem] = std::from_chars(cell.data(), end, value);
    if (problem != std::errc{} || stopped != end || !std::isfinite(value)) {
        fail(row, column, "is not a number. Write it as 12.5, or leave the cell empty.");
    }
    return value;
}

void CsvTable::fail(std::size_t row, const std::string& column,
                    const std::string& problem) const {
    throw InputError(fmt::format("{}, line {}, column {}: value \"{}\" {}",
                                 path_.string(), lines_.at(row), column,
                                 has(column) ? text(row, column) : "", problem));
}

}  // namespace taylorcal
