#include "calibrate/diagnosis/bad_data.hpp"

#include "calibrate/diagnosis/extra_error.hpp"
#include "calibrate/diagnosis/tail_probability.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/QR>

namespace taylorcal::calibrate {
namespace {

constexpr std::array inflations{3.0, 10.0, 30.0};

/// A model asked for some of its data only.
class PartOfModel final : public DiagnosisModel {
  public:
    PartOfModel(const DiagnosisModel& whole, std::vector<Eigen::Index> data)
        : whole_(whole), data_(std::move(data)) {}
    RowMatrix predict(const RowMatrix& units) const override {
        return whole_.predict(units)(Eigen::all, data_);
    }
    RowMatrix shift(std::size_t k, const RowMatrix& units,
                    const Eigen::VectorXd& amplitudes) const override {
        return whole_.shift(k, units, amplitudes)(Eigen::all, data_);
    }
    Eigen::MatrixXd shift_covariance(std::size_t k) const override {
        const Eigen::MatrixXd all = whole_.shift_covariance(k);
        if (all.size() == 0) return all;
        return all(data_, data_);
    }
    RunRange run_range(std::size_t k) const override { return whole_.run_range(k); }
    std::string why_unseen(std::size_t k) const override { return whole_.why_unseen(k); }

  private:
    const DiagnosisModel& whole_;
    std::vector<Eigen::Index> data_;
};

/// Studentised deviation and gain of the data with `columns` = P L^-1 E diag(sd).
/// `freedom`: degrees of freedom of the variance. A number whose error is known from a
/// few runs only is off by four standard errors more often than a normal one.
void judge(Suspect& suspect, const Eigen::MatrixXd& columns,
           const Eigen::VectorXd& residual, double freedom, double peers) {
    const Eigen::MatrixXd information = columns.transpose() * columns;
    const Eigen::VectorXd pull = columns.transpose() * residual;
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> inverse(information);
    const double chi2 = pull.dot(inverse.solve(pull));
    const auto rank = static_cast<double>(inverse.rank());
    const double p = fisher_tail(chi2 / rank, rank, freedom);
    suspect.z = suspect.size.empty()
                    ? std::max(0.0, normal_quantile_of_tail(std::max(p, 1e-300)))
                    : std::copysign(std::sqrt(chi2), pull(0));
    suspect.p = p;
    suspect.log_gain =
        gain_of_extra_error(columns, residual, inflations) - std::log(peers);
}

}  // namespace

std::vector<Suspect> suspect_data(const DiagnosisProblem& problem,
                                  const Whitening& whiten, const Refit& fit) {
    const Eigen::VectorXd sd = problem.covariance.diagonal().cwiseSqrt();
    const Eigen::MatrixXd columns =
        Projector(fit.all_slopes())(whiten(Eigen::MatrixXd(sd.asDiagonal())));
    std::vector<Suspect> suspects;
    for (std::size_t n = 0; n < problem.shots.size(); ++n) {
        Suspect whole;
        whole.shot = n;
        for (std::size_t i = 0; i < problem.data.size(); ++i)
            if (problem.data[i].shot == n)
                whole.data.push_back(static_cast<Eigen::Index>(i));
        if (whole.data.empty()) continue;
        suspects.push_back(whole);
        if (whole.data.size() == 1) continue;
        for (const Eigen::Index i : whole.data)
            suspects.push_back({n, problem.data[static_cast<std::size_t>(i)].size, {i}});
    }
    const auto shots = static_cast<double>(problem.shots.size());
    const auto all = static_cast<double>(suspects.size());
    for (Suspect& suspect : suspects) {
        const double freedom = problem.freedom.size() > 0
                                   ? problem.freedom(suspect.data).minCoeff()
                                   : std::numeric_limits<double>::infinity();
        judge(suspect, columns(Eigen::all, suspect.data), fit.residual, freedom,
              suspect.size.empty() ? shots : static_cast<double>(problem.data.size()));
        suspect.p = std::min(1.0, all * suspect.p);
    }
    return suspects;
}

bool is_adequate_without(const DiagnosisProblem& problem, const Refit& fit,
                         const Suspect& suspect, const NormalTable& table) {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < problem.measured.size(); ++i)
        if (std::find(suspect.data.begin(), suspect.data.end(), i) == suspect.data.end())
            kept.push_back(i);
    const PartOfModel model(problem.model, kept);
    std::vector<MeasuredNumber> data;
    data.reserve(kept.size());
    for (const Eigen::Index i : kept)
        data.push_back(problem.data[static_cast<std::size_t>(i)]);
    DiagnosisProblem rest{model,
                          problem.measured(kept),
                          problem.covariance(kept, kept),
                          problem.freedom.size() > 0
                              ? Eigen::VectorXd(problem.freedom(kept))
                              : Eigen::VectorXd(),
                          data,
                          problem.shots,
                          problem.parameters,
                          problem.candidates,
                          {},
                          {},
                          problem.alpha,
                          problem.seed,
                          problem.threads};
    const Whitening whiten(rest.covariance);
    const Refit again = refit(rest, whiten, {}, fit.unit, Eigen::VectorXd());
    return !test_adequacy(rest, whiten, again, table).is_flagged(alpha_of_rest);
}

}  // namespace taylorcal::calibrate
