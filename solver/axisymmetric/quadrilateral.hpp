#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace taylorcal::axisymmetric {

/// Integrals over the ring that a bilinear quadrilateral sweeps about the axis, exact:
/// what the mean velocity gradient and the nodal forces of one stress point need.
struct Ring {
    double volume;           ///< V = 2 pi int r dA [m3]
    double area;             ///< A [m2]
    double smallest_corner;  ///< smallest corner Jacobian x 4: not positive if folded
    std::array<double, 4> radial;  ///< int dN_a/dr dV [m2]
    std::array<double, 4> axial;   ///< int dN_a/dz dV [m2]
    std::array<double, 4> hoop;    ///< int N_a/r dV [m2]
};

inline Ring ring_of(const std::array<double, 4>& r, const std::array<double, 4>& z) {
    constexpr double third_of_pi = std::numbers::pi / 3;
    Ring ring;
    std::array<double, 4> rise, square;  // of the side from corner a to the next
    ring.volume = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t next = (a + 1) % 4;
        rise[a] = z[next] - z[a];
        square[a] = (r[a] * r[a] + r[a] * r[next] + r[next] * r[next]) * third_of_pi;
        ring.volume += square[a] * rise[a];
    }
    std::array<double, 4> volume_radial;  // dV/dr_a = int (dN_a/dr + N_a/r) dV
    for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t next = (a + 1) % 4;
        const std::size_t last = (a + 3) % 4;
        ring.axial[a] = square[last] - square[a];
        volume_radial[a] =
            ((2 * r[a] + r[next]) * rise[a] + (r[last] + 2 * r[a]) * rise[last]) *
            third_of_pi;
    }
    std::array<double, 4> corner;
    ring.area = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t next = (a + 1) % 4;
        const std::size_t last = (a + 3) % 4;
        corner[a] =
            (r[next] - r[a]) * (z[last] - z[a]) - (z[next] - z[a]) * (r[last] - r[a]);
        ring.area += corner[a] / 4;
    }
    ring.smallest_corner = corner[0];
    for (std::size_t a = 1; a < 4; ++a) {
        if (corner[a] < ring.smallest_corner) ring.smallest_corner = corner[a];
    }
    // The Jacobian is J0 + J1 xi + J2 eta with a quarter of `corner` at the corners, and
    // int N_a dA = J0 + (xi_a J1 + eta_a J2)/3.
    constexpr std::array<double, 4> xi = {-1, 1, 1, -1};
    constexpr std::array<double, 4> eta = {-1, -1, 1, 1};
    double j1 = 0;
    double j2 = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        j1 += xi[a] * corner[a] / 16;
        j2 += eta[a] * corner[a] / 16;
    }
    for (std::size_t a = 0; a < 4; ++a) {
        ring.hoop[a] = 6 * third_of_pi * (ring.area / 4 + (xi[a] * j1 + eta[a] * j2) / 3);
        ring.radial[a] = volume_radial[a] - ring.hoop[a];
    }
    return ring;
}

/// How narrow a cell is, for its stable step: its area over the longest side; on the
/// axis, whose nodes carry next to no mass, mostly its smallest corner's Jacobian instead
/// of the area, for cells that are crushed there to a taper go unstable otherwise [m].
inline double narrowest_width(const Ring& ring, const std::array<double, 4>& r,
                              const std::array<double, 4>& z) {
    double longest_square = 0;
    for (std::size_t a = 0; a < 4; ++a) {
        const std::size_t b = (a + 1) % 4;
        const double dr = r[b] - r[a];
        const double dz = z[b] - z[a];
        longest_square = std::max(longest_square, dr * dr + dz * dz);
    }
    constexpr double corner_share = 0.75;
    const bool on_axis = r[0] == 0 && r[3] == 0;
    const double area =
        on_axis ? std::lerp(ring.area, std::max(0.0, ring.smallest_corner), corner_share)
                : ring.area;
    return area / std::sqrt(longest_square);
}

}  // namespace taylorcal::axisymmetric
