#include "calibrate/diagnosis/unstated_scatter.hpp"

#include "calibrate/diagnosis/tail_probability.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <boost/math/tools/minima.hpp>

namespace taylorcal::calibrate {
namespace {

constexpr Eigen::Index fewest_rough = 3;  // directions
constexpr double widest = 10;             // in stated standard errors
constexpr int bits = 20;                  // of the search for the likeliest scatter
constexpr double worth_a_parameter = 1;   // in ln L (Akaike)

using Numbers = std::vector<Eigen::Index>;

const ShotLabel& shot_of(const DiagnosisProblem& problem, Eigen::Index number) {
    return problem.shots[problem.data[static_cast<std::size_t>(number)].shot];
}

/// What a smooth misfit of a size of one shape is made of, a column each.
Eigen::MatrixXd smooth_terms(const DiagnosisProblem& problem, const Numbers& data) {
    std::vector<std::string> lots;
    for (const Eigen::Index i : data) {
        const std::string& lot = shot_of(problem, i).lot;
        if (std::find(lots.begin(), lots.end(), lot) == lots.end()) lots.push_back(lot);
    }
    const auto n = static_cast<Eigen::Index>(data.size());
    Eigen::MatrixXd inputs(n, 1 + ShotLabel{}.other_inputs.size());
    Eigen::MatrixXd of_lots(n, static_cast<Eigen::Index>(lots.size()));
    for (Eigen::Index i = 0; i < n; ++i) {
        const ShotLabel& shot = shot_of(problem, data[static_cast<std::size_t>(i)]);
        inputs.row(i) << shot.velocity_m_s, shot.other_inputs.transpose();
        for (std::size_t l = 0; l < lots.size(); ++l)
            of_lots(i, static_cast<Eigen::Index>(l)) = shot.lot == lots[l] ? 1 : 0;
    }
    // To about [-1, 1], or 0 where all are equal.
    inputs.rowwise() -= inputs.colwise().mean().eval();
    for (Eigen::Index j = 0; j < inputs.cols(); ++j) {
        const double reach = inputs.col(j).cwiseAbs().maxCoeff();
        if (reach > 1e-9) inputs.col(j) /= reach;
    }
    Eigen::MatrixXd terms(n, inputs.cols() + 1 + of_lots.cols());
    terms << inputs, inputs.col(0).cwiseAbs2(), of_lots;
    return terms;
}

/// Orthonormal directions of `data` that no smooth misfit of any shape and size has, a
/// column each.
Eigen::MatrixXd rough_directions(const DiagnosisProblem& problem, const Numbers& data) {
    std::map<std::pair<std::string, std::string>, Numbers> places;  // in `data`
    for (std::size_t i = 0; i < data.size(); ++i)
        places[{shot_of(problem, data[i]).shape,
                problem.data[static_cast<std::size_t>(data[i])].size}]
            .push_back(static_cast<Eigen::Index>(i));
    const auto n = static_cast<Eigen::Index>(data.size());
    Eigen::MatrixXd directions(n, 0);
    for (const auto& [key, at] : places) {
        Numbers own;
        for (const Eigen::Index i : at) own.push_back(data[static_cast<std::size_t>(i)]);
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> smooth(
            smooth_terms(problem, own));
        const Eigen::Index rough = static_cast<Eigen::Index>(at.size()) - smooth.rank();
        const Eigen::MatrixXd all = smooth.householderQ();
        directions.conservativeResize(n, directions.cols() + rough);
        directions.rightCols(rough).setZero();
        directions.rightCols(rough)(at, Eigen::all) = all.rightCols(rough);
    }
    return directions;
}

struct Likeliest {
    double over_stated = 0;  ///< standard deviation over that of the errors
    double gain = 0;         ///< in ln L over none
    double freedom = 0;      ///< directions that it is known from
};

/// Some numbers in the directions that no smooth misfit has.
class RoughPart {
  public:
    RoughPart(const DiagnosisProblem& problem, Numbers data,
              const Eigen::VectorXd& residual_mm)
        : data_(std::move(data)), directions_(rough_directions(problem, data_)) {
        const Eigen::MatrixXd errors = problem.covariance(data_, data_);
        stated_ = directions_.transpose() * errors * directions_;
        unit_ = directions_.transpose() * errors.diagonal().asDiagonal() * directions_;
        residual_ = directions_.transpose() * residual_mm(data_);
    }
    Eigen::Index size() const { return directions_.cols(); }

    /// Likeliest scatter beyond the stated covariance.
    Likeliest likeliest() const {
        // Directions in which both are diagonal: the variance is 1 + sd^2 growth.
        const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> both(unit_,
                                                                             stated_);
        const Eigen::ArrayXd growth = both.eigenvalues().array();
        const Eigen::ArrayXd squares =
            (both.eigenvectors().transpose() * residual_).array().square();
        const auto minus_twice_log_likelihood = [&](double sd) {
            const Eigen::ArrayXd variance = 1 + sd * sd * growth;
            return (variance.log() + squares / variance).sum();
        };
        const auto [sd, least] = boost::math::tools::brent_find_minima(
            minus_twice_log_likelihood, 0.0, widest, bits);
        const double gain = (minus_twice_log_likelihood(0) - least) / 2;
        if (gain > 0) return {sd, gain};
        return {};
    }
    /// p of a number's deviation from the others, if they scatter so beyond what is
    /// stated, known as well as this part knows it. `at`: among the numbers of this part.
    double deviation(Eigen::Index at, double over_stated) const {
        const Eigen::MatrixXd scatter = over_stated * over_stated * unit_;
        const Eigen::LLT<Eigen::MatrixXd> covariance(stated_ + scatter);
        const double share = scatter.trace() / (stated_ + scatter).trace();
        const double freedom =
            static_cast<double>(size() - 1) / std::max(share * share, 1e-6);
        const Eigen::VectorXd own = directions_.row(at).transpose();
        const Eigen::VectorXd weights = covariance.solve(own);
        const double information = std::max(own.dot(weights), 1e-300);
        const double pull = weights.dot(residual_);
        return fisher_tail(pull * pull / information, 1, freedom);
    }

  private:
    Numbers data_;
    Eigen::MatrixXd directions_;  // an orthonormal column each
    Eigen::MatrixXd stated_, unit_;
    Eigen::VectorXd residual_;
};

/// Scatter of some numbers, without one of them if that one is wild; none if there are
/// too few or if it is hardly likelier than none.
Likeliest scatter_of(const DiagnosisProblem& problem, const Numbers& data,
                     const Eigen::VectorXd& residual_mm) {
    constexpr double wild = 0.01;
    const RoughPart all(problem, data, residual_mm);
    if (all.size() < fewest_rough) return {};
    Likeliest scatter = all.likeliest();
    Eigen::VectorXd p(static_cast<Eigen::Index>(data.size()));
    for (Eigen::Index i = 0; i < p.size(); ++i)
        p(i) = all.deviation(i, scatter.over_stated);
    Eigen::Index wildest = 0;
    p.minCoeff(&wildest);
    Numbers others = data;
    others.erase(others.begin() + wildest);
    const Likeliest without = RoughPart(problem, others, residual_mm).likeliest();
    if (all.deviation(wildest, without.over_stated) * static_cast<double>(p.size()) <
        wild)
        scatter = without;
    if (scatter.gain < worth_a_parameter) return {};
    scatter.freedom = static_cast<double>(all.size());
    return scatter;
}

}  // namespace

std::vector<UnstatedScatter> unstated_scatter(const DiagnosisProblem& problem,
                                              const Eigen::VectorXd& residual_mm) {
    Numbers all;
    std::map<std::string, Numbers> by_size;
    for (Eigen::Index i = 0; i < problem.measured.size(); ++i) {
        all.push_back(i);
        by_size[problem.data[static_cast<std::size_t>(i)].size].push_back(i);
    }
    std::map<std::string, Likeliest> own;
    double gain_by_size = 0;
    for (const auto& [size, data] : by_size) {
        own[size] = scatter_of(problem, data, residual_mm);
        if (own[size].gain > 0) gain_by_size += own[size].gain - worth_a_parameter;
    }
    const Likeliest common = scatter_of(problem, all, residual_mm);
    const bool is_common = common.gain - worth_a_parameter > gain_by_size;
    std::vector<UnstatedScatter> scatters;
    for (const auto& [size, data] : by_size) {
        const Likeliest& scatter = is_common ? common : own[size];
        if (!(scatter.gain > 0)) continue;
        double stated = 0;
        for (const Eigen::Index i : data)
            stated += problem.covariance(i, i) /
                      std::pow(problem.data[static_cast<std::size_t>(i)].scale_mm, 2);
        scatters.push_back({size, data, scatter.over_stated,
                            std::sqrt(stated / static_cast<double>(data.size())),
                            scatter.freedom});
    }
    return scatters;
}

void count_scatter(const std::vector<UnstatedScatter>& scatters,
                   DiagnosisProblem& problem) {
    for (const UnstatedScatter& scatter : scatters)
        for (const Eigen::Index i : scatter.data) {
            const double stated = problem.covariance(i, i);
            const double added = scatter.over_stated * scatter.over_stated * stated;
            problem.covariance(i, i) += added;
            if (problem.freedom.size() == 0) continue;
            // Welch and Satterthwaite.
            problem.freedom(i) =
                std::pow(stated + added, 2) /
                (stated * stated / problem.freedom(i) + added * added / scatter.freedom);
        }
}

}  // namespace taylorcal::calibrate
