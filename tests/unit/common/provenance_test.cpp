#include "common/provenance.hpp"

#include "common/sha256.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

TEST_CASE("provenance is the same for the same run", "[provenance]") {
    const nlohmann::json configuration = {{"draws", 10}};
    const auto first = taylorcal::provenance("calibrate", 3, configuration);
    CHECK(first == taylorcal::provenance("calibrate", 3, configuration));
    CHECK(first["configuration"] == configuration);
    CHECK(first["configuration_digest"] == taylorcal::sha256("{\"draws\":10}"));
    CHECK(first["seed"] == 3);
    CHECK(first != taylorcal::provenance("calibrate", 3, {{"draws", 11}}));
}
