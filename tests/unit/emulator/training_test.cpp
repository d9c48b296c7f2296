#include "../common/temporary_folder.hpp"
#include "common/errors.hpp"
#include "emulator/inference/emulator.hpp"
#include "emulator/training/split.hpp"
#include "emulator/training/train_emulator.hpp"
#include "sample_database.hpp"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::emulator;
using Catch::Matchers::Contains;
using testing::KnownFunction;

namespace {

Model train_sample(int rows, nlohmann::json settings, int threads) {
    const testing::TemporaryFolder folder;
    testing::write_sample_database(folder / "database.h5", rows);
    return train_emulator(train_config_from_json(settings, "train.json"),
                          testing::read_sample_database(folder / "database.h5"), threads);
}

}  // namespace

TEST_CASE("a known smooth function is learnt within half a percent", "[training]") {
    const Model model = train_sample(400, testing::sample_config(), 2);
    CHECK(model.validation.at("dropped_rows") == 1);
    CHECK(model.validation.at("rms_relative") < 0.005);
    const Emulator emulator(model);
    CHECK_FALSE(emulator.inputs()[2].used);
    CHECK(emulator.has_output("ratio", "curved"));
    CHECK_FALSE(emulator.has_output("ratio", "plain"));

    // Against the function itself, at points that no row had.
    constexpr Eigen::Index n = 200;
    Block points(4, n), results;
    const RandomStream random(99, 1);
    for (Eigen::Index j = 0; j < n; ++j) {
        const auto number = [&](int k) {
            return random.uniform(static_cast<std::uint64_t>(4 * j + k));
        };
        points.col(j) << static_cast<float>(number(0)),
            static_cast<float>(std::pow(10.0, 10 + 5 * number(1))), 294,
            static_cast<float>(5 + 5 * number(2));
    }
    Workspace workspace;
    emulator.evaluate(points, emulator.category_index("curved"), results, workspace);
    double squares = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
        const double speed = points(0, j), density = points(1, j), size = points(3, j);
        const double length = KnownFunction::length(speed, density, size, false);
        const double ratio = KnownFunction::ratio(speed, density);
        squares += std::pow(results(0, j) / length - 1, 2) +
                   std::pow(results(1, j) / ratio - 1, 2);
    }
    CHECK(std::sqrt(squares / (2 * n)) < 0.005);
}

TEST_CASE("the emulator is the same for one and for two threads", "[training]") {
    nlohmann::json settings = testing::sample_config();
    settings["epochs"] = 5;
    settings["members"] = 3;
    const nlohmann::json once = to_json(train_sample(60, settings, 1));
    CHECK(once.dump() == to_json(train_sample(60, settings, 2)).dump());
    settings["seed"] = 4;
    CHECK(once["members"] != to_json(train_sample(60, settings, 1))["members"]);
}

TEST_CASE("members differ and the best is the one that is lowest on held-out rows",
          "[training]") {
    nlohmann::json settings = testing::sample_config();
    settings["epochs"] = 20;
    settings["members"] = 3;
    const Model model = train_sample(60, settings, 2);
    CHECK(model.members[1].batch_size == 16);
    CHECK(model.members[2].learning_rate == 0.01);
    CHECK(model.members[0].layers[0].weights != model.members[2].layers[0].weights);
    CHECK(model.members[0].layers.size() == 8);
    CHECK(model.members[0].layers[3].weights.rows() == 4 * 3 + 1);
    for (const Member& member : model.members) {
        CHECK(member.validation_rms >= model.members[model.best].validation_rms);
    }
}

TEST_CASE("which rows are held out follows from their ids and the seed", "[split]") {
    Dataset data;
    for (int i = 0; i < 100; ++i) {
        data.row_ids.push_back(1000 - i);
        data.categories.emplace_back(i < 40 ? "few" : "many");
    }
    const Split split = split_rows(data, 0.2, 1);
    CHECK(split.validation.size() == 8 + 12);
    CHECK(split.training.size() == 80);
    std::ranges::reverse(data.row_ids);
    std::ranges::reverse(data.categories);
    std::vector<Eigen::Index> mirrored;
    for (const Eigen::Index row : split_rows(data, 0.2, 1).validation) {
        mirrored.push_back(99 - row);
    }
    std::ranges::reverse(mirrored);
    CHECK(mirrored == split.validation);
    CHECK(split_rows(data, 0.2, 2).validation != mirrored);
}

TEST_CASE("what cannot be learnt is refused with the place", "[training]") {
    const testing::TemporaryFolder folder;
    testing::write_sample_database(folder / "database.h5", 60);
    CHECK_THROWS_WITH(read_dataset(folder / "database.h5", {"sped"}, "", {"length"}),
                      Contains("database.h5") && Contains("\"speed\" meant?"));
    CHECK_THROWS_WITH(read_dataset(folder / "database.h5", {"speed"}, "", {"width"}),
                      Contains("\"outputs\" has no column \"width\""));
    CHECK_THROWS_WITH(train_sample(5, testing::sample_config(), 1),
                      Contains("database.h5: ") && Contains("Add runs"));

    const auto refused = [](const std::string& key, const nlohmann::json& value) {
        nlohmann::json settings = testing::sample_config();
        settings[key] = value;
        train_config_from_json(settings, "train.json");
    };
    CHECK_THROWS_WITH(refused("epoch", 10), Contains("epoch is not a known key") &&
                                                Contains("\"epochs\" meant?"));
    CHECK_THROWS_WITH(refused("epochs", 0), Contains("epochs = 0"));
    CHECK_THROWS_WITH(refused("learning_rates", {-1}),
                      Contains("learning_rates holds -1"));
    CHECK_THROWS_WITH(refused("inputs", nlohmann::json::array()),
                      Contains("inputs is empty"));
    CHECK_THROWS_WITH(refused("inputs", {{{"name", "speed"}}, {{"name", "speed"}}}),
                      Contains("inputs[1].name = \"speed\" is given twice"));
    CHECK_THROWS_WITH(refused("outputs", {{{"name", "length"}}, {{"name", "length"}}}),
                      Contains("outputs[1].name = \"length\" is given twice"));
    CHECK_THROWS_WITH(refused("outputs", {{{"name", "length"}, {"divide_by", {"mass"}}}}),
                      Contains("outputs[0].divide_by names \"mass\""));
}

TEST_CASE("a network without category knows the one shape of its runs", "[training]") {
    const testing::TemporaryFolder folder;
    testing::write_sample_database(folder / "database.h5", 60);
    nlohmann::json settings = testing::sample_config();
    settings["epochs"] = 1;
    const auto shape_after = [&](const std::string& last_shape) {
        Dataset data = testing::read_sample_database(folder / "database.h5");
        data.shapes.assign(data.row_ids.size(), "uniform_cylinder");
        data.shapes.back() = last_shape;
        return train_emulator(train_config_from_json(settings, "train.json"), data, 1)
            .only_shape;
    };
    CHECK(shape_after("uniform_cylinder").empty());  // the category tells
    settings["category"] = nullptr;
    CHECK(shape_after("uniform_cylinder") == "uniform_cylinder");
    CHECK(shape_after("truncated_cone").empty());
    CHECK(train_sample(60, settings, 1).only_shape.empty());
}

TEST_CASE("the decay of weights is a setting", "[training]") {
    nlohmann::json settings = testing::sample_config();
    settings["epochs"] = 20;
    settings["members"] = 1;
    const auto error = [&] {
        return train_sample(100, settings, 1).members.front().validation_rms;
    };
    const double by_default = error();
    settings["weight_decay"] = 0.1;
    CHECK(error() == by_default);
    settings["weight_decay"] = 0;
    CHECK(error() != by_default);
    settings["weight_decay"] = -1;
    CHECK_THROWS_WITH(error(), Contains("weight_decay"));
}
