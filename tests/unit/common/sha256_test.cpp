#include "common/sha256.hpp"

#include "common/atomic_file.hpp"
#include "temporary_folder.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;

// The examples of FIPS 180-2, appendix B, and what `sha256sum` prints of nothing.
TEST_CASE("SHA-256 is that of the standard", "[sha256]") {
    CHECK(sha256("") ==
          "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK(sha256("abc") ==
          "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    CHECK(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
          "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    CHECK(sha256(std::string(1'000'000, 'a')) ==
          "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("a file's SHA-256 is that of its bytes", "[sha256]") {
    const testing::TemporaryFolder folder;
    write_text_atomically(folder / "abc", "abc");
    CHECK(sha256_of_file(folder / "abc") == sha256("abc"));
}
