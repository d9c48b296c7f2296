#pragma once

#include "emulator/inference/model.hpp"
#include "emulator/training/dataset.hpp"
#include "emulator/training/split.hpp"
#include "emulator/training/train_config.hpp"

#include <vector>

#include <Eigen/Core>

namespace taylorcal::emulator {

/// Standardised rows as the network sees them, one column a row of the database.
struct Samples {
    Eigen::MatrixXf inputs;   ///< [network inputs x rows]
    Eigen::MatrixXf targets;  ///< [outputs x rows], 0 where masked
    Eigen::MatrixXf mask;     ///< [outputs x rows], 1 where there is a value, else 0

    Eigen::Index rows() const { return inputs.cols(); }
};

/// The model's description of inputs, category and outputs, with ranges of all rows and
/// scales of the training rows. InputError if a column cannot be learnt.
Model describe(const TrainConfig& config, const Dataset& data, const Split& split);

/// Outputs divided by the inputs named in `divide_by` [rows x outputs].
RowMatrix divided_outputs(const Model& model, const Dataset& data);

/// Standardises the rows named.
Samples standardise(const Model& model, const Dataset& data,
                    const std::vector<Eigen::Index>& rows);

}  // namespace taylorcal::emulator
