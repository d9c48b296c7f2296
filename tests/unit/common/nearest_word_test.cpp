#include "common/nearest_word.hpp"

#include <catch2/catch.hpp>

using taylorcal::nearest_hint;

TEST_CASE("hints are near words only", "[nearest_word]") {
    const std::vector<std::string> words = {"velocity_m_s", "shape", "lot"};
    CHECK(nearest_hint("velocity_mm_s", words) == " (did you mean \"velocity_m_s\"?)");
    CHECK(nearest_hint("shap", words, " Is \"", "\" meant?") == " Is \"shape\" meant?");
    CHECK(nearest_hint("temperature", words).empty());
}
