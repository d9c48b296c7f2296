#include "common/json_reader.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "temporary_folder.hpp"

#include <catch2/catch.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;
using taylorcal::InputError;
using taylorcal::JsonReader;

namespace {

JsonReader reader(const std::string& text) { return {json::parse(text), "study.json"}; }

JsonReader read_file(const std::string& text) {
    const taylorcal::testing::TemporaryFolder folder;
    taylorcal::write_text_atomically(folder / "study.json", text);
    return JsonReader::from_file(folder / "study.json");
}

}  // namespace

TEST_CASE("values come back by name and type", "[json]") {
    const JsonReader r = read_file(
        R"({"a": 1.5, "n": 3, "big": 1e6, "on": true, "w": "fine", "list": [1, 2],
            "inner": {"deep": [{"x": 7}]}})");
    CHECK(r.number("a") == 1.5);
    CHECK(r.number("absent", 2.5) == 2.5);
    CHECK(r.integer("n") == 3);
    CHECK(r.integer("big") == 1000000);
    CHECK(r.boolean("on", false));
    CHECK(r.word("w", {"coarse", "fine"}) == "fine");
    CHECK(r.numbers("list") == std::vector<double>{1, 2});
    CHECK(r.object("inner").objects("deep")[0].integer("x") == 7);
    CHECK(r.object_or_empty("absent").keys().empty());
    CHECK_NOTHROW(r.only({"a", "n", "big", "on", "w", "list", "inner"}));
}

TEST_CASE("an unknown key is refused with the nearest known one", "[json]") {
    const JsonReader r = reader(R"({"solver": {"fidelty": "fine"}})");
    CHECK_THROWS_WITH(r.object("solver").only({"geometry", "fidelity"}),
                      Contains("study.json: solver.fidelty") &&
                          Contains("\"fidelity\" meant?") && Contains("geometry"));
    CHECK_THROWS_AS(r.only({"xyz"}), InputError);
}

TEST_CASE("a wrong value is named with its place, itself and what was expected",
          "[json]") {
    const JsonReader r =
        reader(R"({"s": "3", "half": 1.5, "list": [{"w": "coarze"}], "minus": -1})");
    CHECK_THROWS_WITH(r.number("s"),
                      Contains("study.json: s = \"3\"") && Contains("expected a number"));
    CHECK_THROWS_WITH(r.integer("half"), Contains("half = 1.5") && Contains("whole"));
    CHECK_THROWS_WITH(r.objects("list")[0].word("w", {"coarse", "fine"}),
                      Contains("list[0].w") && Contains("coarse, fine") &&
                          Contains("\"coarse\" meant?"));
    CHECK_THROWS_WITH(r.number_in("minus", 0, 2), Contains("= -1 (expected 0 to 2)"));
    CHECK_THROWS_WITH(r.number("absent"), Contains("absent is missing"));
    CHECK_THROWS_WITH(r.object("s"), Contains("expected an object"));
}

TEST_CASE("text that is not JSON is refused with line and column", "[json]") {
    CHECK_THROWS_WITH(read_file("{\n  \"a\": 1,\n  \"b\" 2\n}"),
                      Contains("study.json, line 3, column 7"));
    CHECK_THROWS_WITH(read_file("{x}"), Contains("line 1, column 2"));
    CHECK_THROWS_WITH(read_file("{\"a\": 1"), Contains("line 1"));
    CHECK_THROWS_WITH(read_file("[1]"), Contains("expected an object"));
    CHECK_THROWS_WITH(read_file("{\"a\": {\"b\": 1, \"b\": 2}}"),
                      Contains("\"b\" is given twice"));
    CHECK_THROWS_WITH(JsonReader::from_file("/nonexistent/x.json"),
                      Contains("cannot be read"));
}
