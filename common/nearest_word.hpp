#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace taylorcal {

/// For messages: the member of `candidates` nearest to `text` by edit distance, between
/// two words of the message; empty when none is near.
std::string nearest_hint(std::string_view text,
                         const std::vector<std::string>& candidates,
                         std::string_view before = " (did you mean \"",
                         std::string_view after = "\"?)");

}  // namespace taylorcal
