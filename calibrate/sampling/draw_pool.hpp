#pragma once

#include "common/hdf5_file.hpp"

#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// One draw of all parameters, chosen among its nested ones.
struct ChosenDraw {
    std::uint64_t number = 0;
    double log_weight = 0;
    double log_priority = 0;  ///< ln(weight / u), u uniform and fixed by the number
    Eigen::VectorXd unit;     ///< point of the unit cube
    std::size_t level = 0;    ///< of the relative spread
};

/// Weighted draws: points of the unit cube, levels of the spread, weights that sum to
/// one.
struct WeightedDraws {
    RowMatrix units;
    std::vector<std::size_t> levels;
    Eigen::VectorXd weights;
};

/// Keeps a fixed number of draws from a stream of any length by priority sampling
/// (Duffield, Lund, Thorup 2007, doi 10.1145/1314690.1314696): those of the highest
/// weight / u stay, with weight max(weight, threshold), so that every weighted sum over
/// the pool is unbiased. Which ones stay does not depend on the order of arrival.
class DrawPool {
  public:
    explicit DrawPool(std::size_t capacity) : capacity_(capacity) {}
    void add(std::vector<ChosenDraw> draws);
    /// Whether a draw of this priority could stay: saves making those that cannot.
    bool may_stay(double log_priority) const { return log_priority >= threshold_; }
    /// Everything held, draw after draw, to be restored in an empty pool of the same
    /// capacity.
    std::vector<double> numbers() const;
    void restore(const std::vector<double>& numbers, std::size_t dimensions);
    /// The pool in the order of the draws' numbers.
    WeightedDraws weighted() const;

  private:
    void shrink();
    std::size_t capacity_;
    double threshold_ = -std::numeric_limits<double>::infinity();
    std::vector<ChosenDraw> draws_;  // up to capacity + 1 stay: the last is the threshold
};

/// Equally weighted draws by systematic resampling at (i + offset)/count.
WeightedDraws resample(const WeightedDraws& draws, std::size_t count, double offset);

}  // namespace taylorcal::calibrate
