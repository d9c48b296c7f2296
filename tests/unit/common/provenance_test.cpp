#include "common/provenance.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

// Published vectors of 64-bit FNV-1a (Fowler, Noll, Vo; draft-eastlake-fnv).
TEST_CASE("the digest is FNV-1a", "[provenance]") {
    CHECK(taylorcal::digest("") == "cbf29ce484222325");
    CHECK(taylorcal::digest("a") == "af63dc4c8601ec8c");
    CHECK(taylorcal::digest("foobar") == "85944171f73967e8");
}

TEST_CASE("provenance is the same for the same run", "[provenance]") {
    const nlohmann::json configuration = {{"draws", 10}};
    const auto first = taylorcal::provenance("calibrate", 3, configuration);
    CHECK(first == taylorcal::provenance("calibrate", 3, configuration));
    CHECK(first["configuration"] == configuration);
    CHECK(first["seed"] == 3);
    CHECK(first != taylorcal::provenance("calibrate", 3, {{"draws", 11}}));
}
