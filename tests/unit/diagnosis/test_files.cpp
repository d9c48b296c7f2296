#include "calibrate/diagnosis/candidates_file.hpp"
#include "calibrate/diagnosis/diagnosis_study.hpp"
#include "calibrate/diagnosis/shot_design.hpp"
#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "common/random.hpp"
#include "tests/unit/calibrate/table_file.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

json candidate(const std::string& name) {
    return {{"name", name},
            {"kind", "effect"},
            {"unit", "1"},
            {"base", 0},
            {"lowest", 0},
            {"highest", 1},
            {"prior", {{"kind", "half_normal"}, {"scale", 0.2}}},
            {"signed", false}};
}

std::vector<Candidate> read(const json& candidates) {
    const toys::TemporaryFile file("candidates.json");
    write_text_atomically(file.path(), json{{"candidates", candidates}}.dump());
    return read_candidates(file.path());
}

/// What the toy solver gives: two sizes, a strength, and friction that widens the foot
/// the more the faster the shot; grains scatter both sizes by 0.02 mm.
Eigen::Vector2d toy_sizes(double velocity_m_s, double strength, double friction,
                          double grain) {
    const double t = velocity_m_s / 100;
    return {40 - 6 * t * t / strength + grain,
            8 + 2 * t * t / strength - 3 * friction * t};
}

struct Row {
    std::int64_t seed;
    double velocity, strength, friction, skin;
};

void write_runs(const std::filesystem::path& path, const std::vector<Row>& rows) {
    const auto n = static_cast<Eigen::Index>(rows.size());
    RowMatrix inputs(n, 7), outputs(n, 2), descriptors(n, 1);
    std::vector<std::int64_t> ids, seeds;
    for (Eigen::Index i = 0; i < n; ++i) {
        const Row& row = rows[static_cast<std::size_t>(i)];
        inputs.row(i) << row.velocity, 8, 5, 295, row.strength, row.friction, row.skin;
        const double grain =
            0.02 * RandomStream(4, 4).normal(static_cast<std::uint64_t>(row.seed));
        outputs.row(i) =
            toy_sizes(row.velocity, row.strength, row.friction, grain).transpose();
        descriptors(i, 0) = row.velocity * row.velocity;
        ids.push_back(i);
        seeds.push_back(row.seed);
    }
    Hdf5Writer file(path);
    file.integers("run_id", ids);
    file.integers("seed", seeds);
    file.texts("shape", std::vector<std::string>(rows.size(), "uniform_cylinder"));
    file.matrix("inputs", inputs);
    file.attribute("names",
                   std::vector<std::string>{"velocity_m_s", "initial_diameter_mm",
                                            "length_to_diameter", "initial_temperature_K",
                                            "strength", "friction", "skin"},
                   "inputs");
    file.matrix("outputs", outputs);
    file.attribute("names",
                   std::vector<std::string>{"final_length_mm", "impact_diameter_mm"},
                   "outputs");
    file.matrix("descriptors", descriptors);
    file.attribute("names", std::vector<std::string>{"plastic_work_J"}, "descriptors");
    file.integers("status", std::vector<std::int64_t>(rows.size(), 0));
    file.attribute("schema", std::string("taylorcal/database/1"));
    file.close();
}

/// Pairs at eight velocities; candidates friction and skin, the latter without effect.
std::vector<Row> paired_rows() {
    std::vector<Row> rows;
    for (int i = 0; i < 8; ++i) {
        const double velocity = 100 + 15 * i, strength = 1 + 0.02 * (i % 3);
        rows.push_back({i, velocity, strength, 0, 0});
        rows.push_back({i, velocity, strength, i % 2 == 0 ? 0.1 : 0.2, 0});
        rows.push_back({i, velocity, strength, 0, 0.1});
    }
    return rows;
}

/// A table of twelve shots, whose network is wrong by 0.1 mm in length.
struct ToyStudy {
    Settings settings = parse_settings(
        {{"parameters", {{{"name", "strength"}, {"lower", 0.5}, {"upper", 2}}}},
         {"fit_sizes", {"final_length_mm", "impact_diameter_mm"}}},
        "calibrate.json");
    toys::ClosedForm network{[](const Shot& shot, const Eigen::VectorXd& p) {
                                 Eigen::VectorXd sizes =
                                     toy_sizes(shot.velocity_m_s, p(0), 0, 0);
                                 sizes(0) += 0.1;
                                 return sizes;
                             },
                             Eigen::MatrixXd::Identity(2, 2) * 1e-4};
    DataSet set;
    StoredPosterior posterior;
    std::vector<Candidate> candidates = read({candidate("friction"), candidate("skin")});

    explicit ToyStudy(double friction, std::uint64_t seed = 9) {
        const RandomStream noise(seed, 1);
        std::vector<Shot> shots;
        for (std::uint64_t i = 0; i < 12; ++i) {
            const double velocity = 105 + 8.0 * static_cast<double>(i);
            const Eigen::Vector2d exact =
                toy_sizes(velocity, 1.05, friction, 0.02 * noise.normal(100 + i));
            shots.push_back(toys::shot(
                fmt::format("s{}", i), "lot", velocity,
                {{"final_length_mm", exact(0) + 0.03 * noise.normal(2 * i), 0.03},
                 {"impact_diameter_mm", exact(1) + 0.03 * noise.normal(2 * i + 1),
                  0.03}}));
            shots.back().velocity_sd_m_s = 0.2;
        }
        set = make_data_set(shots, settings.fit_sizes);
        posterior.maxima_units = RowMatrix::Constant(1, 1, 0.4);
        posterior.units = RowMatrix::Constant(3, 1, 0.38);
    }
    /// The shots in another order, in lots of their own strength.
    void use(const std::vector<Shot>& shots) {
        settings.parameters.front().per_lot = true;
        set = make_data_set(shots, settings.fit_sizes);
        const auto lots = std::ssize(set.lots);
        posterior.maxima_units = RowMatrix::Constant(1, lots, 0.4);
        posterior.units = RowMatrix::Constant(3, lots, 0.38);
    }
    /// Calls `work` with the study; `finer`: what finer runs change [mm], empty: none.
    void with_study(const std::vector<Row>& rows, const auto& work,
                    const Eigen::VectorXd& finer = {}) const {
        const ParameterSpace space(settings.parameters, set.lots);
        const toys::TemporaryFile file("signatures.h5");
        write_runs(file.path(), rows);
        const PairedRuns runs = read_paired_runs(file.path(), settings, candidates);
        work(DiagnosisStudy({settings, set, space, network, posterior, candidates, runs,
                             std::vector<Eigen::VectorXd>(runs.bases.size(), finer)}));
    }
    Diagnosis diagnose(const std::vector<Row>& rows,
                       nlohmann::json* json = nullptr) const {
        Diagnosis found;
        with_study(rows, [&](const DiagnosisStudy& study) {
            found = calibrate::diagnose(
                [&](const Eigen::VectorXd& unit) { return study.problem_at(unit); },
                study.starts());
            if (!json) return;
            const DiagnosisProblem problem =
                study.problem_at(found.modes.front().base.unit);
            DiagnosisFacts facts = study.facts(problem, found);
            facts.next_experiments = design_shots(study, problem, found.modes.front(),
                                                  found.verdict.effects, 5);
            *json = to_json(problem, found, facts);
        });
        return found;
    }
};

}  // namespace

TEST_CASE("an effect in the data is found through the files", "[study]") {
    json written;
    const Diagnosis found = ToyStudy(0.15).diagnose(paired_rows(), &written);
    CHECK(found.verdict.kind == VerdictKind::effect);
    CHECK(written["verdict"]["effects"] == json{"friction"});
    CHECK_THAT(written["verdict"]["words"].get<std::string>(), Contains("friction (0.1"));
    const json& best = written["candidates"][0];
    CHECK(best["name"] == "friction");
    CHECK(best["amplitude"].get<double>() == Approx(0.15).margin(0.02));
    CHECK(std::abs(best["amplitude"].get<double>() - 0.15) <
          3 * best["amplitude_sd"].get<double>());
    // The candidate that changes nothing is not judged.
    CHECK(written["candidates"][1]["abstain"] == true);
    CHECK(written["residuals"].size() == 24);
}

TEST_CASE("an amplitude beyond its paired runs is not found", "[study]") {
    json written;
    ToyStudy(0.4).diagnose(paired_rows(), &written);  // run at 0.1 and 0.2
    const json& best = written["candidates"][0];
    CHECK(best["name"] == "friction");
    CHECK(best["amplitude"].get<double>() == Approx(0.225));
    CHECK(best["at_end_of_runs"] == true);
    CHECK_THAT(best["words"].get<std::string>(),
               Contains("held where its signature runs end"));
}

TEST_CASE("the network's own error is no physics", "[study]") {
    int flagged = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        flagged += ToyStudy(0, seed).diagnose(paired_rows()).verdict.is_flagged;
    CHECK(flagged <= 3);
}

TEST_CASE("the next shots do not depend on the order of the table", "[study]") {
    std::vector<Shot> shots;
    for (int i = 0; i < 12; ++i) {
        const double velocity = 105 + 8.0 * i;
        const bool in_few = i % 3 == 0;
        const Eigen::Vector2d exact = toy_sizes(velocity, in_few ? 0.8 : 1.2, 0.15, 0);
        shots.push_back(toys::shot(fmt::format("s{}", i), in_few ? "few" : "old_stock",
                                   velocity,
                                   {{"final_length_mm", exact(0), 0.03},
                                    {"impact_diameter_mm", exact(1), 0.03}}));
        shots.back().velocity_sd_m_s = 0.2;
    }
    std::vector<json> next;
    for (int turn = 0; turn < 2; ++turn) {
        ToyStudy study(0);
        study.use(shots);
        json written;
        study.diagnose(paired_rows(), &written);
        next.push_back(written["next_experiments"]);
        std::reverse(shots.begin(), shots.end());
    }
    REQUIRE(next[0].size() == 5);
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(next[0][i]["velocity_m_s"] == next[1][i]["velocity_m_s"]);
        CHECK(next[0][i]["separation"].get<double>() ==
              Approx(next[1][i]["separation"].get<double>()).epsilon(1e-3));
        CHECK(next[0][i]["lot"] == "old_stock");
        CHECK_THAT(next[0][i]["words"].get<std::string>(),
                   Contains("uniform cylinder of lot old stock at"));
    }
}

TEST_CASE("a new shot's resolution errs as that of the shots of the table", "[study]") {
    const ToyStudy toy(0);
    const ParameterSpace space(toy.settings.parameters, toy.set.lots);
    const Eigen::VectorXd unit = Eigen::VectorXd::Constant(1, 0.4);
    std::vector<Eigen::MatrixXd> of_table, of_new_shot;
    const Eigen::Vector2d change(-0.2, 0.1);
    // The other errors are the same with half the change.
    for (const double share : {1.0, 0.5})
        toy.with_study(
            paired_rows(),
            [&](const DiagnosisStudy& study) {
                const Datum& datum = study.data().front();
                const CorrectedModel model(study.predictor(), space, {&datum}, unit);
                of_table.push_back(
                    error_budget(study.predictor(), model, toy.settings).resolution);
                of_new_shot.push_back(covariance_of_new_shot(
                    study.predictor(), toy.settings, datum.shot,
                    space.lot_parameters(unit.transpose(), 0), Eigen::Vector2d::Zero()));
            },
            share * change);
    const Eigen::MatrixXd expected = of_table[0] - of_table[1];
    const Eigen::MatrixXd found = of_new_shot[0] - of_new_shot[1];
    REQUIRE(expected.norm() > 1e-3);
    CHECK((found - expected).norm() < 1e-6 * expected.norm());
}

TEST_CASE("a candidate without runs could not be seen", "[study]") {
    std::vector<Row> rows;
    for (const Row& row : paired_rows())
        if (row.skin == 0) rows.push_back(row);
    json written;
    ToyStudy(0).diagnose(rows, &written);
    CHECK_THAT(written["verdict"]["words"].get<std::string>(),
               Contains("for want of signature runs: skin"));
}

TEST_CASE("signatures that do not pair are refused by row", "[errors]") {
    std::vector<Row> rows = paired_rows();
    rows[1].seed = 99;
    CHECK_THROWS_WITH(ToyStudy(0).diagnose(rows),
                      Contains("run 1") && Contains("no run without friction"));
    rows = paired_rows();
    rows[1].skin = 0.3;
    CHECK_THROWS_WITH(ToyStudy(0).diagnose(rows), Contains("friction and skin at once"));
    rows.resize(6);
    rows[1].skin = 0;
    CHECK_THROWS_WITH(ToyStudy(0).diagnose(rows),
                      Contains("too few finished runs") && Contains("uniform cylinder"));
}

TEST_CASE("candidates are read strictly", "[errors]") {
    CHECK(read({candidate("a"), candidate("b")}).size() == 2);
    CHECK_THROWS_WITH(read(json::array()), Contains("is empty"));
    CHECK_THROWS_WITH(read({candidate("a"), candidate("a")}), Contains("there twice"));
    json wrong = candidate("a");
    wrong["base"] = 3;
    CHECK_THROWS_WITH(read(json::array({wrong})),
                      Contains("not within lowest = 0 to highest = 1"));
    wrong = candidate("a");
    wrong["prior"]["scale"] = 0;
    CHECK_THROWS_WITH(read(json::array({wrong})), Contains("width above 0"));
    wrong = candidate("a");
    wrong["highst"] = 2;
    CHECK_THROWS_WITH(read(json::array({wrong})),
                      Contains("highst") && Contains("highest"));
}
