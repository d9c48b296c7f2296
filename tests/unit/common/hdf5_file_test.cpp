#include "common/hdf5_file.hpp"

#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "temporary_folder.hpp"

#include <cmath>
#include <thread>

#include <catch2/catch.hpp>
#include <unistd.h>

namespace fs = std::filesystem;
using Catch::Matchers::Contains;
using namespace taylorcal;

namespace {

void write_sample(const fs::path& path) {
    RowMatrix matrix(2, 3);
    matrix << 1, 2, 3, 4, 5, NAN;
    Hdf5Writer file(path);
    file.attribute("schema", "test/1");
    file.matrix("inputs", matrix);
    file.attribute("names", std::vector<std::string>{"a", "b", "µ"}, "inputs");
    file.numbers("deep/down/numbers", {0.1, -1e300});
    file.integers("ids", {1, -(std::int64_t{1} << 60)});
    file.texts("words", {"one", "", "three, long and with an umlaut: ü"});
    file.texts("no_words", {});
    file.attribute("draws", 1e9);
    file.attribute("none", std::vector<std::string>{});
    file.close();
}

}  // namespace

TEST_CASE("what is written to HDF5 comes back", "[hdf5]") {
    const testing::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    const Hdf5Reader file(folder / "a.h5");
    CHECK_NOTHROW(file.expect_schema("test/1"));
    const RowMatrix matrix = file.matrix("inputs");
    REQUIRE(matrix.rows() == 2);
    REQUIRE(matrix.cols() == 3);
    CHECK(matrix(0, 1) == 2);
    CHECK(matrix(1, 0) == 4);
    CHECK(std::isnan(matrix(1, 2)));
    CHECK(file.texts_attribute("names", "inputs") ==
          std::vector<std::string>{"a", "b", "µ"});
    CHECK(file.numbers("deep/down/numbers") == std::vector<double>{0.1, -1e300});
    CHECK(file.integers("ids") == std::vector<std::int64_t>{1, -(std::int64_t{1} << 60)});
    CHECK(file.texts("words")[2] == "three, long and with an umlaut: ü");
    CHECK(file.texts("words")[1].empty());
    CHECK(file.texts("no_words").empty());
    CHECK(file.number_attribute("draws") == 1e9);
    CHECK(file.texts_attribute("none").empty());
    CHECK(file.has("deep/down"));
    CHECK_FALSE(file.has("deep/other/numbers"));
}

TEST_CASE("equal values give equal bytes at another time", "[hdf5]") {
    const testing::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    // HDF5 counts times in whole seconds.
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    write_sample(folder / "b.h5");
    CHECK(read_text(folder / "a.h5") == read_text(folder / "b.h5"));
}

TEST_CASE("a truncated or foreign file is refused with the remedy", "[hdf5]") {
    const testing::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    const auto size = fs::file_size(folder / "a.h5");
    const auto share = GENERATE(0.0, 0.01, 0.5, 0.99);
    fs::resize_file(folder / "a.h5",
                    static_cast<std::uintmax_t>(static_cast<double>(size) * share));
    CHECK_THROWS_WITH(Hdf5Reader(folder / "a.h5"), Contains("a.h5") &&
                                                       Contains("truncated") &&
                                                       Contains("make it again"));
    CHECK_THROWS_WITH(Hdf5Reader(folder / "absent.h5"), Contains("no such file"));
}

TEST_CASE("a file that cannot be read is not called damaged", "[hdf5]") {
    const testing::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    CHECK_THROWS_WITH(Hdf5Reader(folder.path()), Contains("it is a folder"));
    fs::permissions(folder.path(), fs::perms::all);
    fs::permissions(folder / "a.h5", fs::perms::none);
    // The superuser may read everything: access() asks for the real user.
    const ::uid_t self = ::getuid(), nobody = 65534;
    if (self == 0) REQUIRE(::setresuid(nobody, nobody, 0) == 0);
    CHECK_THROWS_WITH(Hdf5Reader(folder / "a.h5"),
                      Contains("a.h5: cannot be read (Permission denied)"));
    if (self == 0) REQUIRE(::setresuid(0, 0, 0) == 0);
}

TEST_CASE("an HDF5 file of another kind is named", "[hdf5]") {
    const testing::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    const Hdf5Reader file(folder / "a.h5");
    CHECK_THROWS_WITH(file.expect_schema("other/1"),
                      Contains("test/1 (expected other/1)"));
    CHECK_THROWS_WITH(file.matrix("absent"), Contains("\"absent\" is missing"));
    CHECK_THROWS_WITH(file.matrix("ids"), Contains("1 dimensions (expected 2)"));
    CHECK_THROWS_WITH(file.texts("ids"), Contains("does not hold texts"));
    CHECK_THROWS_WITH(file.numbers("words"), Contains("does not hold numbers"));
    CHECK_THROWS_WITH(file.integers("deep/down/numbers"),
                      Contains("does not hold integers"));
    CHECK_THROWS_WITH(file.text_attribute("absent"), Contains("missing"));
}

TEST_CASE("an unfinished HDF5 file never appears", "[hdf5]") {
    const testing::TemporaryFolder folder;
    {
        Hdf5Writer file(folder / "a.h5");
        file.numbers("x", {1});
    }
    CHECK(fs::is_empty(folder.path()));
    CHECK_THROWS_AS(Hdf5Writer(folder / "no/a.h5"), InputError);
}
