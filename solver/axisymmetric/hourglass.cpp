#include "solver/axisymmetric/hourglass.hpp"

#include <cmath>

namespace taylorcal::axisymmetric {
namespace {

constexpr double viscous_coefficient = 0.05;
// Mean of xi^2 over a cell: the mode's strain varies as xi or eta between the sides.
constexpr double mean_square = 1.0 / 3;

}  // namespace

HourglassForce hourglass_force(Body& body, std::size_t cell, const Ring& ring,
                               const std::array<double, 4>& r,
                               const std::array<double, 4>& z,
                               const std::array<double, 4>& radial_velocity,
                               const std::array<double, 4>& axial_velocity,
                               double impedance, double shear) {
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
    const double steepness = std::sqrt(slopes / 2);  // 1/side of a square cell
    std::array<double, 4> gamma{};
    std::array<double, 2> speed{};
    for (std::size_t a = 0; a < 4; ++a) {
        gamma[a] = mode[a] - mode_r * slope_r[a] - mode_z * slope_z[a];
        speed[0] += gamma[a] * radial_velocity[a];
        speed[1] += gamma[a] * axial_velocity[a];
    }
    const auto& s = body.deviator[cell];
    const double von_mises =
        std::sqrt(1.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * s[3] * s[3]));
    const double dt = body.time_step;
    const double relaxation =
        von_mises > 0 ? 3 * shear * body.plastic_rate[cell] / von_mises * dt : 0.0;
    const double scale = body.numerics.hourglass;
    std::array<double, 2> force{};
    HourglassForce result{};
    for (std::size_t i = 0; i < 2; ++i) {
        const double rate = speed[i] / 2 * steepness;
        double& stress = body.hourglass_stress[cell][i];
        stress = (stress + 2 * shear * rate * dt) / (1 + relaxation);
        const double total = scale * stress + viscous_coefficient * impedance * speed[i];
        force[i] = mean_square * total * ring.volume * steepness / 2;
        result.power += force[i] * speed[i];
    }
    for (std::size_t a = 0; a < 4; ++a) {
        result.radial[a] = force[0] * gamma[a];
        result.axial[a] = force[1] * gamma[a];
    }
    return result;
}

}  // namespace taylorcal::axisymmetric
