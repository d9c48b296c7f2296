#pragma once

#include "common/hdf5_file.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// What is known of one parameter, in plain values.
struct ParameterSummary {
    std::string name;
    double mean = 0;
    double sd = 0;
    double lower95 = 0;
    double median = 0;
    double upper95 = 0;
    double maximum = 0;  ///< at the best maximum
};

/// From equally weighted draws (rows) and the best maximum.
std::vector<ParameterSummary> summarise(const std::vector<std::string>& names,
                                        const RowMatrix& draws,
                                        const Eigen::RowVectorXd& maximum);

/// A table for people, one line a parameter.
std::string parameter_table(const std::vector<ParameterSummary>& summaries);

}  // namespace taylorcal::calibrate
