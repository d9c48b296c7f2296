#pragma once

#include "calibrate/diagnosis/diagnosis.hpp"
#include "common/random.hpp"

#include <string>
#include <vector>

#include <Eigen/Dense>
#include <fmt/core.h>

namespace taylorcal::calibrate::toys {

/// A linear model with Gaussian errors, for which every number of a diagnosis has a
/// closed form: y = 30 + A (u - 1/2) + sum kappa_k g_k + e, e ~ N(0, C). Two shapes,
/// three sizes, shots over a range of velocity, errors correlated within a shot.
struct LinearTable : DiagnosisModel {
    Eigen::MatrixXd slope;    ///< A
    Eigen::MatrixXd effects;  ///< g, a column a candidate; amplitude 1 is one prior width
    Eigen::VectorXd base;
    Eigen::MatrixXd covariance, root;
    std::vector<MeasuredNumber> data;
    std::vector<ShotLabel> shots;
    std::vector<Candidate> candidates;

    static constexpr int shots_of_shape = 8;
    static constexpr double sd = 0.1;  // [mm]

    explicit LinearTable(int candidate_count = 8) {
        const std::vector<std::string> sizes{"final_length_mm", "impact_diameter_mm",
                                             "head_length_mm"};
        for (const char* shape : {"uniform_cylinder", "truncated_cone"})
            for (int i = 0; i < shots_of_shape; ++i) {
                for (const std::string& size : sizes)
                    data.push_back({shots.size(), size, 20});
                shots.push_back(
                    {fmt::format("{}{}", shape[0], i), shape, "lot", 100.0 + 12 * i});
            }
        const auto n = static_cast<Eigen::Index>(data.size());
        base = Eigen::VectorXd::Constant(n, 30);
        covariance = Eigen::MatrixXd::Identity(n, n) * (sd * sd);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j)
                if (i / 3 == j / 3) covariance(i, j) += 0.5 * sd * sd;
        root = Eigen::LLT<Eigen::MatrixXd>(covariance).matrixL();
        slope.resize(n, 3);
        effects.resize(n, candidate_count);
        for (Eigen::Index i = 0; i < n; ++i) {
            const double t = time(i);
            const double size = static_cast<double>(i % 3);
            slope.row(i) << 4 - size, 3 * t * (size - 1),
                2 * (size == 1 ? 1 + t : -t * t);
        }
        for (Eigen::Index k = 0; k < candidate_count; ++k) effects.col(k) = pattern(k);
        for (int k = 0; k < candidate_count; ++k) {
            Candidate c;
            c.name = fmt::format("effect_{}", k);
            c.lowest = 0;
            c.highest = 100;
            candidates.push_back(c);
        }
    }
    /// Velocity from -1 to 1.
    double time(Eigen::Index i) const {
        const double v = shots[data[static_cast<std::size_t>(i)].shot].velocity_m_s;
        return (v - 142) / 42;
    }
    bool is_cone(Eigen::Index i) const { return i >= 3 * shots_of_shape; }
    /// Smooth in velocity, another for each shape and size.
    Eigen::VectorXd pattern(Eigen::Index k) const {
        const RandomStream coefficients(77, static_cast<std::uint64_t>(k));
        Eigen::VectorXd g(base.size());
        for (Eigen::Index i = 0; i < g.size(); ++i) {
            const auto group =
                static_cast<std::uint64_t>(3 * (i % 3) + (is_cone(i) ? 9 : 0));
            const double t = time(i);
            g(i) = sd * (coefficients.normal(group) + coefficients.normal(group + 1) * t +
                         coefficients.normal(group + 2) * t * t);
        }
        return g;
    }
    /// L^-1 of columns.
    Eigen::MatrixXd white(const Eigen::MatrixXd& columns) const {
        return root.triangularView<Eigen::Lower>().solve(columns);
    }
    /// P of whitened columns, by another road than the code under test: normal equations.
    Eigen::MatrixXd project(const Eigen::MatrixXd& columns) const {
        const Eigen::MatrixXd j = white(slope);
        return columns - j * (j.transpose() * j).inverse() * (j.transpose() * columns);
    }
    /// The amplitude with which an effect stands out by `sigma`.
    double amplitude_of(const Eigen::VectorXd& effect, double sigma) const {
        return sigma / project(white(effect)).norm();
    }
    Eigen::VectorXd draw(std::uint64_t seed, const Eigen::VectorXd& shift) const {
        const RandomStream noise(seed, 5), place(seed, 6);
        Eigen::VectorXd z(base.size()), u(3);
        for (Eigen::Index i = 0; i < z.size(); ++i)
            z(i) = noise.normal(static_cast<std::uint64_t>(i));
        for (Eigen::Index j = 0; j < 3; ++j)
            u(j) = -0.2 + 0.4 * place.uniform(static_cast<std::uint64_t>(j));
        return base + slope * u + shift + root * z;
    }
    Eigen::VectorXd no_shift() const { return Eigen::VectorXd::Zero(base.size()); }

    DiagnosisProblem problem(const Eigen::VectorXd& measured) const {
        DiagnosisProblem p{*this};
        p.measured = measured;
        p.covariance = covariance;
        p.data = data;
        p.shots = shots;
        p.parameters = {"a", "b", "c"};
        p.candidates = candidates;
        return p;
    }
    ModeDiagnosis diagnose(const Eigen::VectorXd& measured) const {
        static const NormalTable table(1, 64);
        return diagnose_mode(problem(measured), Eigen::VectorXd::Constant(3, 0.5), table);
    }

    RowMatrix predict(const RowMatrix& units) const override {
        return ((units.array() - 0.5).matrix() * slope.transpose()).rowwise() +
               base.transpose();
    }
    RowMatrix shift(std::size_t k, const RowMatrix& units,
                    const Eigen::VectorXd& amplitudes) const override {
        static_cast<void>(units);
        return amplitudes * effects.col(static_cast<Eigen::Index>(k)).transpose();
    }
    Eigen::MatrixXd shift_covariance(std::size_t) const override { return {}; }
    RunRange run_range(std::size_t k) const override {
        return {candidates[k].lower(), candidates[k].upper(), Eigen::VectorXd::Zero(3),
                Eigen::VectorXd::Ones(3)};
    }
    std::string why_unseen(std::size_t) const override { return ""; }
};

}  // namespace taylorcal::calibrate::toys
