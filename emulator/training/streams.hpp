#pragma once

#include "common/random.hpp"

/// Random streams of training, so that no two uses share numbers.
namespace taylorcal::emulator::streams {

inline constexpr std::uint64_t split = 1;
inline constexpr std::uint64_t weights = 2;
inline constexpr std::uint64_t shuffle = 3;

}  // namespace taylorcal::emulator::streams
