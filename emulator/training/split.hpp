#pragma once

#include "emulator/training/dataset.hpp"

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::emulator {

/// Rows to learn from and rows held out to judge by.
struct Split {
    std::vector<Eigen::Index> training;
    std::vector<Eigen::Index> validation;
};

/// Holds out `fraction` of each category value's rows (at least one of two). Which ones
/// follows from the seed and the row's id, not from its place in the file. Runs of a
/// cheaper solver are all learnt from: the others judge.
Split split_rows(const Dataset& data, double fraction, std::uint64_t seed);

}  // namespace taylorcal::emulator
