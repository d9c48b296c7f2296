#pragma once

#include <string>
#include <vector>

namespace taylorcal::emulator {

/// What the network sees of an input: the value, its logarithm, or its square root (for
/// one that matters most near zero).
enum class Transform { linear, log10, square_root };

/// Their names in files.
const std::vector<std::string>& transform_words();
/// `word`: one of transform_words().
Transform transform_of(const std::string& word);
const std::string& word_of(Transform transform);

/// t(value); not finite where there is none.
double transformed(Transform transform, double value);

}  // namespace taylorcal::emulator
