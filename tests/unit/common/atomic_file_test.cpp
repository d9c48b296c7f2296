#include "common/atomic_file.hpp"

#include "common/errors.hpp"
#include "temporary_folder.hpp"

#include <fstream>

#include <catch2/catch.hpp>
#include <sys/stat.h>

namespace fs = std::filesystem;
using taylorcal::InputError;

TEST_CASE("a failed write leaves the old file and nothing else", "[atomic]") {
    const taylorcal::testing::TemporaryFolder folder;
    const fs::path path = folder / "out.txt";
    taylorcal::write_text_atomically(path, "old");
    const auto half_then_fail = [](const fs::path& temporary) {
        std::ofstream(temporary) << "half";
        throw std::runtime_error("stop");
    };
    CHECK_THROWS_WITH(taylorcal::write_atomically(path, half_then_fail), "stop");
    CHECK(taylorcal::read_text(path) == "old");
    CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("the final name does not exist before all is written", "[atomic]") {
    const taylorcal::testing::TemporaryFolder folder;
    const fs::path path = folder / "out.txt";
    taylorcal::write_atomically(path, [&](const fs::path& temporary) {
        std::ofstream(temporary) << "whole";
        CHECK_FALSE(fs::exists(path));
        CHECK(temporary.parent_path() == path.parent_path());
    });
    CHECK(taylorcal::read_text(path) == "whole");
}

TEST_CASE("two writers of one name do not mix", "[atomic]") {
    const taylorcal::testing::TemporaryFolder folder;
    const fs::path path = folder / "out.txt";
    taylorcal::write_atomically(path, [&](const fs::path& temporary) {
        CHECK_THROWS_WITH(taylorcal::write_text_atomically(path, "other"),
                          Catch::Contains("another process is writing it"));
        std::ofstream(temporary) << "whole";
    });
    CHECK(taylorcal::read_text(path) == "whole");
    taylorcal::write_text_atomically(path, "next");
    CHECK(taylorcal::read_text(path) == "next");
}

TEST_CASE("a missing folder or file is the user's to mend", "[atomic]") {
    const taylorcal::testing::TemporaryFolder folder;
    CHECK_THROWS_AS(taylorcal::write_text_atomically(folder / "no/out.txt", "x"),
                    InputError);
    CHECK_THROWS_AS(taylorcal::read_text(folder / "absent"), InputError);
    CHECK_THROWS_AS(taylorcal::read_text(folder.path()), InputError);
}

TEST_CASE("nothing but a regular file is replaced", "[atomic]") {
    const taylorcal::testing::TemporaryFolder folder;
    const fs::path pipe = folder / "pipe", link = folder / "link", self = folder.path();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    fs::create_symlink(pipe, link);
    const fs::path path = GENERATE_COPY(pipe, link, self);
    const auto before = fs::symlink_status(path).type();
    CHECK_THROWS_WITH(taylorcal::write_text_atomically(path, "x"),
                      Catch::Contains(path.string() + ": cannot be written (it is a") &&
                          Catch::Contains("another name"));
    CHECK(fs::symlink_status(path).type() == before);
    CHECK_THROWS_WITH(taylorcal::write_text_atomically("", "x"),
                      Catch::Contains("is empty"));
}

TEST_CASE("an output that is an input is refused", "[atomic]") {
    const taylorcal::testing::TemporaryFolder folder;
    const fs::path path = folder / "a.txt";
    taylorcal::write_text_atomically(path, "x");
    fs::create_hard_link(path, folder / "same.txt");
    CHECK_NOTHROW(taylorcal::require_writable(path, {"", folder / "absent"}));
    CHECK_THROWS_WITH(taylorcal::require_writable(path, {"", folder / "same.txt"}),
                      Catch::Contains("a.txt: is an input of this command"));
}
