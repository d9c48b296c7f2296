#pragma once

#include "calibrate/diagnosis/candidate.hpp"
#include "common/hdf5_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace taylorcal::calibrate {

/// One measured number, as far as the search for missing physics needs to know it.
struct MeasuredNumber {
    std::size_t shot = 0;  ///< position in DiagnosisProblem::shots
    std::string size;      ///< "final_length_mm"
    double scale_mm = 1;   ///< what relative deviations refer to
};

/// The shot it belongs to.
struct ShotLabel {
    std::string id;
    std::string shape;
    std::string lot;
    double velocity_m_s = 0;
    /// Length/diameter, diameter [mm] and temperature [K].
    Eigen::Vector3d other_inputs = Eigen::Vector3d::Zero();
};

/// Where a candidate's signature rests on paired runs; beyond, nothing is known of it.
struct RunRange {
    double lowest, highest;        ///< amplitudes
    Eigen::VectorXd lower, upper;  ///< of the unit coordinates
};

/// The model seen from the data: all measured numbers as functions of the calibrated
/// parameters (a point of the unit cube) and of the candidates' amplitudes. Must be safe
/// to call from threads.
class DiagnosisModel {
  public:
    virtual ~DiagnosisModel() = default;
    /// Without any candidate [mm]: a row a point, a column a datum.
    virtual RowMatrix predict(const RowMatrix& units) const = 0;
    /// What candidate `k` adds [mm]; one amplitude a row of `units`.
    virtual RowMatrix shift(std::size_t k, const RowMatrix& units,
                            const Eigen::VectorXd& amplitudes) const = 0;
    /// Covariance [mm^2] of the error of `shift` at amplitude 1 (it grows with the
    /// square); no rows: none.
    virtual Eigen::MatrixXd shift_covariance(std::size_t k) const = 0;
    /// What the paired runs of candidate `k` span.
    virtual RunRange run_range(std::size_t k) const = 0;
    /// Why candidate `k` could not be seen with these data; empty: it could.
    virtual std::string why_unseen(std::size_t k) const = 0;
};

/// Everything that a diagnosis at one mode works on; nothing of files.
struct DiagnosisProblem {
    const DiagnosisModel& model;
    Eigen::VectorXd measured{};    ///< [mm]
    Eigen::MatrixXd covariance{};  ///< of all errors [mm^2], full
    /// Degrees of freedom with which each number's variance is known; empty: exactly.
    Eigen::VectorXd freedom{};
    std::vector<MeasuredNumber> data{};
    std::vector<ShotLabel> shots{};
    std::vector<std::string> parameters{};  ///< names of the cube's coordinates
    std::vector<Candidate> candidates{};
    std::vector<std::string> descriptors{};  ///< names of state descriptors, may be empty
    RowMatrix descriptor_values{};           ///< [shots x descriptors]
    double alpha = 0.05;  ///< share of sound tables that may be flagged
    std::uint64_t seed = 1;
    int threads = 1;
};

}  // namespace taylorcal::calibrate
