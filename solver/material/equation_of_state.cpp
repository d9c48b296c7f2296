#include "solver/material/equation_of_state.hpp"

#include "solver/material/copper_equation_of_state.hpp"
#include "solver/material/linear_equation_of_state.hpp"

namespace taylorcal::material {

std::unique_ptr<EquationOfState> make_equation_of_state(const Parameters& parameters) {
    if (parameters.equation_of_state == EquationOfStateModel::linear)
        return std::make_unique<LinearEquationOfState>(parameters);
    return std::make_unique<CopperEquationOfState>(parameters);
}

}  // namespace taylorcal::material
