#include "emulator/training/checkpoints.hpp"

#include "../common/temporary_folder.hpp"
#include "common/atomic_file.hpp"
#include "emulator/training/split.hpp"
#include "emulator/training/train_emulator.hpp"
#include "sample_database.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::emulator;

namespace {

/// What a member learns from, in a folder of its own.
struct SmallTraining {
    SmallTraining() {
        testing::write_sample_database(folder / "database.h5", 60);
        nlohmann::json settings = testing::sample_config();
        settings["epochs"] = 12;
        config = train_config_from_json(settings, "train.json");
        data = testing::read_sample_database(folder / "database.h5");
        const Split split = split_rows(data, 0.2, 1);
        const Model model = describe(config, data, split);
        training = standardise(model, data, split.training);
        validation = standardise(model, data, split.validation);
        settings_of_member.epochs = 12;
        settings_of_member.batch_size = 16;
        settings_of_member.widths = {training.inputs.rows(), 9, training.targets.rows()};
    }

    /// The states after each epoch, and the member at the end.
    std::pair<std::vector<MemberState>, Member> watched(MemberWatch watch = {}) const {
        std::vector<MemberState> states;
        watch.interval_s = 0;
        watch.keep = [&](const MemberState& state) { states.push_back(state); };
        Member member = train_member(settings_of_member, training, validation, watch);
        return {states, member};
    }

    testing::TemporaryFolder folder;
    TrainConfig config;
    Dataset data;
    Samples training, validation;
    MemberSettings settings_of_member;
};

bool same(const MemberState& a, const MemberState& b) {
    return a.epochs == b.epochs && a.lowest == b.lowest && a.adam.steps == b.adam.steps &&
           (a.parameters == b.parameters).all() && (a.best == b.best).all() &&
           (a.adam.mean == b.adam.mean).all() && (a.adam.square == b.adam.square).all();
}

}  // namespace

TEST_CASE("a member that goes on from any epoch ends as if it never stopped",
          "[checkpoints]") {
    const SmallTraining small;
    const auto [states, whole] = small.watched();
    REQUIRE(states.size() == 12);
    for (const MemberState& state : states) {
        MemberWatch watch;
        watch.found = state;
        const auto [later, member] = small.watched(watch);
        CHECK(later.size() == 12U - static_cast<std::size_t>(state.epochs));
        CHECK(member.validation_rms == whole.validation_rms);
        for (std::size_t i = 0; i < whole.layers.size(); ++i) {
            CHECK(member.layers[i].weights == whole.layers[i].weights);
            CHECK(member.layers[i].bias == whole.layers[i].bias);
        }
    }
}

TEST_CASE("a checkpoint is read as it was kept, and none that is stale or damaged",
          "[checkpoints]") {
    const SmallTraining small;
    const MemberState state = small.watched().first[4];
    const Checkpoints checkpoints(small.folder / "out.json.checkpoint", "key");
    CHECK_FALSE(checkpoints.found(3));
    checkpoints.keep(3, state);
    REQUIRE(checkpoints.found(3));
    CHECK(same(*checkpoints.found(3), state));
    CHECK_FALSE(checkpoints.found(2));
    CHECK_FALSE(Checkpoints(small.folder / "out.json.checkpoint", "other").found(3));

    const auto file = small.folder / "out.json.checkpoint.3";
    const std::string whole = read_text(file);
    for (const std::size_t size : {whole.size() - 1, whole.size() / 2, std::size_t{0}}) {
        write_text_atomically(file, whole.substr(0, size));
        CHECK_FALSE(checkpoints.found(3));
    }
    const double value = state.parameters[5];
    const std::string bytes(reinterpret_cast<const char*>(&value), sizeof value);
    const std::size_t place = whole.find(bytes);
    REQUIRE(place != std::string::npos);
    std::string flipped = whole;
    flipped[place + 6] = static_cast<char>(flipped[place + 6] ^ 1);
    write_text_atomically(file, flipped);
    CHECK_FALSE(checkpoints.found(3));
    checkpoints.remove(4);
    CHECK_FALSE(std::filesystem::exists(file));
}

TEST_CASE("an emulator that goes on from checkpoints is the same, bit by bit",
          "[checkpoints]") {
    const SmallTraining small;
    const auto bytes = [&](const Checkpoints& checkpoints) {
        return to_json(train_emulator(small.config, small.data, 2, checkpoints)).dump();
    };
    const std::string whole = bytes({});
    const Checkpoints checkpoints(small.folder / "emulator.json.checkpoint", "key", 0);
    CHECK(bytes(checkpoints) == whole);
    REQUIRE(checkpoints.found(0));
    CHECK(checkpoints.found(0)->epochs == 12);
    std::filesystem::remove(small.folder / "emulator.json.checkpoint.1");
    CHECK(bytes(checkpoints) == whole);  // one member is finished, one begins anew
}

TEST_CASE("a checkpoint that cannot be written stops no training", "[checkpoints]") {
    const SmallTraining small;
    const Checkpoints nowhere(small.folder / "no folder" / "emulator.json", "key", 0);
    const Model model = train_emulator(small.config, small.data, 2, nowhere);
    CHECK(to_json(model).dump() ==
          to_json(train_emulator(small.config, small.data, 2)).dump());
}
