#include "emulator/training/split.hpp"

#include "emulator/training/streams.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace taylorcal::emulator {

Split split_rows(const Dataset& data, double fraction, std::uint64_t seed) {
    const RandomStream random(seed, streams::split);
    Split split;
    using Ticket = std::pair<double, Eigen::Index>;
    std::map<std::string, std::vector<Ticket>> tickets;
    for (std::size_t i = 0; i < data.row_ids.size(); ++i) {
        if (!data.cheaper.empty() && data.cheaper[i] > 0) {
            split.training.push_back(static_cast<Eigen::Index>(i));
            continue;
        }
        tickets[data.categories[i]].emplace_back(
            random.uniform(static_cast<std::uint64_t>(data.row_ids[i])),
            static_cast<Eigen::Index>(i));
    }
    for (auto& [category, rows] : tickets) {
        std::ranges::sort(rows);
        const auto n = static_cast<double>(rows.size());
        const double held = std::min(std::max(std::round(fraction * n), 1.0), n - 1);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            auto& part =
                static_cast<double>(i) < held ? split.validation : split.training;
            part.push_back(rows[i].second);
        }
    }
    std::ranges::sort(split.training);
    std::ranges::sort(split.validation);
    return split;
}

}  // namespace taylorcal::emulator
