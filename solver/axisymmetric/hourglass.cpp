#include "solver/axisymmetric/hourglass.hpp"

#include <cmath>
#include <utility>

namespace taylorcal::axisymmetric {
namespace {

constexpr double viscous_coefficient = 0.05;
// Mean of xi^2 over a cell: the mode's strain varies as xi or eta between the sides.
constexpr double mean_square = 1.0 / 3;

}  // namespace

HourglassModes hourglass_modes(const Ring& ring, const std::array<double, 4>& r,
                               const std::array<double, 4>& z) {
    constexpr std::array<double, 4> mode = {1, -1, 1, -1};
    const double twice_area = 2 * ring.area;
    const std::array<double, 4> slope_r = {
        (z[1] - z[3]) / twice_area, (z[2] - z[0]) / twice_area,
        (z[3] - z[1]) / twice_area, (z[0] - z[2]) / twice_area};
    const std::array<double, 4> slope_z = {
        (r[3] - r[1]) / twice_area, (r[0] - r[2]) / twice_area,
        (r[1] - r[3]) / twice_area, (r[2] - r[0]) / twice_area};
    double mode_r = 0, mode_z = 0, slopes = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        mode_r += mode[a] * r[a];
        mode_z += mode[a] * z[a];
        slopes += slope_r[a] * slope_r[a] + slope_z[a] * slope_z[a];
    }
    HourglassModes modes{};
    modes.steepness = std::sqrt(slopes / 2);
    for (std::size_t a = 0; a < 4; ++a)
        modes.gamma[a] = mode[a] - mode_r * slope_r[a] - mode_z * slope_z[a];
    return modes;
}

void resist_hourglass(Body& body, std::size_t cell,
                      const std::array<double, 4>& radial_velocity,
                      const std::array<double, 4>& axial_velocity) {
    const Ring& ring = body.ring[cell];
    const HourglassModes modes =
        hourglass_modes(ring, body.last_radius[cell], body.last_height[cell]);
    body.hourglass_gamma[cell] = modes.gamma;
    std::array<double, 2> speed{};
    for (std::size_t a = 0; a < 4; ++a) {
        speed[0] += modes.gamma[a] * radial_velocity[a];
        speed[1] += modes.gamma[a] * axial_velocity[a];
    }
    const double dt = body.cell_step[cell];
    const double shear = material::shear_modulus(body.thermo[cell].bulk_modulus,
                                                 body.parameters.poisson_ratio);
    const double impedance = body.cell_mass[cell] / ring.volume * sound_speed(body, cell);
    const double von_mises = von_mises_stress(body.deviator[cell]);
    const double relaxation =
        von_mises > 0 ? 3 * shear * body.plastic_rate[cell] / von_mises * dt : 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        const double rate = speed[i] / 2 * modes.steepness;
        double& stress = body.hourglass_stress[cell][i];
        stress = (stress + 2 * shear * rate * dt) / (1 + relaxation);
        const double total =
            body.numerics.hourglass * stress + viscous_coefficient * impedance * speed[i];
        const double force = mean_square * total * ring.volume * modes.steepness / 2;
        const double old_force = std::exchange(body.hourglass_force[cell][i], force);
        body.balance.hourglass += (old_force + force) / 2 * speed[i] * dt;
    }
}

}  // namespace taylorcal::axisymmetric
