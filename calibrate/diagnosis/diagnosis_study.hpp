#pragma once

#include "calibrate/diagnosis/corrected_model.hpp"
#include "calibrate/diagnosis/diagnosis_json.hpp"
#include "calibrate/diagnosis/error_budget.hpp"
#include "calibrate/posterior/posterior_file.hpp"

#include <memory>
#include <vector>

namespace taylorcal::calibrate {

/// What a diagnosis of a table takes besides network and table.
struct DiagnosisInputs {
    const Settings& settings;
    const DataSet& set;
    const ParameterSpace& space;
    const Predictor& network;
    const StoredPosterior& posterior;
    std::vector<Candidate> candidates;
    PairedRuns runs;
    std::vector<Eigen::VectorXd> finer;  ///< by base run, empty where there are none
    int threads = 1;
};

/// A table, a posterior and paired runs as a diagnosis problem.
class DiagnosisStudy {
  public:
    /// InputError if no fitted shot has a shape with signatures.
    explicit DiagnosisStudy(DiagnosisInputs inputs);

    /// The errors of the problem are those at `unit`.
    DiagnosisProblem problem_at(const Eigen::VectorXd& unit) const;
    /// Maxima of the posterior and some of its draws.
    RowMatrix starts() const;
    DiagnosisFacts facts(const DiagnosisProblem& problem,
                         const Diagnosis& diagnosis) const;

    const DiagnosisInputs& inputs() const { return inputs_; }
    const CorrectedPredictor& predictor() const { return predictor_; }
    const std::vector<Datum>& data() const { return data_; }

  private:
    struct View {
        CorrectedModel model;
        ErrorBudget errors;
    };
    const View& view_at(const Eigen::VectorXd& unit) const;
    void keep_diagnosable();
    RowMatrix shot_descriptors(const Eigen::VectorXd& unit) const;

    DiagnosisInputs inputs_;
    CorrectedPredictor predictor_;
    std::vector<Datum> data_;  // fitted numbers that signatures cover
    std::vector<std::string> left_out_;
    // Problems refer to their model: views stay for the study's life.
    mutable std::vector<std::unique_ptr<View>> views_;
};

}  // namespace taylorcal::calibrate
