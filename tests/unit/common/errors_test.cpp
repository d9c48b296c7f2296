#include "common/errors.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;

TEST_CASE("a program's exit status tells whose fault it was", "[errors]") {
    CHECK(guarded_main("test", [] { return 0; }) == 0);
    CHECK(guarded_main("test", []() -> int { throw InputError("wrong input"); }) == 1);
    CHECK(guarded_main("test", []() -> int { throw NumericalError("NaN"); }) == 2);
    CHECK(guarded_main("test", []() -> int { throw std::logic_error("bug"); }) == 2);
}

TEST_CASE("require throws only when its condition fails", "[errors]") {
    CHECK_NOTHROW(require(true, "fine"));
    CHECK_THROWS_WITH(require(false, "key = -1 (must be positive)"),
                      "key = -1 (must be positive)");
}
