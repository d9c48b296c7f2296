#include "calibrate/prior_pass/running_result.hpp"

#include "calibrate/posterior/map_axis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace taylorcal::calibrate {
namespace {

using Purpose = DrawNumbers::Purpose;
constexpr std::uint64_t plain_pass = 0;
constexpr std::size_t outside = static_cast<std::size_t>(-1);

std::size_t cell_of(double unit, double low, double high, std::size_t cells) {
    const double place = (unit - low) / (high - low) * static_cast<double>(cells);
    if (!(place >= 0 && place <= static_cast<double>(cells))) return outside;
    return std::min(static_cast<std::size_t>(place), cells - 1);
}

bool is_power_of_ten_within(std::uint64_t before, std::uint64_t after) {
    for (std::uint64_t decade = 1000; decade <= after; decade *= 10)
        if (decade > before) return true;
    return false;
}

}  // namespace

RunningResult::RunningResult(const Pruning& pruning, const ParameterSpace& space,
                             const SpreadLevels& levels, MapRanges ranges,
                             DrawSequence sequence, std::uint64_t seed,
                             std::size_t pool_capacity)
    : pruning_(pruning),
      space_(space),
      levels_(levels),
      ranges_(std::move(ranges)),
      sequence_(sequence),
      numbers_(seed, plain_pass),
      dimensions_(space.size()),
      pool_(pool_capacity),
      counts_(3, 0),
      sums_(3, 0),
      replicate_sums_(UnitSequence::replicates, 0),
      replicate_draws_(UnitSequence::replicates, 0),
      moments_(2 * dimensions_, 0),
      level_sums_(levels.values.size(), 0),
      singles_(dimensions_ * cells_1d, 0),
      pairs_(dimensions_ * (dimensions_ - 1) / 2 * cells_2d * cells_2d, 0),
      with_levels_(dimensions_ * cells_2d * levels.values.size(), 0) {}

void RunningResult::add(const DrawBlock& block) {
    const std::uint64_t before = draws();
    for (std::size_t i = 0; i < block.place.size(); ++i) add_draw(block, i);
    sums_[dropped_at] += block.dropped;
    counts_[draws_at] += static_cast<double>(block.draws);
    counts_[rows_at] += static_cast<double>(block.rows_seen);
    counts_[next_block_at] = static_cast<double>(block.number + 1);
    replicate_draws_[replicate_of(block.number)] += static_cast<double>(block.draws);
    if (sums_[weight_at] > 0 && is_power_of_ten_within(before, draws())) {
        const Progression p = now();
        decades_.insert(decades_.end(),
                        {p.draws, p.log_evidence, p.log_evidence_sd, p.effective_size});
        decades_.insert(decades_.end(), p.mean.begin(), p.mean.end());
        decades_.insert(decades_.end(), p.sd.begin(), p.sd.end());
    }
}

void RunningResult::add_draw(const DrawBlock& block, std::size_t i) {
    pruning_.log_levels([&](std::size_t m) { return double{block.misfits[m][i]}; },
                        terms_);
    double weight = 0;
    shares_.assign(terms_.size(), 0);
    for (std::size_t g = 0; g < terms_.size(); ++g) {
        shares_[g] = std::exp(terms_[g] - pruning_.log_threshold());
        weight += shares_[g];
    }
    sums_[weight_at] += weight;
    sums_[square_at] += weight * weight;
    replicate_sums_[replicate_of(block.number)] += weight;
    for (std::size_t g = 0; g < shares_.size(); ++g)
        level_sums_[pruning_.level(g)] += shares_[g];
    std::vector<double> unit(dimensions_);
    for (std::size_t d = 0; d < dimensions_; ++d) {
        unit[d] = unit_of(block.words[i][d]);
        const double plain = space_.value(d, unit[d]);
        const double value = space_.parameter(d).log_uniform ? std::log10(plain) : plain;
        moments_[d] += weight * value;
        moments_[dimensions_ + d] += weight * value * value;
    }
    add_to_maps(unit, weight);
    add_to_pool(block.number * UnitSequence::block + block.place[i], unit,
                std::log(weight));
}

void RunningResult::add_to_maps(const std::vector<double>& unit, double weight) {
    std::array<std::size_t, UnitSequence::most_dimensions> cells{};
    for (std::size_t d = 0; d < dimensions_; ++d) {
        const std::size_t cell =
            cell_of(unit[d], ranges_.low[d], ranges_.high[d], cells_1d);
        if (cell != outside) singles_[d * cells_1d + cell] += weight;
        cells[d] = cell_of(unit[d], ranges_.low[d], ranges_.high[d], cells_2d);
        if (cells[d] == outside) continue;
        for (std::size_t g = 0; g < shares_.size(); ++g)
            with_levels_[(d * cells_2d + cells[d]) * level_sums_.size() +
                         pruning_.level(g)] += shares_[g];
    }
    std::size_t pair = 0;
    for (std::size_t a = 0; a < dimensions_; ++a)
        for (std::size_t b = a + 1; b < dimensions_; ++b, ++pair)
            if (cells[a] != outside && cells[b] != outside)
                pairs_[(pair * cells_2d + cells[a]) * cells_2d + cells[b]] += weight;
}

void RunningResult::add_to_pool(std::uint64_t number, const std::vector<double>& unit,
                                double log_weight) {
    ChosenDraw draw;
    draw.log_priority = log_weight - std::log(numbers_(Purpose::priority, number));
    if (!pool_.may_stay(draw.log_priority)) return;
    draw.number = number;
    draw.log_weight = log_weight;
    draw.unit = Eigen::Map<const Eigen::VectorXd>(unit.data(),
                                                  static_cast<Eigen::Index>(unit.size()));
    double left = numbers_(Purpose::choice, number) *
                  std::accumulate(shares_.begin(), shares_.end(), 0.0);
    std::size_t term = 0;
    while (term + 1 < shares_.size() && left >= shares_[term]) left -= shares_[term++];
    draw.level = pruning_.level(term);
    pool_.add({std::move(draw)});
}

double RunningResult::log_evidence() const {
    return pruning_.log_threshold() + std::log(sums_[weight_at] / counts_[draws_at]);
}

double RunningResult::effective_size() const {
    const double weight = sums_[weight_at];
    return weight > 0 ? weight * weight / sums_[square_at] : 0;
}

double RunningResult::log_evidence_sd() const {
    const double fewest =
        *std::min_element(replicate_draws_.begin(), replicate_draws_.end());
    if (sequence_ == DrawSequence::random || fewest == 0)
        return std::sqrt(std::max(0.0, 1 / effective_size() - 1 / counts_[draws_at]));
    const double mean = sums_[weight_at] / counts_[draws_at];
    double squares = 0;
    for (std::size_t r = 0; r < replicate_sums_.size(); ++r) {
        const double deviation = replicate_sums_[r] / replicate_draws_[r] / mean - 1;
        squares += deviation * deviation;
    }
    const auto n = static_cast<double>(replicate_sums_.size());
    return std::sqrt(squares / (n * (n - 1)));
}

double RunningResult::dropped_bound() const {
    const double left_out = std::exp(pruning_.log_left_out() - pruning_.log_threshold());
    return (sums_[dropped_at] + counts_[draws_at] * left_out) / sums_[weight_at];
}

Progression RunningResult::now() const {
    Progression p;
    p.draws = counts_[draws_at];
    p.log_evidence = log_evidence();
    p.log_evidence_sd = log_evidence_sd();
    p.effective_size = effective_size();
    const auto n = static_cast<Eigen::Index>(dimensions_);
    p.mean = Eigen::Map<const Eigen::VectorXd>(moments_.data(), n) / sums_[weight_at];
    const Eigen::VectorXd square =
        Eigen::Map<const Eigen::VectorXd>(moments_.data() + n, n) / sums_[weight_at];
    p.sd = (square - p.mean.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
    return p;
}

std::vector<Progression> RunningResult::convergence() const {
    std::vector<Progression> lines;
    const std::size_t stride = 4 + 2 * dimensions_;
    const auto n = static_cast<Eigen::Index>(dimensions_);
    for (std::size_t at = 0; at < decades_.size(); at += stride) {
        const double* line = decades_.data() + at;
        lines.push_back({line[0], line[1], line[2], line[3],
                         Eigen::Map<const Eigen::VectorXd>(line + 4, n),
                         Eigen::Map<const Eigen::VectorXd>(line + 4 + n, n)});
    }
    if (lines.empty() || lines.back().draws < counts_[draws_at]) lines.push_back(now());
    return lines;
}

MapAxis RunningResult::axis(std::size_t d, std::size_t cells, int dimensions) const {
    const double low = ranges_.low[d], high = ranges_.high[d];
    MapAxis made = unit_axis(space_, d, low, high, static_cast<Eigen::Index>(cells));
    double sum = 0, first = 0, second = 0;
    for (std::size_t c = 0; c < cells_1d; ++c) {
        const double weight = singles_[d * cells_1d + c];
        const double place = (static_cast<double>(c) + 0.5) / cells_1d;
        sum += weight;
        first += weight * place;
        second += weight * place * place;
    }
    const double sd =
        std::sqrt(std::max(second / sum - first * first / (sum * sum), 0.0));
    made.smoothing_cells =
        smoothing(sd, effective_size(), dimensions) * static_cast<double>(cells);
    return made;
}

Maps RunningResult::maps() const {
    Maps made;
    const auto map_of = [](const double* from, std::size_t rows, std::size_t columns) {
        return RowMatrix(Eigen::Map<const RowMatrix>(
            from, static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns)));
    };
    std::vector<MapAxis> axes;
    for (std::size_t d = 0; d < dimensions_; ++d) {
        made.single.push_back(single_density(
            axis(d, cells_1d, 1), map_of(singles_.data() + d * cells_1d, cells_1d, 1)));
        axes.push_back(axis(d, cells_2d, 2));
    }
    const std::size_t levels = level_sums_.size();
    if (levels_.is_free())
        made.single.push_back(single_density(spread_axis(WeightedDraws(), levels_),
                                             map_of(level_sums_.data(), levels, 1)));
    std::size_t pair = 0;
    for (std::size_t a = 0; a < dimensions_; ++a) {
        for (std::size_t b = a + 1; b < dimensions_; ++b, ++pair)
            made.pairs.push_back(pair_density(
                axes[a], axes[b],
                map_of(pairs_.data() + pair * cells_2d * cells_2d, cells_2d, cells_2d)));
        if (levels_.is_free())
            made.pairs.push_back(pair_density(
                axes[a], spread_axis(WeightedDraws(), levels_),
                map_of(with_levels_.data() + a * cells_2d * levels, cells_2d, levels)));
    }
    return made;
}

}  // namespace taylorcal::calibrate
