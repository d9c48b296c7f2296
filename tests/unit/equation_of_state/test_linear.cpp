#include "solver/material/equation_of_state.hpp"

#include <catch2/catch.hpp>

using namespace taylorcal::material;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {
std::unique_ptr<EquationOfState> linear() {
    Parameters parameters;
    parameters.equation_of_state = EquationOfStateModel::linear;
    return make_equation_of_state(parameters);
}
}  // namespace

TEST_CASE("the linear equation of state is the formula it is named for", "[eos]") {
    const ThermoState state = linear()->at(1.01 * 8930, 38500);
    CHECK_THAT(state.pressure, WithinRel(138e9 * 0.01 + 2 * 8930 * 38500.0, 1e-12));
    CHECK_THAT(state.temperature, WithinRel(400.0, 1e-12));
    CHECK_THAT(state.bulk_modulus, WithinRel(138e9, 1e-15));
}

TEST_CASE("the linear equation of state is free of pressure where it says", "[eos]") {
    const auto eos = linear();
    const ThermoState state =
        eos->at(eos->density_at_temperature(600), eos->energy_at_temperature(600));
    CHECK_THAT(state.pressure, WithinAbs(0, 1));
    CHECK_THAT(state.temperature, WithinRel(600.0, 1e-12));
}

TEST_CASE("the shear modulus of copper follows from Poisson's ratio", "[eos]") {
    // mu = 1/3 gives G = 3/8 K.
    CHECK_THAT(shear_modulus(8.0, 1.0 / 3), WithinRel(3.0, 1e-12));
}
