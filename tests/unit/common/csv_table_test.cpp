#include "common/csv_table.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "temporary_folder.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using taylorcal::CsvTable;

namespace {

CsvTable table(const std::string& text) {
    const taylorcal::testing::TemporaryFolder folder;
    taylorcal::write_text_atomically(folder / "table.csv", text);
    return CsvTable::from_file(folder / "table.csv");
}

}  // namespace

TEST_CASE("plain, quoted and empty cells are read", "[csv]") {
    const CsvTable t = table(
        "\xEF\xBB\xBFid,note,x\r\n"
        "1,\"a, \"\"b\"\"\", 2.5 \r\n"
        "\r\n"
        "2,\"two\nlines\",\r\n"
        "3,,-1e3");
    REQUIRE(t.rows() == 3);
    CHECK(t.columns() == std::vector<std::string>{"id", "note", "x"});
    CHECK(t.text(0, "note") == "a, \"b\"");
    CHECK(t.text(1, "note") == "two\nlines");
    CHECK(t.number(0, "x") == 2.5);
    CHECK(t.number(1, "x") == std::nullopt);
    CHECK(t.number(2, "x") == -1000);
    CHECK(t.has("id"));
    CHECK_FALSE(t.has("ID"));
}

TEST_CASE("errors of a table name file, line, column and value", "[csv]") {
    // The quoted line break moves the third record to line 4.
    const CsvTable t = table("id,x\n1,\"2\n\"\n2,12 mm\n");
    CHECK_THROWS_WITH(t.number(1, "x"),
                      Contains("table.csv, line 4, column x: value \"12 mm\"") &&
                          Contains("not a number"));
    CHECK_THROWS_WITH(t.text(0, "y"), Contains("column \"y\" is missing"));
    CHECK_THROWS_WITH(table("velocity_m_s\n1\n").text(0, "velocity_mm_s"),
                      Contains("\"velocity_m_s\" meant?"));
    CHECK_THROWS_WITH(t.fail(1, "id", "is bad"),
                      Contains("line 4, column id: value \"2\" is bad"));
}

TEST_CASE("a malformed table is refused", "[csv]") {
    CHECK_THROWS_WITH(table("a,b\n1,2\n3\n"), Contains("line 3: 1 cells (expected 2"));
    CHECK_THROWS_WITH(table("a,a\n1,2\n"), Contains("appears twice"));
    CHECK_THROWS_WITH(table(""), Contains("empty"));
    CHECK_THROWS_WITH(table("a,b\n"), Contains("no rows"));
    CHECK_THROWS_WITH(table("a\n\"x\n"), Contains("line 2") && Contains("never closed"));
    CHECK_THROWS_WITH(table("a\n\"x\"y\n"), Contains("after a closing quote"));
    CHECK_THROWS_WITH(table("a\nnan\n").number(0, "a"), Contains("not a number"));
}

TEST_CASE("what spreadsheets add to a table does not count", "[csv]") {
    const CsvTable t = table("id,x\n,\n,,\n\" 1 \",\" 12.5\t\"\n , \n2,\n");
    REQUIRE(t.rows() == 2);
    CHECK(t.text(0, "id") == "1");
    CHECK(t.number(0, "x") == 12.5);
    CHECK(t.place(1).ends_with("table.csv, line 6"));
    CHECK_THROWS_WITH(table("a,b\n,\n"), Contains("no rows"));
}

TEST_CASE("lines may end in a carriage return alone", "[csv]") {
    const CsvTable t = table("id,x\r1,\"a\rb\"\r\r2,3");
    REQUIRE(t.rows() == 2);
    CHECK(t.text(0, "x") == "a\rb");
    CHECK(t.number(1, "x") == 3);
    CHECK(t.place(1).ends_with("line 5"));
}

TEST_CASE("a table that is not UTF-8 is refused by line", "[csv]") {
    CHECK_THROWS_WITH(table("id,note\n1,caf\xC3\xA9\n2,caf\xE9\n"),
                      Contains("table.csv, line 3: the byte 0xE9 is not UTF-8"));
    CHECK_THROWS_WITH(table("\xFF\xFEi"), Contains("line 1"));
    const auto bad = GENERATE("\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82",
                              "\x80", "\xF5\x80\x80\x80");
    CHECK_THROWS_WITH(table(std::string("a\n") + bad), Contains("line 2"));
    CHECK(table("a\n\xF0\x9F\x98\x80\xE2\x82\xAC\n").rows() == 1);
}

TEST_CASE("blanks that cannot be seen are shown", "[csv]") {
    const CsvTable t = table("id,x\xC2\xA0\n12.4\xC2\xA0,1\n");
    CHECK_THROWS_WITH(t.number(0, "id"), Contains("\"12.4<no-break space>\" is not a"));
    CHECK_THROWS_WITH(t.number(0, "x"), Contains("are: id, x<no-break space>."));
}
