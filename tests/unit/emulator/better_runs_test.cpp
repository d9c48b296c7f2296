#include "../common/temporary_folder.hpp"
#include "common/errors.hpp"
#include "emulator/inference/emulator.hpp"
#include "emulator/training/quality.hpp"
#include "emulator/training/train_emulator.hpp"
#include "naive_evaluation.hpp"
#include "sample_database.hpp"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::emulator;
using Catch::Matchers::Contains;

namespace {

constexpr int cheap_rows = 400;

/// What the cheaper solver gets wrong: lengths, the more the faster.
double bias(double speed) { return 1.03 + 0.02 * speed; }

/// Many runs of a solver with a bias, and `better_rows` of one without.
Dataset two_solvers(const std::filesystem::path& folder, int better_rows) {
    testing::write_sample_database(folder / "cheap.h5", cheap_rows, 5);
    testing::write_sample_database(folder / "better.h5", better_rows, 6);
    Dataset cheap = testing::read_sample_database(folder / "cheap.h5");
    Dataset better = testing::read_sample_database(folder / "better.h5");
    for (Eigen::Index i = 0; i < cheap.rows(); ++i)
        cheap.outputs(i, 0) *= bias(cheap.inputs(i, 0));
    for (std::int64_t& id : better.row_ids) id += 1000;
    return with_better_runs(cheap, better, "better.h5");
}

TrainConfig config_of(int epochs) {
    nlohmann::json config = testing::sample_config();
    config["epochs"] = epochs;
    return train_config_from_json(config, "train.json");
}

/// Relative RMS error of the length over fresh runs of the better solver.
double rms_of(const Model& model) {
    const testing::TemporaryFolder folder;
    testing::write_sample_database(folder / "fresh.h5", 300, 9);
    const Dataset fresh = testing::read_sample_database(folder / "fresh.h5");
    std::vector<Eigen::Index> rows;
    for (Eigen::Index i = 0; i < fresh.rows(); ++i) rows.push_back(i);
    const RowMatrix predicted = predict_rows(Emulator(model), fresh, rows);
    return std::sqrt(
        (predicted.col(0).array() / fresh.outputs.col(0).array() - 1).square().mean());
}

}  // namespace

TEST_CASE("few better runs correct many cheaper ones", "[better]") {
    const testing::TemporaryFolder folder;
    const Dataset data = two_solvers(folder.path(), 60);
    const TrainConfig config = config_of(300);
    const Model model = train_emulator(config, data, 2);
    CHECK(model.validation.at("cheaper_rows") == cheap_rows - 1);
    CHECK(model.validation.at("rows") == 12);  // a fifth of the better ones
    CHECK(model.members.front().layers.front().weights.cols() == 3 + 2 + 1);

    // Held against the better solver's own function; the cheaper one's is 3 to 5 % off.
    const double corrected = rms_of(model);
    const Dataset few = testing::read_sample_database(folder / "better.h5");
    const double alone = rms_of(train_emulator(config, few, 2));
    CAPTURE(corrected, alone);
    CHECK(corrected < 0.01);
    CHECK(corrected < alone / 2);

    SECTION("the file says how to answer as the better solver") {
        const nlohmann::json file = to_json(model);
        const Emulator read(model_from_json(file, "emulator.json"));
        Block point(4, 1), answer;
        point << 0.3F, 1e12F, 294, 7;
        Workspace workspace;
        read.evaluate(point, read.category_index("curved"), answer, workspace);
        const auto by_hand = testing::follow_recipe(
            file, read.best(),
            {{"speed", 0.3F}, {"density", 1e12F}, {"temperature", 294}, {"size", 7}},
            "curved");
        CHECK(answer(0, 0) == Approx(by_hand[0]).epsilon(1e-5));
        // Whoever takes the layers as they are must not meet the cheaper solver's column.
        CHECK(read.model().members.front().layers.front().weights.cols() == 3 + 2);
        CHECK_FALSE(read.model().corrects_cheaper_runs);
    }
    SECTION("training goes on from it, with what it knows of both solvers") {
        TrainConfig further = config;
        further.epochs = 1;
        for (double& rate : further.learning_rates) rate = 1e-8;
        const Model same = train_further(model, "emulator.json", further, data, 2);
        CHECK(same.validation.at("rms_relative").get<double>() ==
              Approx(model.validation.at("rms_relative").get<double>()).epsilon(1e-3));
        CHECK_THROWS_WITH(train_further(model, "emulator.json", further, few, 2),
                          Contains("learnt from runs of two solvers"));
        const Model plain = train_emulator(config, few, 2);
        CHECK_NOTHROW(train_further(plain, "emulator.json", further, data, 2));
    }
}

TEST_CASE("a run cannot be of both solvers", "[better]") {
    const testing::TemporaryFolder folder;
    testing::write_sample_database(folder / "cheap.h5", 20);
    const Dataset data = testing::read_sample_database(folder / "cheap.h5");
    CHECK_THROWS_WITH(with_better_runs(data, data, "better.h5"),
                      Contains("better.h5: run 0 is among those of the cheaper solver"));
}
