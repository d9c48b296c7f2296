#include "emulator/training/quality.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal;
using namespace taylorcal::emulator;

TEST_CASE("errors are counted by output and category value", "[quality]") {
    Model model;
    model.inputs = {{"size", Transform::linear, 1, 20, 0, 1, true}};
    model.category = {"kind", {"curved", "plain"}};
    model.outputs = {{"length", 0, 1, {"size"}}};
    model.members.push_back(
        {{{Eigen::MatrixXf::Zero(1, 3), Eigen::VectorXf::Zero(1)}}, 1, 1, 1, 1});
    const Emulator emulator(model);
    Dataset data;
    data.inputs = (RowMatrix(4, 1) << 10, 10, 20, 10).finished();
    data.outputs = (RowMatrix(4, 1) << 5, 15, 30, std::nan("")).finished();
    data.categories = {"plain", "plain", "curved", "plain"};
    data.row_ids = {0, 1, 2, 3};
    const RowMatrix predicted = (RowMatrix(4, 1) << 5.3, 14.6, 31, 9).finished();
    const auto errors = errors_by_output(emulator, data, {0, 1, 2, 3}, predicted);
    REQUIRE(errors.size() == 2);
    CHECK(errors[0].category == "curved");
    CHECK(errors[0].rms == Approx(1));
    // Divided by the size: error 0.05 of a mean magnitude 1.5.
    CHECK(errors[0].rms_relative == Approx(0.05 / 1.5));
    CHECK(errors[1].n == 2);
    CHECK(errors[1].rms == Approx(std::sqrt((0.09 + 0.16) / 2)));
    CHECK(errors[1].largest == Approx(0.4));
    // Errors 0.03 and 0.04 of a mean magnitude (0.5 + 1.5) / 2.
    CHECK(errors[1].rms_relative == Approx(std::sqrt((0.0009 + 0.0016) / 2)));
    const OutputError whole = overall(errors);
    CHECK(whole.n == 3);
    CHECK(whole.largest_relative == Approx(0.04));
    CHECK(whole.rms_relative == Approx(std::sqrt((0.0025 / 2.25 + 0.0009 + 0.0016) / 3)));
}
