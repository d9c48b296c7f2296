#include "emulator/inference/transform.hpp"

#include <algorithm>
#include <cmath>

namespace taylorcal::emulator {

const std::vector<std::string>& transform_words() {
    static const std::vector<std::string> words{"linear", "log10", "square_root"};
    return words;
}

Transform transform_of(const std::string& word) {
    const auto& words = transform_words();
    return static_cast<Transform>(std::ranges::find(words, word) - words.begin());
}

const std::string& word_of(Transform transform) {
    return transform_words()[static_cast<std::size_t>(transform)];
}

double transformed(Transform transform, double value) {
    switch (transform) {
        case Transform::log10:
            return std::log10(value);
        case Transform::square_root:
            return std::sqrt(value);
        case Transform::linear:
            break;
    }
    return value;
}

}  // namespace taylorcal::emulator
