#include "solver/material/equation_of_state.hpp"

#include "solver/material/copper_equation_of_state.hpp"
#include "solver/material/linear_equation_of_state.hpp"
#include "solver/material/network_equation_of_state.hpp"

namespace taylorcal::material {

std::unique_ptr<EquationOfState> make_equation_of_state(const Parameters& parameters) {
    switch (parameters.equation_of_state) {
        case EquationOfStateModel::linear:
            return std::make_unique<LinearEquationOfState>(parameters);
        case EquationOfStateModel::copper_md:
            return std::make_unique<NetworkEquationOfState>(copper_md_table(),
                                                            parameters);
        case EquationOfStateModel::copper:
            break;
    }
    return std::make_unique<CopperEquationOfState>(parameters);
}

}  // namespace taylorcal::material
