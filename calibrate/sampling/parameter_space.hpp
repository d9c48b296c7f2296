#pragma once

#include "calibrate/settings/settings.hpp"
#include "common/hdf5_file.hpp"

#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// Where a plain value lies from lower (0) to upper (1), in the logarithm if the prior is
/// uniform there; not the share of a normal prior.
double place_in_range(const Parameter& parameter, double value);

/// Maps between the unit cube, on which the prior is uniform, and plain values. A point
/// of the cube holds the shared parameters first, then each lot's own ones, lot by lot.
class ParameterSpace {
  public:
    ParameterSpace(std::vector<Parameter> parameters, std::vector<std::string> lots);

    std::size_t shared_count() const { return shared_.size(); }
    std::size_t per_lot_count() const { return per_lot_.size(); }
    std::size_t lot_count() const { return lots_.size(); }
    std::size_t size() const { return shared_.size() + lots_.size() * per_lot_.size(); }
    const std::vector<Parameter>& parameters() const { return parameters_; }

    /// Names of the coordinates, e.g. "hardening_coefficient", "rho...[house]".
    std::vector<std::string> names() const;
    /// The parameter behind coordinate `i`.
    const Parameter& parameter(std::size_t i) const;
    /// First coordinate of a lot's own parameters.
    std::size_t lot_offset(std::size_t lot) const {
        return shared_.size() + lot * per_lot_.size();
    }
    double value(std::size_t i, double unit) const;
    double unit(std::size_t i, double value) const;
    Eigen::VectorXd values(const Eigen::VectorXd& unit) const;

    /// Plain parameters of one lot in the order of the configuration, from the unit
    /// coordinates of the shared ones and of the lot's own ones.
    template <class Shared, class Own, class Row>
    void fill(const Shared& shared, const Own& own, Row&& row) const {
        for (std::size_t j = 0; j < shared_.size(); ++j)
            row(index(shared_[j])) = plain(parameters_[shared_[j]], shared(index(j)));
        for (std::size_t j = 0; j < per_lot_.size(); ++j)
            row(index(per_lot_[j])) = plain(parameters_[per_lot_[j]], own(index(j)));
    }
    /// The same for rows of whole points of the unit cube.
    RowMatrix lot_parameters(const RowMatrix& units, std::size_t lot) const;

  private:
    static Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }
    static double plain(const Parameter& parameter, double unit);

    std::vector<Parameter> parameters_;
    std::vector<std::string> lots_;
    std::vector<std::size_t> shared_;  // positions in parameters_
    std::vector<std::size_t> per_lot_;
};

}  // namespace taylorcal::calibrate
