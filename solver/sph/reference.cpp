#include "solver/sph/reference.hpp"

#include "solver/sph/kernel.hpp"

#include <cmath>
#include <map>

#include <Eigen/Dense>

namespace taylorcal::sph {

namespace {

// h in edges: the 26 nearest sites lie within 2h. Half as many neighbours as with the
// customary 0.9 give the same sizes at half the cost, because gradients are corrected.
constexpr double smoothing_in_edges = 0.72;

}  // namespace

Reference::Reference(const Packing& packing, double density, double hourglass_viscosity)
    : active_(packing.active),
      column_of_block_(packing.slots / block_size),
      volume_(packing.slots),
      specific_volume_(packing.slots),
      viscosity_(static_cast<float>(hourglass_viscosity)) {
    for (Field& field : place_) field = Field(packing.slots);
    for (Field& field : inverse_) field = Field(packing.slots);
    for (Field& field : first_moment_) field = Field(packing.slots);
    for (std::size_t slot = 0; slot < packing.slots; ++slot) {
        place_[0].lanes()[slot] = static_cast<float>(packing.x[slot]);
        place_[1].lanes()[slot] = static_cast<float>(packing.y[slot]);
        place_[2].lanes()[slot] = static_cast<float>(packing.z[slot]);
        volume_.lanes()[slot] = static_cast<float>(packing.volume[slot]);
        specific_volume_.lanes()[slot] =
            packing.volume[slot] > 0 ? static_cast<float>(1 / density) : 0.0f;
    }
    find_neighbours(packing);
    measure_moments(packing);
}

void Reference::find_neighbours(const Packing& packing) {
    const CubicSpline kernel(smoothing_in_edges * packing.edge);
    const double half = packing.edge / 2;
    const int reach = static_cast<int>(kernel.support() / half);
    std::map<std::pair<int, int>, std::size_t> column_at;
    for (std::size_t c = 0; c < packing.columns.size(); ++c) {
        column_at[{packing.columns[c].ix, packing.columns[c].iy}] = c;
        for (std::size_t b = 0; b < packing.blocks_per_column; ++b) {
            column_of_block_[packing.columns[c].first_slot / block_size + b] = c;
        }
    }
    for (const Column& column : packing.columns) {
        auto& list = neighbours_.emplace_back();
        for (int dx = -reach; dx <= reach; ++dx) {
            for (int dy = -reach; dy <= reach; ++dy) {
                const auto found = column_at.find({column.ix + dx, column.iy + dy});
                if (found == column_at.end()) continue;
                const Column& other = packing.columns[found->second];
                NeighbourColumn entry{};
                for (int layers = -reach; layers <= reach; ++layers) {
                    // Layer 2k + parity: slots differ by half the layers' difference.
                    const int twice = layers + column.parity() - other.parity();
                    if (twice % 2 != 0 || (dx == 0 && dy == 0 && layers == 0)) continue;
                    const double r = half * std::hypot(dx, dy, layers);
                    const double steepness = kernel.steepness(r);
                    if (steepness <= 0) continue;
                    if (entry.count == 0) {
                        entry.offset = static_cast<std::ptrdiff_t>(other.first_slot) -
                                       static_cast<std::ptrdiff_t>(column.first_slot) +
                                       twice / 2;
                    }
                    // The own site has no steepness but keeps the run contiguous.
                    if (dx == 0 && dy == 0 && layers == 2)
                        entry.steepness[entry.count++] = 0;
                    entry.steepness[entry.count++] = static_cast<float>(steepness);
                }
                if (entry.count > 0) list.push_back(entry);
            }
        }
    }
}

void Reference::measure_moments(const Packing& packing) {
    for (const std::size_t block : active_) {
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t slot = block * block_size + k;
            if (packing.volume[slot] <= 0) continue;
            Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
            Eigen::Vector3d first = Eigen::Vector3d::Zero();
            for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
                for (std::size_t e = 0; e < n.count; ++e) {
                    const std::size_t j = slot + static_cast<std::size_t>(n.offset) + e;
                    const double w =
                        packing.volume[j] * static_cast<double>(n.steepness[e]);
                    Eigen::Vector3d offset;
                    for (int c = 0; c < 3; ++c) {
                        const float* place = place_[static_cast<std::size_t>(c)].lanes();
                        offset(c) = static_cast<double>(place[j] - place[slot]);
                    }
                    moment += w * offset * offset.transpose();
                    first += w * offset;
                }
            }
            const Eigen::Matrix3d inverse = moment.inverse();
            constexpr int row[6] = {0, 1, 2, 0, 0, 1};
            constexpr int column[6] = {0, 1, 2, 1, 2, 2};
            for (std::size_t c = 0; c < 6; ++c) {
                inverse_[c].lanes()[slot] =
                    static_cast<float>(inverse(row[c], column[c]));
            }
            for (int c = 0; c < 3; ++c) {
                first_moment_[static_cast<std::size_t>(c)].lanes()[slot] =
                    static_cast<float>(first(c));
            }
        }
    }
}

void Reference::velocity_gradient(Particles& particles) const {
    simd::run([&](auto chosen) {
        velocity_gradient_in<Registers<float, chosen.value>>(particles);
    });
}

template <class Vector>
void Reference::velocity_gradient_in(Particles& particles) const {
    const auto load = [](const float* first) { return Vector::load(first); };
    const float* volume = volume_.lanes();
    const float* place[3];
    const float* speed[3];
    for (std::size_t c = 0; c < 3; ++c) {
        place[c] = place_[c].lanes();
        speed[c] = particles.speed[c].lanes();
    }
    for (const std::size_t block : active_) {
        const std::size_t slot = block * block_size;
        const Vector x0[3] = {place_[0][block], place_[1][block], place_[2][block]};
        const Vector v0[3] = {particles.speed[0][block], particles.speed[1][block],
                              particles.speed[2][block]};
        Vector sum[9] = {};
        Vector squares{};
        for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
            const std::size_t first = slot + static_cast<std::size_t>(n.offset);
            for (std::size_t e = 0; e < n.count; ++e) {
                const std::size_t j = first + e;
                const Vector w = n.steepness[e] * load(volume + j);
                const Vector x = load(place[0] + j) - x0[0];
                const Vector y = load(place[1] + j) - x0[1];
                const Vector z = load(place[2] + j) - x0[2];
                for (std::size_t r = 0; r < 3; ++r) {
                    const Vector v = load(speed[r] + j) - v0[r];
                    const Vector wv = w * v;
                    sum[3 * r] += wv * x;
                    sum[3 * r + 1] += wv * y;
                    sum[3 * r + 2] += wv * z;
                    squares += wv * v;
                }
            }
        }
        Vector rate[9];
        times_symmetric(sum, inverse_, block, rate);
        Vector explained{};
        for (std::size_t c = 0; c < 9; ++c) {
            explained += sum[c] * rate[c];
            particles.rate[c][block] = rate[c];
        }
        particles.hourglass_heating[block] =
            viscosity_ * lane_max(squares - explained, Vector{});
    }
}

void Reference::accelerate(Particles& particles) const {
    simd::run(
        [&](auto chosen) { accelerate_in<Registers<float, chosen.value>>(particles); });
}

template <class Vector>
void Reference::accelerate_in(Particles& particles) const {
    const auto load = [](const float* first) { return Vector::load(first); };
    const float* volume = volume_.lanes();
    const float* place[3];
    const float* speed[3];
    const float* pull[9];
    for (std::size_t c = 0; c < 3; ++c) {
        place[c] = place_[c].lanes();
        speed[c] = particles.speed[c].lanes();
    }
    for (std::size_t c = 0; c < 9; ++c) pull[c] = particles.pull[c].lanes();
    for (const std::size_t block : active_) {
        const std::size_t slot = block * block_size;
        const Vector x0[3] = {place_[0][block], place_[1][block], place_[2][block]};
        const Vector v0[3] = {particles.speed[0][block], particles.speed[1][block],
                              particles.speed[2][block]};
        Vector force[3];         // Q_i sum_j w X_ij + sum_j w Q_j X_ij
        Vector damping[3] = {};  // sum_j w v_ij
        for (std::size_t r = 0; r < 3; ++r) {
            force[r] = particles.pull[3 * r][block] * first_moment_[0][block] +
                       particles.pull[3 * r + 1][block] * first_moment_[1][block] +
                       particles.pull[3 * r + 2][block] * first_moment_[2][block];
        }
        for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
            const std::size_t first = slot + static_cast<std::size_t>(n.offset);
            for (std::size_t e = 0; e < n.count; ++e) {
                const std::size_t j = first + e;
                const Vector w = n.steepness[e] * load(volume + j);
                const Vector wx = w * (load(place[0] + j) - x0[0]);
                const Vector wy = w * (load(place[1] + j) - x0[1]);
                const Vector wz = w * (load(place[2] + j) - x0[2]);
                for (std::size_t r = 0; r < 3; ++r) {
                    force[r] += load(pull[3 * r] + j) * wx +
                                load(pull[3 * r + 1] + j) * wy +
                                load(pull[3 * r + 2] + j) * wz;
                    damping[r] += w * (load(speed[r] + j) - v0[r]);
                }
            }
        }
        for (std::size_t r = 0; r < 3; ++r) {
            particles.acceleration[r][block] =
                specific_volume_[block] * (force[r] + 2 * viscosity_ * damping[r]);
        }
    }
}

}  // namespace taylorcal::sph
