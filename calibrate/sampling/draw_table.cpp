#include "calibrate/sampling/draw_table.hpp"

#include <limits>

namespace taylorcal::calibrate {
namespace {

using Purpose = DrawNumbers::Purpose;
constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

/// ln(prior / proposal) at a draw.
double log_importance(const Mixture& proposal, const Eigen::VectorXd& point) {
    return in_unit_cube(point) ? -proposal.log_density(point) : minus_infinity;
}

void draw_shared(DrawTable& table, const Proposal& proposal, const DrawNumbers& numbers) {
    for (Eigen::Index k = 0; k < table.draws(); ++k) {
        Eigen::VectorXd uniforms(table.shared.cols());
        for (Eigen::Index j = 0; j < uniforms.size(); ++j)
            uniforms(j) =
                numbers(Purpose::shared, table.first + static_cast<std::uint64_t>(k), 0,
                        static_cast<std::uint64_t>(j));
        const Eigen::VectorXd point = proposal.shared().draw(uniforms);
        table.log_shared(k) = log_importance(proposal.shared(), point);
        table.shared.row(k) = point.transpose();
    }
}

/// The own parameters of a lot for one draw: rows k M to (k + 1) M.
void draw_own(DrawTable& table, const Proposal& proposal, const DrawNumbers& numbers,
              std::size_t lot, Eigen::Index k) {
    const Mixture mixture = proposal.own(lot, table.shared.row(k).transpose());
    const auto inner = static_cast<std::size_t>(table.inner);
    const std::uint64_t draw = table.first + static_cast<std::uint64_t>(k);
    RowMatrix& own = table.own[lot];
    RowMatrix strata(table.inner, own.cols());
    for (Eigen::Index j = 0; j < own.cols(); ++j) {
        const auto dimension = static_cast<std::uint64_t>(j);
        std::vector<std::size_t> order;
        if (j > 0) order = numbers.permutation(inner, draw, lot, dimension);
        for (std::size_t m = 0; m < inner; ++m) {
            const double jitter = numbers(Purpose::own, draw * inner + m, lot, dimension);
            const auto stratum = static_cast<double>(j > 0 ? order[m] : m);
            strata(static_cast<Eigen::Index>(m), j) =
                (stratum + jitter) / static_cast<double>(inner);
        }
    }
    for (Eigen::Index m = 0; m < table.inner; ++m) {
        const Eigen::VectorXd point = mixture.draw(strata.row(m).transpose());
        const Eigen::Index row = k * table.inner + m;
        table.log_own[lot](row) = log_importance(mixture, point);
        own.row(row) = point.transpose();
    }
}

}  // namespace

DrawTable evaluate_draws(const LotLikelihood& likelihood, const Proposal& proposal,
                         const DrawNumbers& numbers, std::uint64_t first,
                         std::uint64_t count, std::uint64_t draws_per_lot) {
    const ParameterSpace& space = likelihood.space();
    const auto rows = static_cast<Eigen::Index>(count);
    const auto own_count = static_cast<Eigen::Index>(space.per_lot_count());
    DrawTable table;
    table.first = first;
    table.inner = own_count == 0 ? 1 : static_cast<Eigen::Index>(draws_per_lot);
    table.shared.resize(rows, static_cast<Eigen::Index>(space.shared_count()));
    table.log_shared.resize(rows);
    draw_shared(table, proposal, numbers);
    const Eigen::Index points = rows * table.inner;
    RowMatrix parameters(points, static_cast<Eigen::Index>(space.parameters().size()));
    for (std::size_t lot = 0; lot < space.lot_count(); ++lot) {
        table.own.emplace_back(points, own_count);
        table.log_own.emplace_back(Eigen::VectorXd::Zero(points));
        for (Eigen::Index k = 0; k < rows && own_count > 0; ++k)
            draw_own(table, proposal, numbers, lot, k);
        for (Eigen::Index i = 0; i < points; ++i)
            space.fill(table.shared.row(i / table.inner), table.own[lot].row(i),
                       parameters.row(i));
        table.log_likelihood.push_back(likelihood(lot, parameters));
    }
    return table;
}

DrawTable join(const std::vector<DrawTable>& tables) {
    DrawTable all = tables.front();
    Eigen::Index rows = 0;
    for (const DrawTable& table : tables) rows += table.draws();
    all.shared.resize(rows, all.shared.cols());
    all.log_shared.resize(rows);
    for (std::size_t lot = 0; lot < all.own.size(); ++lot) {
        all.own[lot].resize(rows * all.inner, all.own[lot].cols());
        all.log_own[lot].resize(rows * all.inner);
        all.log_likelihood[lot].resize(rows * all.inner, all.log_likelihood[lot].cols());
    }
    Eigen::Index at = 0;
    for (const DrawTable& table : tables) {
        const Eigen::Index n = table.draws();
        all.shared.middleRows(at, n) = table.shared;
        all.log_shared.segment(at, n) = table.log_shared;
        for (std::size_t lot = 0; lot < all.own.size(); ++lot) {
            const Eigen::Index from = at * all.inner, count = n * all.inner;
            all.own[lot].middleRows(from, count) = table.own[lot];
            all.log_own[lot].segment(from, count) = table.log_own[lot];
            all.log_likelihood[lot].middleRows(from, count) = table.log_likelihood[lot];
        }
        at += n;
    }
    return all;
}

}  // namespace taylorcal::calibrate
