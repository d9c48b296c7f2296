#pragma once

#include "common/hdf5_file.hpp"

namespace taylorcal::calibrate {

/// Every so-manieth row, so that at most `most` remain.
inline RowMatrix thinned(const RowMatrix& rows, Eigen::Index most) {
    const Eigen::Index stride = (rows.rows() + most - 1) / most;
    RowMatrix chosen((rows.rows() + stride - 1) / stride, rows.cols());
    for (Eigen::Index i = 0; i < chosen.rows(); ++i) chosen.row(i) = rows.row(i * stride);
    return chosen;
}

}  // namespace taylorcal::calibrate
