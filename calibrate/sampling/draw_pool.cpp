#include "calibrate/sampling/draw_pool.hpp"

#include <algorithm>
#include <iterator>

namespace taylorcal::calibrate {
namespace {

bool higher_priority(const ChosenDraw& a, const ChosenDraw& b) {
    if (a.log_priority != b.log_priority) return a.log_priority > b.log_priority;
    return a.number < b.number;
}

}  // namespace

void DrawPool::add(std::vector<ChosenDraw> draws) {
    std::move(draws.begin(), draws.end(), std::back_inserter(draws_));
    if (draws_.size() > 2 * capacity_ + 2) shrink();
}

std::vector<double> DrawPool::numbers() const {
    std::vector<double> numbers;
    for (const ChosenDraw& draw : draws_) {
        numbers.insert(numbers.end(),
                       {static_cast<double>(draw.number), draw.log_weight,
                        draw.log_priority, static_cast<double>(draw.level)});
        numbers.insert(numbers.end(), draw.unit.begin(), draw.unit.end());
    }
    return numbers;
}

void DrawPool::restore(const std::vector<double>& numbers, std::size_t dimensions) {
    const std::size_t stride = 4 + dimensions;
    std::vector<ChosenDraw> draws;
    for (std::size_t at = 0; at + stride <= numbers.size(); at += stride) {
        const double* line = numbers.data() + at;
        draws.push_back({static_cast<std::uint64_t>(line[0]), line[1], line[2],
                         Eigen::Map<const Eigen::VectorXd>(
                             line + 4, static_cast<Eigen::Index>(dimensions)),
                         static_cast<std::size_t>(line[3])});
    }
    add(std::move(draws));
}

void DrawPool::shrink() {
    if (draws_.size() <= capacity_ + 1) return;
    const auto last = draws_.begin() + static_cast<std::ptrdiff_t>(capacity_);
    std::nth_element(draws_.begin(), last, draws_.end(), higher_priority);
    draws_.erase(last + 1, draws_.end());
    threshold_ = draws_.back().log_priority;
}

WeightedDraws DrawPool::weighted() const {
    DrawPool pool = *this;
    pool.shrink();
    double threshold = -std::numeric_limits<double>::infinity();
    if (pool.draws_.size() > capacity_) {
        const auto lowest =
            std::max_element(pool.draws_.begin(), pool.draws_.end(), higher_priority);
        threshold = lowest->log_priority;
        pool.draws_.erase(lowest);
    }
    std::sort(pool.draws_.begin(), pool.draws_.end(),
              [](const auto& a, const auto& b) { return a.number < b.number; });
    WeightedDraws result;
    const auto count = static_cast<Eigen::Index>(pool.draws_.size());
    if (count == 0) return result;
    result.units.resize(count, pool.draws_.front().unit.size());
    Eigen::VectorXd logs(count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const ChosenDraw& draw = pool.draws_[static_cast<std::size_t>(i)];
        result.units.row(i) = draw.unit.transpose();
        result.levels.push_back(draw.level);
        logs(i) = std::max(draw.log_weight, threshold);
    }
    result.weights = (logs.array() - logs.maxCoeff()).exp();
    result.weights /= result.weights.sum();
    return result;
}

WeightedDraws resample(const WeightedDraws& draws, std::size_t count, double offset) {
    WeightedDraws result;
    result.units.resize(static_cast<Eigen::Index>(count), draws.units.cols());
    result.weights = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(count),
                                               1.0 / static_cast<double>(count));
    Eigen::Index source = 0;
    double reached = draws.weights(0);
    for (std::size_t i = 0; i < count; ++i) {
        const double position =
            (static_cast<double>(i) + offset) / static_cast<double>(count);
        while (reached < position && source + 1 < draws.weights.size())
            reached += draws.weights(++source);
        result.units.row(static_cast<Eigen::Index>(i)) = draws.units.row(source);
        result.levels.push_back(draws.levels[static_cast<std::size_t>(source)]);
    }
    return result;
}

}  // namespace taylorcal::calibrate
