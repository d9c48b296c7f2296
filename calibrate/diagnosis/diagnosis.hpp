#pragma once

#include "calibrate/diagnosis/mode_diagnosis.hpp"
#include "calibrate/diagnosis/unstated_scatter.hpp"

#include <functional>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

/// A diagnosis over all modes of the parameters that count.
struct Diagnosis {
    std::vector<ModeDiagnosis> modes;  ///< the likeliest first
    Verdict verdict;                   ///< worst case over modes and networks
    std::vector<Verdict>
        by_network;  ///< where several were asked: that of the modes first
    std::vector<UnstatedScatter> scatter;  ///< counted among the errors
};

/// The problem seen from one point of the parameters: errors depend on it.
using ProblemAt = std::function<DiagnosisProblem(const Eigen::VectorXd& unit)>;

/// Fits from every start (a row; points of the unit cube), keeps the fits that predict
/// differently and have at least 5 % of the evidence, and diagnoses at each. Scatter that
/// the errors do not state is found at the first start and counted everywhere.
Diagnosis diagnose(const ProblemAt& problem_at, const RowMatrix& starts);

/// Of the verdicts at several modes, or with several networks: no effect is supported if
/// any explains the data. An effect that one needs and another does not see is never the
/// only answer.
Verdict worst_case(const std::vector<Verdict>& verdicts);

/// Holds the verdict against that of the same table with another network.
void ask_second_network(Diagnosis& diagnosis, const Verdict& second);

/// One paragraph for a materials scientist.
std::string verdict_words(const DiagnosisProblem& problem, const Diagnosis& diagnosis);
std::string candidate_words(const Candidate& candidate, const CandidateRecord& record);
std::string unexplained_words(const Unexplained& unexplained);

/// "anvil friction" of "anvil_friction".
std::string in_words(const std::string& name);

}  // namespace taylorcal::calibrate
