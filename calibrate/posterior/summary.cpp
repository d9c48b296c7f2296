#include "calibrate/posterior/summary.hpp"

#include "calibrate/posterior/weighted_quantile.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace taylorcal::calibrate {

std::vector<ParameterSummary> summarise(const std::vector<std::string>& names,
                                        const RowMatrix& draws,
                                        const Eigen::RowVectorXd& maximum) {
    std::vector<ParameterSummary> summaries;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto column = static_cast<Eigen::Index>(i);
        const Eigen::VectorXd values = draws.col(column);
        const WeightedQuantile quantile(values);
        const double mean = values.mean();
        const double variance =
            (values.array() - mean).square().sum() /
            static_cast<double>(std::max<Eigen::Index>(values.size() - 1, 1));
        summaries.push_back({names[i], mean, std::sqrt(variance), quantile(0.025),
                             quantile(0.5), quantile(0.975), maximum(column)});
    }
    return summaries;
}

std::string parameter_table(const std::vector<ParameterSummary>& summaries) {
    std::size_t width = 9;
    for (const auto& summary : summaries) width = std::max(width, summary.name.size());
    std::string table =
        fmt::format("{:<{}}  {:>10}  {:>10}  {:>10}  {:>23}  {:>10}\n", "parameter",
                    width, "mean", "sd", "median", "95 % interval", "maximum");
    for (const auto& s : summaries)
        table +=
            fmt::format("{:<{}}  {:>10.4g}  {:>10.3g}  {:>10.4g}  {:>23}  {:>10.4g}\n",
                        s.name, width, s.mean, s.sd, s.median,
                        fmt::format("{:.4g} to {:.4g}", s.lower95, s.upper95), s.maximum);
    return table;
}

}  // namespace taylorcal::calibrate
