#include "solver/material/thermo_table.hpp"

#include "common/errors.hpp"
#include "emulator/inference/emulator.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>
#include <fmt/core.h>

namespace taylorcal::material {

namespace {

constexpr std::size_t intervals = 96;
// A step asks for its new density with its old energy before it knows the new one: a
// strong shock then looks colder than 0 K for a moment.
constexpr double coldest_shown = -500;  // [K]

/// The network, asked by its names of inputs and outputs.
class ThermoNetwork {
  public:
    explicit ThermoNetwork(const emulator::Emulator& network)
        : network_(network),
          density_(network.input_index("density_kg_m3")),
          energy_(network.input_index("energy_J_kg")),
          pressure_(network.output_index("pressure_Pa")),
          temperature_(network.output_index("temperature_K")),
          modulus_(network.output_index("bulk_modulus_Pa")) {
        require(network.inputs().size() == 2,
                "a network of an equation of state has the inputs density_kg_m3 and "
                "energy_J_kg and no others. Train it on these.");
    }
    const emulator::InputInfo& density() const {
        return network_.inputs()[static_cast<std::size_t>(density_)];
    }
    const emulator::InputInfo& energy() const {
        return network_.inputs()[static_cast<std::size_t>(energy_)];
    }
    std::vector<ThermoState> at(double density, const std::vector<double>& energies) {
        const auto n = static_cast<Eigen::Index>(energies.size());
        points_.resize(2, n);
        points_.row(density_).setConstant(static_cast<float>(density));
        for (Eigen::Index i = 0; i < n; ++i)
            points_(energy_, i) =
                static_cast<float>(energies[static_cast<std::size_t>(i)]);
        network_.evaluate(points_, 0, results_, workspace_);
        std::vector<ThermoState> states;
        for (Eigen::Index i = 0; i < n; ++i)
            states.push_back({static_cast<double>(results_(pressure_, i)),
                              static_cast<double>(results_(temperature_, i)),
                              static_cast<double>(results_(modulus_, i))});
        return states;
    }
    /// The energy of a temperature, by secants from a guess.
    double energy_at(double density, double temperature, double guess) {
        constexpr double step = 1e4;  // [J/kg], some 25 K: far above rounding
        constexpr int most = 30;
        for (int i = 0; i < most; ++i) {
            const auto two = at(density, {guess - step / 2, guess + step / 2});
            const double slope = (two[1].temperature - two[0].temperature) / step;
            const double middle = (two[0].temperature + two[1].temperature) / 2;
            const double change = (temperature - middle) / slope;
            guess += change;
            if (std::abs(change) < 1) return guess;
        }
        throw InputError(fmt::format(
            "the network of the equation of state has no energy for {} K at {} kg/m3. "
            "Train it anew.",
            temperature, density));
    }

  private:
    const emulator::Emulator& network_;
    int density_, energy_, pressure_, temperature_, modulus_;
    emulator::Block points_, results_;
    emulator::Workspace workspace_;
};

/// Energies of one temperature at all densities, walked from where the data lie to both
/// ends along isentropes, on which the guesses are good.
std::vector<double> isotherm(ThermoNetwork& network, const std::vector<double>& densities,
                             double temperature) {
    std::vector<double> energies(densities.size());
    const auto start = static_cast<std::ptrdiff_t>(
        std::ranges::lower_bound(densities, network.density().shift) - densities.begin());
    for (const std::ptrdiff_t direction : {1, -1}) {
        double guess = network.energy().shift;
        const auto end = static_cast<std::ptrdiff_t>(densities.size());
        for (std::ptrdiff_t i = start; i >= 0 && i < end; i += direction) {
            const double density = densities[static_cast<std::size_t>(i)];
            const double energy = network.energy_at(density, temperature, guess);
            energies[static_cast<std::size_t>(i)] = energy;
            const double squeeze = network.at(density, {energy})[0].pressure /
                                   (density * density) * (densities[1] - densities[0]);
            guess = energy + static_cast<double>(direction) * squeeze;
        }
    }
    return energies;
}

/// Shares of the energy at which the network is asked, dense at the ends, and the matrix
/// that turns answers there into coefficients of powers.
template <int terms>
struct Shares {
    Eigen::Vector<double, terms> place;
    Eigen::Matrix<double, terms, terms> to_powers;

    Shares() {
        Eigen::Matrix<double, terms, terms> powers;
        for (int i = 0; i < terms; ++i) {
            place[i] = (1 - std::cos(std::numbers::pi * i / (terms - 1))) / 2;
            for (int k = 0; k < terms; ++k) powers(i, k) = std::pow(place[i], k);
        }
        to_powers = powers.inverse();
    }
};

/// d(value)/d(node) of a row of nodes: differences of fourth order, of second at the
/// ends.
template <class Row>
Row node_slope(const std::vector<Row>& nodes, std::size_t i) {
    Row result{};
    const std::size_t last = nodes.size() - 1;
    for (std::size_t k = 0; k < result.size(); ++k) {
        const auto at = [&](std::size_t node) { return nodes[node][k]; };
        if (i == 0)
            result[k] = -1.5 * at(0) + 2 * at(1) - 0.5 * at(2);
        else if (i == last)
            result[k] = 1.5 * at(last) - 2 * at(last - 1) + 0.5 * at(last - 2);
        else if (i == 1 || i == last - 1)
            result[k] = (at(i + 1) - at(i - 1)) / 2;
        else
            result[k] = (8 * (at(i + 1) - at(i - 1)) - at(i + 2) + at(i - 2)) / 12;
    }
    return result;
}

double polynomial(const double* coefficient, std::size_t terms, double x) {
    double sum = coefficient[terms - 1];
    for (std::size_t k = terms - 1; k-- > 0;) sum = sum * x + coefficient[k];
    return sum;
}

double polynomial_slope(const double* coefficient, std::size_t terms, double x) {
    double sum = 0;
    for (std::size_t k = terms; k-- > 1;)
        sum = sum * x + static_cast<double>(k) * coefficient[k];
    return sum;
}

}  // namespace

ThermoTable::ThermoTable(const emulator::Emulator& network, double coldest,
                         double hottest)
    : coldest_(coldest), hottest_(hottest) {
    const std::vector<Lanes> nodes = nodes_of(network);
    const emulator::InputInfo& density = ThermoNetwork(network).density();
    lowest_ = density.lower;
    highest_ = density.upper;
    spacing_ = (highest_ - lowest_) / intervals;
    for (std::size_t i = 0; i < intervals; ++i) {
        const Lanes begin = node_slope(nodes, i), end = node_slope(nodes, i + 1);
        Piece piece;
        for (std::size_t k = 0; k < lanes; ++k) {
            const double rise = nodes[i + 1][k] - nodes[i][k];
            piece[0][k] = nodes[i][k];
            piece[1][k] = begin[k];
            piece[2][k] = 3 * rise - 2 * begin[k] - end[k];
            piece[3][k] = begin[k] + end[k] - 2 * rise;
        }
        pieces_.push_back(piece);
    }
}

std::vector<ThermoTable::Lanes> ThermoTable::nodes_of(
    const emulator::Emulator& emulator) const {
    ThermoNetwork network(emulator);
    std::vector<double> densities;
    const double span = network.density().upper - network.density().lower;
    for (std::size_t i = 0; i <= intervals; ++i)
        densities.push_back(network.density().lower +
                            span * static_cast<double>(i) / intervals);
    const std::vector<double> cold = isotherm(network, densities, coldest_);
    const std::vector<double> hot = isotherm(network, densities, hottest_);
    const Shares<static_cast<int>(terms)> shares;
    std::vector<Lanes> nodes(densities.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double width = hot[i] - cold[i];
        nodes[i][0] = cold[i];
        nodes[i][1] = 1 / width;
        std::vector<double> energies;
        for (const double share : shares.place)
            energies.push_back(cold[i] + share * width);
        const auto states = network.at(densities[i], energies);
        Eigen::Matrix<double, static_cast<int>(terms), 3> answers;
        for (std::size_t k = 0; k < terms; ++k)
            answers.row(static_cast<Eigen::Index>(k)) << states[k].pressure,
                states[k].temperature, states[k].bulk_modulus;
        answers = (shares.to_powers * answers).eval();
        std::copy_n(answers.data(), 3 * terms, nodes[i].begin() + pressure);
    }
    return nodes;
}

ThermoTable::Lanes ThermoTable::lanes_at(double density) const {
    if (!(density >= lowest_ && density <= highest_))
        throw NumericalError(
            fmt::format("a density of {:.6g} kg/m3 is beyond the equation of state's "
                        "{:.6g} to {:.6g}",
                        density, lowest_, highest_));
    const double place = (density - lowest_) / spacing_;
    const auto interval = std::min(static_cast<std::size_t>(place), intervals - 1);
    const double x = place - static_cast<double>(interval);
    const Piece& piece = pieces_[interval];
    Lanes lane;
    for (std::size_t k = 0; k < lanes; ++k)
        lane[k] = piece[0][k] + x * (piece[1][k] + x * (piece[2][k] + x * piece[3][k]));
    return lane;
}

ThermoState ThermoTable::inside(const Lanes& lane, double share) {
    return {polynomial(&lane[pressure], terms, share),
            polynomial(&lane[temperature], terms, share),
            polynomial(&lane[modulus], terms, share)};
}

ThermoState ThermoTable::outside(const Lanes& lane, double share, double density,
                                 double energy) const {
    const double edge = share < 0 ? 0 : 1;
    const auto extended = [&](std::size_t first) {
        return polynomial(&lane[first], terms, edge) +
               polynomial_slope(&lane[first], terms, edge) * (share - edge);
    };
    ThermoState state = {extended(pressure), extended(temperature), extended(modulus)};
    if (!(state.temperature >= coldest_shown && state.temperature <= 2 * hottest_))
        throw NumericalError(
            fmt::format("a density of {:.6g} kg/m3 with an energy of {:.6g} J/kg is at "
                        "{:.4g} K (the equation of state knows 0 to {:g} K)",
                        density, energy, state.temperature, 2 * hottest_));
    state.temperature = std::max(state.temperature, 0.0);
    return state;
}

ThermoState ThermoTable::at(double density, double energy) const {
    const Lanes lane = lanes_at(density);
    const double share = (energy - lane[0]) * lane[1];
    if (share >= 0 && share <= 1) return inside(lane, share);
    return outside(lane, share, density, energy);
}

double ThermoTable::energy_at(double density, double temperature_K) const {
    const Lanes lane = lanes_at(density);
    double share = (temperature_K - coldest_) / (hottest_ - coldest_);
    for (int i = 0; i < 50; ++i) {
        const double edge = std::clamp(share, 0.0, 1.0);
        const double slope_here = polynomial_slope(&lane[temperature], terms, edge);
        const double here =
            polynomial(&lane[temperature], terms, edge) + slope_here * (share - edge);
        const double change = (temperature_K - here) / slope_here;
        share += change;
        if (std::abs(change) < 1e-13) break;
    }
    return lane[0] + share / lane[1];
}

}  // namespace taylorcal::material
