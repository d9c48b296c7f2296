#include "calibrate/commands/diagnose.hpp"

#include "calibrate/diagnosis/candidates_file.hpp"
#include "calibrate/diagnosis/shot_design.hpp"
#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/json_reader.hpp"
#include "common/provenance.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include <fmt/core.h>
#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

namespace taylorcal::calibrate {
namespace {

constexpr std::size_t shots_in_diagnosis = 5;
constexpr std::size_t shots_in_design = 20;

/// The member of the ensemble with the least errors but for the one that answers.
std::optional<std::size_t> second_best(const emulator::Emulator& ensemble) {
    std::optional<std::size_t> second;
    const auto& members = ensemble.model().members;
    for (std::size_t i = 0; i < members.size(); ++i)
        if (i != ensemble.best() &&
            (!second || members[i].validation_rms < members[*second].validation_rms))
            second = i;
    return second;
}

void require_output(const std::filesystem::path& out, const InputPaths& files,
                    const DiagnosisPaths& paths) {
    require_writable(out,
                     {files.settings, files.measurements, files.emulator, paths.posterior,
                      paths.signatures, paths.finer, paths.candidates});
}

/// Everything read, and the diagnosis of it.
class DiagnosedStudy {
  public:
    DiagnosedStudy(const InputPaths& files, const DiagnosisPaths& paths, int threads)
        : inputs_(files),
          levels_(spread_levels(inputs_.settings)),
          posterior_(
              read_posterior(paths.posterior, inputs_.space, levels_, inputs_.settings)),
          candidates_(read_candidates(paths.candidates)),
          runs_(read_paired_runs(paths.signatures, inputs_.settings, candidates_)),
          finer_(read_finer(paths)),
          study_(with_network(inputs_.predictor, threads)) {
        require(inputs_.settings.likelihood == LikelihoodForm::full,
                fmt::format("{}: likelihood = paper has no model of the errors, without "
                            "which nothing can be found missing. Set it to full.",
                            files.settings.string()));
        for (std::size_t k = 0; k < candidates_.size(); ++k)
            if (!runs_.has_column[k])
                spdlog::warn("{}: no column {}; it could not be seen",
                             paths.signatures.string(), candidates_[k].name);
        result = diagnosis_of(study_);
        const emulator::Emulator& ensemble = inputs_.predictor.emulator();
        if (const std::optional<std::size_t> second = second_best(ensemble)) {
            const NetworkPredictor network(ensemble.answering_with(*second),
                                           inputs_.settings);
            const DiagnosisStudy study(with_network(network, threads));
            ask_second_network(result, diagnosis_of(study).verdict);
        }
    }
    DiagnosisProblem problem() const {
        DiagnosisProblem problem = study_.problem_at(result.modes.front().base.unit);
        count_scatter(result.scatter, problem);
        return problem;
    }
    const DiagnosisStudy& study() const { return study_; }
    nlohmann::json provenance_of_inputs() const {
        return provenance("calibrate", inputs_.settings.seed, inputs_.settings.source);
    }

    Diagnosis result;

  private:
    static Diagnosis diagnosis_of(const DiagnosisStudy& study) {
        const auto problem_at = [&](const Eigen::VectorXd& unit) {
            return study.problem_at(unit);
        };
        return calibrate::diagnose(problem_at, study.starts());
    }
    std::vector<Eigen::VectorXd> read_finer(const DiagnosisPaths& paths) const {
        if (paths.finer.empty()) return std::vector<Eigen::VectorXd>(runs_.bases.size());
        return finer_changes(runs_,
                             read_paired_runs(paths.finer, inputs_.settings, candidates_),
                             paths.finer);
    }
    DiagnosisInputs with_network(const Predictor& network, int threads) const {
        return {inputs_.settings, inputs_.set, inputs_.space, network, posterior_,
                candidates_,      runs_,       finer_,        threads};
    }

    StudyInputs inputs_;
    SpreadLevels levels_;
    StoredPosterior posterior_;
    std::vector<Candidate> candidates_;
    PairedRuns runs_;
    std::vector<Eigen::VectorXd> finer_;  // by base run, empty where there are none
    DiagnosisStudy study_;
};

}  // namespace

void diagnose(const InputPaths& files, const DiagnosisPaths& paths,
              const std::filesystem::path& out, int threads) {
    require_output(out, files, paths);
    const DiagnosedStudy diagnosed(files, paths, threads);
    const DiagnosisProblem problem = diagnosed.problem();
    DiagnosisFacts facts = diagnosed.study().facts(problem, diagnosed.result);
    facts.next_experiments =
        design_shots(diagnosed.study(), problem, diagnosed.result.modes.front(),
                     diagnosed.result.verdict.effects, shots_in_diagnosis);
    nlohmann::json json = to_json(problem, diagnosed.result, facts);
    json["provenance"] = diagnosed.provenance_of_inputs();
    write_text_atomically(out, json.dump(1) + "\n");
    fmt::print("verdict: {}\n{}\n", json["verdict"]["kind"].get<std::string>(),
               json["verdict"]["words"].get<std::string>());
    for (const auto& candidate : json["candidates"])
        fmt::print("  {}\n", candidate["words"].get<std::string>());
}

void design(const InputPaths& files, const DiagnosisPaths& paths,
            const std::filesystem::path& diagnosis, const std::filesystem::path& out,
            int threads) {
    require_output(out, files, paths);
    require_writable(out, {diagnosis});
    const JsonReader stored = JsonReader::from_file(diagnosis);
    require(stored.text("schema") == "taylorcal/diagnosis/1",
            fmt::format("{}: its schema is {} (expected taylorcal/diagnosis/1). Diagnose "
                        "again.",
                        diagnosis.string(), stored.text("schema")));
    const std::vector<std::string> names = stored.object("verdict").texts("effects");
    const DiagnosedStudy diagnosed(files, paths, threads);
    const DiagnosisProblem problem = diagnosed.problem();
    std::vector<std::size_t> set;
    for (const std::string& name : names) {
        const auto found =
            std::find_if(problem.candidates.begin(), problem.candidates.end(),
                         [&](const Candidate& c) { return c.name == name; });
        require(
            found != problem.candidates.end(),
            fmt::format("{}: its verdict names {}, which is not among the candidates. "
                        "Diagnose again with these candidates.",
                        diagnosis.string(), name));
        set.push_back(static_cast<std::size_t>(found - problem.candidates.begin()));
    }
    const std::vector<NextExperiment> shots = design_shots(
        diagnosed.study(), problem, diagnosed.result.modes.front(), set, shots_in_design);
    const nlohmann::json json{{"schema", "taylorcal/next_experiment/1"},
                              {"effects", names},
                              {"next_experiments", to_json(shots)},
                              {"provenance", diagnosed.provenance_of_inputs()}};
    write_text_atomically(out, json.dump(1) + "\n");
    for (std::size_t i = 0; i < std::min<std::size_t>(5, shots.size()); ++i)
        fmt::print("{}\n", shots[i].words);
}

}  // namespace taylorcal::calibrate
