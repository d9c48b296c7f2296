#pragma once

#include "calibrate/diagnosis/adequacy.hpp"
#include "calibrate/diagnosis/bad_data.hpp"
#include "calibrate/diagnosis/evidence.hpp"
#include "calibrate/diagnosis/unexplained.hpp"

#include <optional>
#include <string>
#include <vector>

namespace taylorcal::calibrate {

enum class VerdictKind {
    no_effect_supported,
    effect,
    one_of,
    not_distinguishable,
    outside_the_list,
    bad_data
};

std::string verdict_word(VerdictKind kind);

/// What is missing. `effect` with several candidates: all of them together.
struct Verdict {
    VerdictKind kind = VerdictKind::no_effect_supported;
    std::vector<std::size_t> effects;
    std::vector<Suspect> suspects;
    bool is_flagged = false;
};

/// One candidate's whole record at a mode.
struct CandidateRecord {
    Screening screening;
    std::string why_unseen;
    bool abstain = true;
    std::optional<EffectEvidence> evidence;  ///< unless abstained
    double smallest_detectable = 0;          ///< amplitude seen with 90 % power
    double leave_out_gain = 0;
    bool has_physical_sign = false;
    bool explains = false;  ///< adequate when it is switched on
    bool in_set = false;
    std::size_t alike = 0;  ///< other candidates with |R| > 0.9
};

/// Two candidates together.
struct PairRecord {
    std::vector<std::size_t> effects;
    double log_gain = 0;
    bool explains = false;
};

/// A diagnosis at one mode of the parameters.
struct ModeDiagnosis {
    Whitening whiten;
    Refit base;
    double log_height = 0;  ///< ln of the likelihood averaged about the mode
    double share = 1;
    Adequacy adequacy{};
    std::vector<CandidateRecord> candidates{};
    Eigen::MatrixXd cosine{};  ///< R of the projected effects
    std::vector<PairRecord> pairs{};
    double unlisted_gain = 0;         ///< ln Z of a smooth misfit without a listed cause
    std::vector<Suspect> suspects{};  ///< of all shots and numbers
    Unexplained unexplained{};        ///< by the best explanation there is
    Verdict verdict{};
};

/// The steps of the README at one mode: fits the parameters from `start`, tests, screens
/// and competes.
ModeDiagnosis diagnose_mode(const DiagnosisProblem& problem, const Eigen::VectorXd& start,
                            const NormalTable& table);

}  // namespace taylorcal::calibrate
