#include "common/nearest_word.hpp"

#include <algorithm>
#include <numeric>

namespace taylorcal {

namespace {

/// Levenshtein distance: fewest insertions, deletions and replacements of one letter.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> previous(b.size() + 1);
    std::iota(previous.begin(), previous.end(), std::size_t{0});
    std::vector<std::size_t> current(b.size() + 1);
    for (std::size_t i = 0; i < a.size(); ++i) {
        current[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = previous[j] + (a[i] == b[j] ? 0 : 1);
            current[j + 1] = std::min({previous[j + 1] + 1, current[j] + 1, replaced});
        }
        std::swap(previous, current);
    }
    return previous.back();
}

std::string nearest_word(std::string_view text,
                         const std::vector<std::string>& candidates) {
    std::string best;
    // A word that shares less than half of its letters is a coincidence, not a hint.
    std::size_t smallest = std::max<std::size_t>(text.size() / 2, 2) + 1;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(text, candidate);
        if (distance < smallest) {
            smallest = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace

std::string nearest_hint(std::string_view text,
                         const std::vector<std::string>& candidates,
                         std::string_view before, std::string_view after) {
    const std::string near = nearest_word(text, candidates);
    return near.empty() ? near : std::string(before) + near + std::string(after);
}

}  // namespace taylorcal
