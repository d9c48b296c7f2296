#pragma once

#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// A class of ours; matrices have a `visit` of another meaning.
template <class State>
concept TellsItsMembers =
    std::is_class_v<State> && !std::is_base_of_v<Eigen::EigenBase<State>, State>;

/// Writes the numbers that a state consists of one after the other, as doubles: exact
/// also for counts, which stay below 2^53. A class tells its members, the same for
/// writing and reading:
///     template <class Numbers> void visit(Numbers& numbers) { numbers(first_, second_);
///     }
class NumberWriter {
  public:
    template <class... Items>
    void operator()(Items&... items) {
        (put(items), ...);
    }
    std::vector<double> numbers;

  private:
    void put(double value) { numbers.push_back(value); }
    void put(std::uint64_t value) { put(static_cast<double>(value)); }
    void put(Eigen::Index value) { put(static_cast<double>(value)); }
    void put(bool value) { put(value ? 1.0 : 0.0); }
    template <class Derived>
    void put(Eigen::PlainObjectBase<Derived>& matrix) {
        put(matrix.rows());
        put(matrix.cols());
        numbers.insert(numbers.end(), matrix.data(), matrix.data() + matrix.size());
    }
    template <class Item>
    void put(std::vector<Item>& items) {
        put(std::uint64_t{items.size()});
        for (Item& item : items) put(item);
    }
    template <TellsItsMembers State>
    void put(State& state) {
        state.visit(*this);
    }
};

/// Reads them back. std::runtime_error when there are too few.
class NumberReader {
  public:
    explicit NumberReader(std::vector<double> numbers) : numbers_(std::move(numbers)) {}
    template <class... Items>
    void operator()(Items&... items) {
        (take(items), ...);
    }

  private:
    void take(double& value) {
        if (at_ == numbers_.size()) throw std::runtime_error("it is damaged");
        value = numbers_[at_++];
    }
    template <class Whole>
    void take_whole(Whole& value) {
        double number = 0;
        take(number);
        value = static_cast<Whole>(number);
    }
    void take(std::uint64_t& value) { take_whole(value); }
    void take(Eigen::Index& value) { take_whole(value); }
    void take(bool& value) { take_whole(value); }
    template <class Derived>
    void take(Eigen::PlainObjectBase<Derived>& matrix) {
        Eigen::Index rows = 0, columns = 0;
        take(rows);
        take(columns);
        matrix.resize(rows, columns);
        for (Eigen::Index i = 0; i < matrix.size(); ++i) take(matrix.data()[i]);
    }
    template <class Item>
    void take(std::vector<Item>& items) {
        std::uint64_t size = 0;
        take(size);
        items.resize(size);
        for (Item& item : items) take(item);
    }
    template <TellsItsMembers State>
    void take(State& state) {
        state.visit(*this);
    }

    std::vector<double> numbers_;
    std::size_t at_ = 0;
};

}  // namespace taylorcal::calibrate
