#pragma once

#include <cmath>
#include <limits>

namespace taylorcal::calibrate {

/// ln of a sum and of the sum of squares of numbers given by their logarithms, safe from
/// overflow. The order of `add` and `merge` fixes the last bits.
class LogSum {
  public:
    void add(double log_value) {
        if (log_value == -std::numeric_limits<double>::infinity()) return;
        raise_to(log_value);
        const double value = std::exp(log_value - largest_);
        sum_ += value;
        sum_of_squares_ += value * value;
    }
    void merge(const LogSum& other) {
        if (other.sum_ == 0) return;
        raise_to(other.largest_);
        const double factor = std::exp(other.largest_ - largest_);
        sum_ += factor * other.sum_;
        sum_of_squares_ += factor * factor * other.sum_of_squares_;
    }
    /// ln of the sum; minus infinity if nothing was added.
    double value() const { return largest_ + std::log(sum_); }
    /// (sum w)^2 / sum w^2: how many equally weighted draws the weighted ones are worth.
    double effective_size() const { return sum_ > 0 ? sum_ * sum_ / sum_of_squares_ : 0; }
    template <class Numbers>
    void visit(Numbers& numbers) {
        numbers(largest_, sum_, sum_of_squares_);
    }

  private:
    void raise_to(double largest) {
        if (largest <= largest_) return;
        const double factor = sum_ > 0 ? std::exp(largest_ - largest) : 0;
        sum_ *= factor;
        sum_of_squares_ *= factor * factor;
        largest_ = largest;
    }
    double largest_ = -std::numeric_limits<double>::infinity();
    double sum_ = 0;
    double sum_of_squares_ = 0;
};

}  // namespace taylorcal::calibrate
