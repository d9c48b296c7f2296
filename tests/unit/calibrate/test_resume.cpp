#include "calibrate/sampling/sample_posterior.hpp"
#include "common/atomic_file.hpp"
#include "tests/unit/calibrate/toy_models.hpp"

#include <atomic>
#include <filesystem>

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::calibrate;

namespace {

/// Two lots, one parameter shared and one of each lot's own, known so well that the
/// proposal must be looked for. It can be killed after a number of predictions.
struct Problem {
    Settings settings;
    DataSet set;
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / "resume_test.checkpoint";
    mutable std::atomic<long> predicted = 0;
    mutable std::atomic<long> last = -1;
    toys::ClosedForm model{[this](const Shot&, const Eigen::VectorXd& p) {
                               if (++predicted == last) throw Killed();
                               Eigen::VectorXd f(2);
                               f << 10 + p(0), 8 + p(1) + 0.3 * p(0) * p(0);
                               return f;
                           },
                           Eigen::MatrixXd::Zero(2, 2)};
    struct Killed {};

    Problem() {
        settings.parameters = {{"a", 0, 1, false, false}, {"own", 0, 1, false, true}};
        settings.fit_sizes = {"final_length_mm", "impact_diameter_mm"};
        settings.velocity_sd_relative = 0;
        settings.draws = 24000;
        settings.draws_per_lot = 8;
        settings.kept_draws = 100;
        std::vector<Shot> shots;
        for (const char* lot : {"one", "two"})
            shots.push_back(toys::shot(
                lot, lot, 150,
                {{"final_length_mm", 10.4, 0.004}, {"impact_diameter_mm", 8.5, 0.004}}));
        set = make_data_set(shots, settings.fit_sizes);
        std::filesystem::remove(path);
    }
    Posterior sample(int threads, const std::string& key = "key",
                     std::function<void(std::uint64_t)> advance = {}) const {
        const ParameterSpace space(settings.parameters, set.lots);
        return sample_posterior(settings, set, space, model,
                                {threads, {path, key, 0}, std::move(advance)});
    }
    bool killed_after(long predictions, int threads) const {
        last = predicted + predictions;
        try {
            sample(threads);
        } catch (const Killed&) {
            last = -1;
            return true;
        }
        last = -1;
        return false;
    }
};

void check_same(const Posterior& a, const Posterior& b) {
    CHECK(a.log_evidence == b.log_evidence);
    CHECK(a.effective_sample_size == b.effective_sample_size);
    CHECK(a.predictions == b.predictions);
    CHECK(a.adaptations == b.adaptations);
    CHECK(a.reference == b.reference);
    CHECK(a.pool.units == b.pool.units);
    CHECK(a.pool.weights == b.pool.weights);
    CHECK(a.kept.units == b.kept.units);
    CHECK(a.kept.levels == b.kept.levels);
}

}  // namespace

TEST_CASE("a sampling killed again and again gives the draws of an undisturbed one",
          "[resume]") {
    const Problem problem;
    const Posterior whole = problem.sample(1);
    const long undisturbed = problem.predicted;
    REQUIRE(whole.adaptations > 2);
    std::filesystem::remove(problem.path);
    problem.predicted = 0;

    int kills = 0;
    // A quarter: more than a pass of the search, or the draws that threads have in hand.
    while (kills < 20 && problem.killed_after(undisturbed / 4, 1 + kills % 3)) ++kills;
    CHECK(kills >= 3);
    CHECK(kills < 20);
    const long before = problem.predicted;
    check_same(problem.sample(2), whole);
    // The last state was saved: nothing of it is computed again.
    CHECK(problem.predicted - before < undisturbed / 20);
    std::filesystem::remove(problem.path);
}

TEST_CASE("a kill costs a pass of the search or the draws in hand", "[resume]") {
    const Problem problem;
    const Posterior whole = problem.sample(1);
    const long undisturbed = problem.predicted;
    std::filesystem::remove(problem.path);
    problem.predicted = 0;
    REQUIRE(problem.killed_after(undisturbed * 3 / 4, 2));
    check_same(problem.sample(2), whole);
    const long batch = 32 * 1024 * 2;  // two shots
    const long pass = 2 * 4000 * 8;    // of the search
    CHECK(problem.predicted - undisturbed <= std::max(batch, pass) + undisturbed / 100);
    std::filesystem::remove(problem.path);
}

TEST_CASE("a checkpoint of another sampling, or a damaged one, is not used", "[resume]") {
    const Problem problem;
    const Posterior whole = problem.sample(1);
    std::filesystem::remove(problem.path);
    REQUIRE(problem.killed_after(static_cast<long>(whole.predictions) / 2, 1));
    std::string key = "key";
    SECTION("another key") { key = "another"; }
    SECTION("damaged") {
        std::string bytes = read_text(problem.path);
        bytes.resize(bytes.size() / 2);
        write_text_atomically(problem.path, bytes);
    }
    problem.predicted = 0;
    check_same(problem.sample(1, key), whole);
    CHECK(problem.predicted >= static_cast<long>(whole.predictions));
    std::filesystem::remove(problem.path);
}

TEST_CASE("the parts' checkpoints go with the whole's", "[resume]") {
    const Problem problem;
    const Checkpoint whole{problem.path, "key"};
    save(whole, {{"numbers", {1, 2}}});
    save(whole.of_part("pilot"), {{"numbers", {}}});
    CHECK(saved(whole.of_part("pilot"))->at("numbers").empty());
    CHECK(saved(whole)->at("numbers") == std::vector<double>{1, 2});
    remove(whole);
    CHECK_FALSE(std::filesystem::exists(whole.path));
    CHECK_FALSE(std::filesystem::exists(whole.of_part("pilot").path));
}
