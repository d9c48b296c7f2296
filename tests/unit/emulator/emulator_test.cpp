#include "emulator/inference/emulator.hpp"

#include "../common/temporary_folder.hpp"
#include "common/atomic_file.hpp"
#include "common/errors.hpp"
#include "emulator/inference/predict_table.hpp"
#include "naive_evaluation.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace taylorcal;
using namespace taylorcal::emulator;
using Catch::Matchers::Contains;

namespace {

/// Two members with weights of no meaning; "fixed" is constant.
Model sample_model() {
    Model model;
    model.inputs = {{"speed", Transform::linear, 50, 250, 150, 60, true},
                    {"density", Transform::log10, 1e10, 1e15, 12.5, 1.5, true},
                    {"fixed", Transform::linear, 294, 294, 0, 1, false},
                    {"size", Transform::square_root, 5, 10, 2.7, 0.3, true}};
    model.category = {"kind", {"curved", "plain"}};
    model.outputs = {{"length", 0.8, 0.1, {"size", "fixed"}}, {"ratio", 1.2, 0.2, {}}};
    std::srand(3);
    for (const std::uint64_t seed : {1U, 2U}) {
        Member member{{}, seed, 32, 0.01, 0.02};
        const std::vector<Eigen::Index> widths = {5, 13, 13, 13, 2};
        for (std::size_t i = 0; i + 1 < widths.size(); ++i) {
            member.layers.push_back({Eigen::MatrixXf::Random(widths[i + 1], widths[i]),
                                     Eigen::VectorXf::Random(widths[i + 1])});
        }
        model.members.push_back(member);
    }
    model.best = 1;
    model.validation = {{"rows", 10}};
    model.provenance = {{"program", "test"}};
    model.covariances = {
        {"curved", {{"length", "ratio"}, Eigen::MatrixXd::Identity(2, 2)}},
        {"plain", {{"length"}, Eigen::MatrixXd::Constant(1, 1, 4e-6)}}};
    return model;
}

Block sample_points(Eigen::Index n) {
    Block points(4, n);
    points.row(0) = 150 + 90 * Eigen::ArrayXf::Random(n).transpose();
    points.row(1) = (29 + 5 * Eigen::ArrayXf::Random(n).transpose()).exp();
    points.row(2).setConstant(294);
    points.row(3) = 7.5F + 2 * Eigen::ArrayXf::Random(n).transpose();
    return points;
}

}  // namespace

TEST_CASE("inference equals the file's recipe", "[emulator]") {
    const nlohmann::json file = to_json(sample_model());
    const Emulator emulator(model_from_json(file, "emulator.json"));
    // Fewer than a block, exactly one, and one with a rest.
    const Eigen::Index n = GENERATE(1, 128, 300);
    const Block points = sample_points(n);
    Workspace workspace;
    Block results;
    for (std::size_t member = 0; member < 2; ++member) {
        for (const std::string category : {"curved", "plain"}) {
            emulator.evaluate_member(member, points, emulator.category_index(category),
                                     results, workspace);
            REQUIRE(results.cols() == n);
            for (const Eigen::Index j : {Eigen::Index{0}, n / 2, n - 1}) {
                const auto expected = testing::follow_recipe(file, member,
                                                             {{"speed", points(0, j)},
                                                              {"density", points(1, j)},
                                                              {"fixed", 294},
                                                              {"size", points(3, j)}},
                                                             category);
                CHECK(results(0, j) == Approx(expected[0]).epsilon(2e-5));
                CHECK(results(1, j) == Approx(expected[1]).epsilon(2e-5));
            }
        }
    }
    Block best, other, asked;
    emulator.evaluate(points, 1, best, workspace);
    CHECK((best == results).all());
    // Another member may answer in its place.
    emulator.evaluate_member(0, points, 1, other, workspace);
    emulator.answering_with(0).evaluate(points, 1, asked, workspace);
    CHECK((asked == other).all());
    CHECK((asked != best).any());
}

TEST_CASE("a model keeps every bit in its file", "[emulator]") {
    const Model model = sample_model();
    const Model again =
        model_from_json(nlohmann::json::parse(to_json(model).dump()), "emulator.json");
    CHECK(to_json(again) == to_json(model));
    for (std::size_t layer = 0; layer < 4; ++layer) {
        CHECK(again.members[0].layers[layer].weights ==
              model.members[0].layers[layer].weights);
        CHECK(again.members[0].layers[layer].bias == model.members[0].layers[layer].bias);
    }
}

TEST_CASE("held-out errors keep their gaps in the file", "[emulator]") {
    Model model = sample_model();
    model.held_out.categories = {"plain", "curved"};
    model.held_out.places = Eigen::MatrixXd::Random(2, 3);
    model.held_out.errors = Eigen::MatrixXd::Constant(2, 2, 0.25);
    model.held_out.errors(0, 1) = std::nan("");
    const Model again =
        model_from_json(nlohmann::json::parse(to_json(model).dump()), "emulator.json");
    CHECK(again.held_out.categories == model.held_out.categories);
    CHECK(again.held_out.places == model.held_out.places);
    CHECK(again.held_out.errors(1, 1) == 0.25);
    CHECK(std::isnan(again.held_out.errors(0, 1)));
    nlohmann::json short_of_one = to_json(model);
    short_of_one["validation"]["held_out"]["errors"].erase(0);
    CHECK_THROWS_WITH(model_from_json(short_of_one, "emulator.json"),
                      Contains("errors") && Contains("Train again"));
}

TEST_CASE("a point beyond the range is refused with name, value, range and remedy",
          "[emulator]") {
    const Emulator emulator(sample_model());
    CHECK_NOTHROW(emulator.check_range("speed", 50, "here"));
    CHECK_NOTHROW(emulator.check_range("speed", 251.9, "here"));
    CHECK_NOTHROW(emulator.check_range("fixed", 294, "here"));
    CHECK_THROWS_WITH(emulator.check_range("speed", 394, "measurements.csv, line 7"),
                      Contains("measurements.csv, line 7: speed = 394") &&
                          Contains("range 50 to 250") && Contains("add runs there"));
    CHECK_THROWS_AS(emulator.check_range("density", 1e9, ""), InputError);
    CHECK_THROWS_AS(emulator.check_range("density", -1, ""), InputError);
    CHECK_THROWS_AS(emulator.check_range("fixed", 300, ""), InputError);
    CHECK_THROWS_AS(emulator.check_range("speed", std::nan(""), ""), InputError);
    CHECK_THROWS_WITH(emulator.category_index("curve"), Contains("\"curved\" meant?"));
    CHECK_THROWS_WITH(emulator.input_index("sped"), Contains("\"speed\" meant?"));
}

TEST_CASE("points are predicted from assignments", "[emulator]") {
    const Emulator emulator(sample_model());
    const std::vector<std::string> whole = {"speed=100", "density=1e12", "size=6"};
    const std::string table =
        predict_table(emulator, {point_of(emulator, whole, "curved")});
    const auto expected = testing::follow_recipe(
        to_json(sample_model()), 1,
        {{"speed", 100}, {"density", 1e12}, {"fixed", 294}, {"size", 6}}, "curved");
    CHECK_THAT(table,
               Contains("kind,length,length_member_sd,ratio,ratio_member_sd\ncurved,"));
    CHECK(std::stod(table.substr(table.find("curved,") + 7)) ==
          Approx(expected[0]).epsilon(2e-5));
    // "plain" has no ratio: its two cells stay empty.
    CHECK_THAT(predict_table(emulator, {point_of(emulator, whole, "plain")}),
               Contains(",,\n"));

    const auto refused = [&](const std::vector<std::string>& set) {
        predict_table(emulator, {point_of(emulator, set, "curved")});
    };
    CHECK_THROWS_WITH(refused({"speed=400", "density=1e12", "size=6"}),
                      Contains("speed = 400"));
    CHECK_THROWS_WITH(refused({"speed=100", "density=1e12"}),
                      Contains("\"size\" is missing"));
    CHECK_THROWS_WITH(refused({"speed"}), Contains("expected name=number"));
    CHECK_THROWS_WITH(refused({"speed=100", "speed=120"}),
                      Contains("--set speed=120: speed is given twice"));
    CHECK_THROWS_WITH(refused({"speed=fast"}), Contains("expected name=number"));
}

TEST_CASE("a network of one shape keeps its name", "[emulator]") {
    Model model = sample_model();
    model.category = {};
    for (Member& member : model.members) {
        Eigen::MatrixXf& weights = member.layers.front().weights;
        weights = Eigen::MatrixXf(weights.leftCols(3));
    }
    const std::vector<std::string> whole = {"speed=100", "density=1e12", "size=6"};
    const auto ask = [&](const std::string& shape) {
        const Emulator emulator(model_from_json(to_json(model), "emulator.json"));
        return predict_table(emulator, {point_of(emulator, whole, shape)});
    };
    CHECK_FALSE(to_json(model).contains("only_shape"));
    const std::string answer = ask("");
    CHECK(ask("truncated_cone") == answer);  // files of before do not tell their shape
    model.only_shape = "uniform_cylinder";
    CHECK(ask("") == answer);
    CHECK(ask("uniform_cylinder") == answer);
    CHECK_THROWS_WITH(ask("truncated_cone"), Contains("--set: ") &&
                                                 Contains("uniform_cylinder only") &&
                                                 Contains("\"truncated_cone\""));
}

TEST_CASE("points of a table are refused by line and column", "[emulator]") {
    const Emulator emulator(sample_model());
    const testing::TemporaryFolder folder;
    const auto predict = [&](const std::string& text) {
        write_text_atomically(folder / "points.csv", text);
        const CsvTable table = CsvTable::from_file(folder / "points.csv");
        return predict_table(emulator, points_of(emulator, table));
    };
    CHECK_NOTHROW(predict("kind,speed,density,size\nplain,100,1e12,6\n"));
    CHECK_THROWS_WITH(predict("kind,speed,density,siz,size\nplain,100,1e12,6,6\n"),
                      Contains("points.csv, line 1: unknown column \"siz\"") &&
                          Contains("\"size\" meant?"));
    CHECK_THROWS_WITH(predict("kind,speed,density,size\n\nplain,400,1e12,6\n"),
                      Contains("points.csv, line 3: speed = 400"));
    CHECK_THROWS_WITH(predict("kind,speed,density,size\ncone,100,1e12,6\n"),
                      Contains("points.csv, line 2: the emulator has no kind \"cone\""));
}

TEST_CASE("a damaged emulator file is refused", "[emulator]") {
    const testing::TemporaryFolder folder;
    const auto load = [&](const nlohmann::json& file) {
        write_text_atomically(folder / "emulator.json", file.dump());
        Emulator::from_file(folder / "emulator.json");
    };
    const nlohmann::json good = to_json(sample_model());
    CHECK_NOTHROW(load(good));
    const auto changed = [&](const std::string& pointer, const nlohmann::json& value) {
        nlohmann::json file = good;
        file[nlohmann::json::json_pointer(pointer)] = value;
        return file;
    };
    CHECK_THROWS_WITH(load(changed("/schema", "taylorcal/emulator/2")),
                      Contains("emulator.json: schema"));
    CHECK_THROWS_WITH(load(changed("/best", 2)), Contains("best"));
    CHECK_THROWS_WITH(load(changed("/members/0/layers/1/bias", {1, 2})),
                      Contains("does not fit"));
    CHECK_THROWS_WITH(load(changed("/members/0/layers/1/weights", "many")),
                      Contains("members[0].layers[1].weights"));
    CHECK_THROWS_WITH(load(changed("/category/values", {"curved"})),
                      Contains("do not fit together"));
    for (const char* scale : {"/inputs/0/scale", "/outputs/1/scale"})
        CHECK_THROWS_WITH(load(changed(scale, 0)),
                          Contains("scale = 0 (expected more than 0)"));
    const std::string covariance = "/validation/covariance/curved";
    CHECK_THROWS_WITH(load(changed(covariance + "/matrix", {{1.0}})),
                      Contains("curved.matrix is 1 x 1 (expected 2 x 2"));
    CHECK_THROWS_WITH(load(changed(covariance + "/outputs", {"length", "width"})),
                      Contains("curved.outputs names \"width\""));
    CHECK_THROWS_WITH(load(changed("/validation/covariance", nlohmann::json::object())),
                      Contains("covariance is empty"));
    nlohmann::json headless = good;
    headless.erase("inputs");
    CHECK_THROWS_WITH(load(headless), Contains("inputs is missing"));
}
