#include "emulator/training/widen.hpp"

#include "../common/temporary_folder.hpp"
#include "common/errors.hpp"
#include "emulator/inference/emulator.hpp"
#include "emulator/training/train_emulator.hpp"
#include "sample_database.hpp"

#include <cmath>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::emulator;
using Catch::Matchers::Contains;

namespace {

/// The sample database's rows and as many again in which `drag` shortens the length.
Dataset wider_data(const Dataset& old) {
    const Eigen::Index n = old.rows();
    Dataset data = old;
    data.inputs.resize(2 * n, 5);
    data.outputs.resize(2 * n, old.outputs.cols());
    const RandomStream random(8, 1);
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
        const double drag = i < n ? 0 : random.uniform(static_cast<std::uint64_t>(i));
        const auto from = old.inputs.row(i % n);
        data.inputs.row(i) << from(0), drag, from(1), from(2), from(3);
        data.outputs.row(i) = old.outputs.row(i % n);
        data.outputs(i, 0) *= 1 - 0.1 * drag * (1 + 0.5 * from(0));
        if (i < n) continue;
        data.row_ids.push_back(1000 + i);
        data.categories.push_back(old.categories[static_cast<std::size_t>(i - n)]);
    }
    return data;
}

nlohmann::json wider_config(int epochs) {
    nlohmann::json config = testing::sample_config();
    config["inputs"].insert(config["inputs"].begin() + 1, {{"name", "drag"}});
    config["epochs"] = epochs;
    return config;
}

TrainConfig parsed(const nlohmann::json& config) {
    return train_config_from_json(config, "train.json");
}

struct OldAndData {
    Model old;
    Dataset data;
};

OldAndData old_and_data(int epochs) {
    const testing::TemporaryFolder folder;
    testing::write_sample_database(folder / "database.h5", 200);
    const Dataset data = testing::read_sample_database(folder / "database.h5");
    nlohmann::json config = testing::sample_config();
    config["epochs"] = epochs;
    return {train_emulator(parsed(config), data, 2), wider_data(data)};
}

/// The description that `train_further` starts from.
Model described(const Dataset& data) {
    const TrainConfig config = parsed(wider_config(1));
    return describe(config, data,
                    split_rows(data, config.validation_fraction, config.seed));
}

}  // namespace

TEST_CASE("a widened network answers bit by bit as the old one", "[widen]") {
    const OldAndData c = old_and_data(30);
    Model model = described(c.data);
    CHECK(model.inputs[0].shift != c.old.inputs[0].shift);
    widen(model, c.old, "old.json");
    model.covariances = c.old.covariances;
    const Emulator old(c.old), wide(model);
    constexpr Eigen::Index n = 150;
    Block points(4, n), wider(5, n), before, after;
    for (Eigen::Index j = 0; j < n; ++j) {
        const auto row = c.data.inputs.row(j);
        points.col(j) << static_cast<float>(row(0)), static_cast<float>(row(2)), 294,
            static_cast<float>(row(4));
        const float drag = j < 50 ? 0 : 0.01F * static_cast<float>(j - 50);
        wider.col(j) << points(0, j), drag, points(1, j), 294, points(3, j);
    }
    Workspace workspace;
    for (std::size_t member = 0; member < 2; ++member) {
        for (const char* kind : {"curved", "plain"}) {
            const int category = old.category_index(kind);
            old.evaluate_member(member, points, category, before, workspace);
            wide.evaluate_member(member, wider, category, after, workspace);
            CHECK((before == after).all());
        }
    }
    CHECK(wide.input_index("drag") == 1);
    CHECK(model.members[0].layers[1].weights.rows() == 13);
}

TEST_CASE("going on from an old network is quicker than starting anew", "[widen]") {
    const OldAndData c = old_and_data(200);
    nlohmann::json config = wider_config(60);
    config["neurons"] = 99;  // those of the old network are kept
    const Model further = train_further(c.old, "old.json", parsed(config), c.data, 2);
    CHECK(further.members.front().layers.front().bias.size() == 13);
    const Model anew = train_emulator(parsed(wider_config(60)), c.data, 2);
    const auto rms = [](const Model& model) {
        return model.validation.at("rms_relative").get<double>();
    };
    CAPTURE(rms(c.old), rms(further), rms(anew));
    CHECK(rms(further) < 0.01);
    CHECK(rms(further) < rms(anew));
    CHECK(further.provenance.contains("from"));
    const Model again = train_further(c.old, "old.json", parsed(config), c.data, 1);
    CHECK(to_json(again).dump() == to_json(further).dump());
}

TEST_CASE("a network that does not fit is not widened", "[widen]") {
    const OldAndData c = old_and_data(1);
    const auto refusal = [&](const nlohmann::json& config, const Model& old) {
        try {
            train_further(old, "old.json", parsed(config), c.data, 1);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    Model other = c.old;
    other.inputs[0].name = "haste";
    CHECK_THAT(refusal(wider_config(1), other),
               Contains("old.json") && Contains("\"haste\"") && Contains("--from"));
    other = c.old;
    other.category.values = {"curved", "round"};
    CHECK_THAT(refusal(wider_config(1), other), Contains("round"));
    other = c.old;
    other.inputs[1].transform = Transform::linear;
    CHECK_THAT(refusal(wider_config(1), other), Contains("another transform"));
    other = c.old;
    other.outputs[0].name = "width";
    CHECK_THAT(refusal(wider_config(1), other), Contains("outputs") && Contains("width"));
}
