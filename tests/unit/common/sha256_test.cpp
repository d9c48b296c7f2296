#include "common/sha256.hpp"

#include "common/atomic_file.hpp"
#include "temporary_folder.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;

TEST_CASE("SHA-256 of bytes and files is what sha256sum prints", "[sha256]") {
    const testing::TemporaryFolder folder;
    write_text_atomically(folder / "abc", "abc");
    CHECK(sha256("abc") ==
          "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256_of_file(folder / "abc") == sha256("abc"));
}
