#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace taylorcal {
class JsonReader;
}

namespace taylorcal::emulator {

/// Runs that no member has learnt from, and how far the network is from them: it tells
/// how exact the network is near a point, for that differs much over the inputs' ranges.
struct HeldOut {
    std::vector<std::string> categories;  ///< of each row; "all" where there is none
    Eigen::MatrixXd places;  ///< [rows x used inputs] as the network sees them
    /// [rows x outputs] database less network, divided by `divide_by`; NaN where the run
    /// has no such output.
    Eigen::MatrixXd errors;

    bool empty() const { return categories.empty(); }
};

/// Runs next to a point that tell the error there.
inline constexpr Eigen::Index neighbours = 30;

/// Second moment of the errors of the `neighbours` nearest rows of a category value, of
/// the outputs named by `columns`; `whole` is that of all its rows, counts as one row
/// more, and is returned where there are no more rows than neighbours.
Eigen::MatrixXd covariance_near(const HeldOut& held_out, const std::string& category,
                                const Eigen::VectorXd& place,
                                const std::vector<Eigen::Index>& columns,
                                const Eigen::MatrixXd& whole);

nlohmann::json to_json(const HeldOut& held_out);
/// `reader`: of what to_json gives. InputError if its parts differ in length.
HeldOut held_out_from(const JsonReader& reader);

}  // namespace taylorcal::emulator
