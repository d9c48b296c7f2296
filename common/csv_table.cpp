#include "common/csv_table.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/nearest_word.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include <boost/locale/utf.hpp>
#include <fmt/core.h>
#include <fmt/ranges.h>

namespace taylorcal {

namespace {

struct Record {
    std::vector<std::string> cells;
    std::size_t line;
};

/// Whether a line ends with the character at `position`; CR LF ends one line.
bool ends_line(std::string_view text, std::size_t position) {
    return text[position] == '\n' ||
           (text[position] == '\r' && text.substr(position + 1, 1) != "\n");
}

void require_utf8(const std::string& text, const std::string& file) {
    using Utf8 = boost::locale::utf::utf_traits<char>;
    std::size_t line = 1;
    for (auto at = text.begin(); at != text.end();) {
        const auto first = at;
        if (!boost::locale::utf::is_valid_codepoint(Utf8::decode(at, text.end())))
            throw InputError(fmt::format(
                "{}, line {}: the byte 0x{:02X} is not UTF-8. Save the table as \"CSV "
                "UTF-8\".",
                file, line, static_cast<unsigned char>(*first)));
        if (ends_line(text, static_cast<std::size_t>(first - text.begin()))) ++line;
    }
}

/// The text with names in place of blanks that look like a space or like nothing.
std::string shown(std::string text) {
    const std::pair<std::string_view, std::string_view> blanks[] = {
        {"\u00A0", "<no-break space>"},
        {"\u202F", "<narrow no-break space>"},
        {"\u2007", "<figure space>"},
        {"\u2009", "<thin space>"},
        {"\u200B", "<zero-width space>"}};
    for (const auto& [blank, name] : blanks)
        for (std::size_t at = text.find(blank); at != std::string::npos;
             at = text.find(blank, at))
            text.replace(at, blank.size(), name);
    return text;
}

std::string trimmed(const std::string& cell) {
    constexpr const char* blanks = " \t\r\n";
    const std::size_t first = cell.find_first_not_of(blanks);
    if (first == std::string::npos) return "";
    return cell.substr(first, cell.find_last_not_of(blanks) - first + 1);
}

/// Splits a whole text into records (RFC 4180); those without any text are skipped.
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
        require(position_ == text_.size() || at('\n') || at('\r'),
                fmt::format("{}, line {}: text after a closing quote. Double the quotes "
                            "inside a quoted cell.",
                            file_, line_));
        if (at('\r')) ++position_;
        if (at('\n')) ++position_;
        ++line_;
        const bool blank = std::ranges::all_of(record.cells, &std::string::empty);
        if (!blank) records_.push_back(std::move(record));
    }

    std::string plain_cell() {
        const std::size_t end =
            std::min(text_.find_first_of(",\r\n", position_), text_.size());
        const std::string cell = text_.substr(position_, end - position_);
        position_ = end;
        return trimmed(cell);
    }

    std::string quoted_cell() {
        const std::size_t opened = line_;
        std::string cell;
        for (++position_; position_ < text_.size(); ++position_) {
            if (at('"')) {
                ++position_;
                if (!at('"')) return trimmed(cell);
            }
            if (ends_line(text_, position_)) ++line_;
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
    require_utf8(text, path.string());
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

std::string CsvTable::place(std::size_t row) const {
    return fmt::format("{}, line {}", path_.string(), lines_.at(row));
}

std::size_t CsvTable::index(const std::string& column) const {
    const auto found = std::ranges::find(columns_, column);
    if (found == columns_.end()) {
        throw InputError(fmt::format(
            "{}: column \"{}\" is missing{}. The columns are: {}.", path_.string(),
            column, nearest_hint(column, columns_, " (is \"", "\" meant?)"),
            shown(fmt::format("{}", fmt::join(columns_, ", ")))));
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
    throw InputError(fmt::format("{}, column {}: value \"{}\" {}", place(row), column,
                                 has(column) ? shown(text(row, column)) : "", problem));
}

}  // namespace taylorcal
