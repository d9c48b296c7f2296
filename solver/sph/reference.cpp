#include "solver/sph/reference.hpp"

#include "solver/sph/kernel.hpp"

#include <cmath>
#include <map>
#include <set>

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
      zeroth_moment_(packing.slots),
      viscosity_(packing.slots) {
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
        const double share = packing.local_edge[slot] / packing.edge;
        viscosity_.lanes()[slot] =
            static_cast<float>(hourglass_viscosity * std::pow(share, 1 - 5));
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
            column_of_block_[packing.columns[c].first_block + b] = c;
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

double Reference::mean_neighbours() const {
    std::size_t particles = 0;
    std::size_t pairs = 0;
    for (const std::size_t block : active_) {
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t slot = block * block_size + k;
            if (volume_.lanes()[slot] <= 0) continue;
            ++particles;
            for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
                for (std::size_t e = 0; e < n.count; ++e) {
                    const std::size_t j = slot + static_cast<std::size_t>(n.offset) + e;
                    if (n.steepness[e] > 0 && volume_.lanes()[j] > 0) ++pairs;
                }
            }
        }
    }
    return static_cast<double>(pairs) / static_cast<double>(particles);
}

void Reference::measure_moments(const Packing& packing) {
    for (const std::size_t block : active_) {
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t slot = block * block_size + k;
            if (packing.volume[slot] <= 0) continue;
            Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
            Eigen::Vector3d first = Eigen::Vector3d::Zero();
            double zeroth = 0;
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
                    zeroth += w;
                }
            }
            const Eigen::Matrix3d inverse = moment.inverse();
            constexpr int row[6] = {0, 1, 2, 0, 0, 1};
            constexpr int column[6] = {0, 1, 2, 1, 2, 2};
            for (std::size_t c = 0; c < 6; ++c) {
                inverse_[c].lanes()[slot] =
                    static_cast<float>(inverse(row[c], column[c]));
            }
            zeroth_moment_.lanes()[slot] = static_cast<float>(zeroth);
            for (int c = 0; c < 3; ++c) {
                first_moment_[static_cast<std::size_t>(c)].lanes()[slot] =
                    static_cast<float>(first(c));
            }
        }
    }
}

void Reference::velocity_gradient(Particles& particles, std::size_t block,
                                  const std::array<Field, 3>& velocity) const {
    simd::run([&](auto chosen) {
        velocity_gradient_in<Registers<float, chosen.value>>(particles, block, velocity);
    });
}

template <class Vector>
void Reference::velocity_gradient_in(Particles& particles, std::size_t block,
                                     const std::array<Field, 3>& velocity) const {
    const auto load = [](const float* first) { return Vector::load(first); };
    const float* volume = volume_.lanes();
    const float* place[3];
    const float* speed[3];
    for (std::size_t c = 0; c < 3; ++c) {
        place[c] = place_[c].lanes();
        speed[c] = velocity[c].lanes();
    }
    const std::size_t slot = block * block_size;
    const Vector x0[3] = {place_[0][block], place_[1][block], place_[2][block]};
    const Vector v0[3] = {velocity[0][block], velocity[1][block], velocity[2][block]};
    Vector sum[9] = {};
    Vector plain[3] = {};  // sum_j w v_ij
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
                plain[r] += wv;
                sum[3 * r] += wv * x;
                sum[3 * r + 1] += wv * y;
                sum[3 * r + 2] += wv * z;
                squares += wv * v;
            }
        }
    }
    Vector rate[9];
    times_symmetric(sum, inverse_, block, rate);
    for (std::size_t r = 0; r < 3; ++r) {
        particles.misfit_rate[r][block] =
            plain[r] - (rate[3 * r] * first_moment_[0][block] +
                        rate[3 * r + 1] * first_moment_[1][block] +
                        rate[3 * r + 2] * first_moment_[2][block]);
    }
    Vector explained{};
    for (std::size_t c = 0; c < 9; ++c) {
        explained += sum[c] * rate[c];
        particles.rate[c][block] = rate[c];
    }
    particles.hourglass_heating[block] =
        viscosity_[block] * lane_max(squares - explained, Vector{});
}

namespace {

/// All of the stencil is in step.
template <class Vector>
struct Alike {
    float own_pull;
    const float* speed[3];
    Vector own[3];

    Alike(const Particles& particles, std::size_t block, float share) : own_pull(share) {
        for (std::size_t r = 0; r < 3; ++r) {
            speed[r] = particles.speed[r].lanes();
            own[r] = particles.speed[r][block];
        }
    }
    bool silent(std::size_t) const { return false; }
    float pull(std::size_t) const { return own_pull; }
    Vector damping(std::size_t r, std::size_t j, float pull, const Vector& own_viscosity,
                   const Vector& viscosity) const {
        return pull * (own_viscosity + viscosity) * (Vector::load(speed[r] + j) - own[r]);
    }
};

/// What arrives now of stresses that were renewed over several levels' steps.
template <class Vector>
struct Mixed {
    const float* impulses;
    const float* level;
    bool own_arrives;
    Vector own_pull;
    Vector per_period;
    float open;
    const float* own_step_speed[3];  // means over the block's last renewal
    Vector own_step_own[3];
    const float* renewed_speed[3];  // each slot's mean over its own last renewal
    std::size_t levels = 0;
    float number[Schedule::highest_level + 1];
    Vector own[Schedule::highest_level + 1][3];  // the block's means over these levels

    Mixed(const Particles& particles, std::size_t block, const Arrivals& arrivals)
        : impulses(arrivals.impulse.lanes()),
          level(arrivals.level.lanes()),
          per_period(1 / arrivals.period),
          open(arrivals.open) {
        const Vector impulse = arrivals.impulse[block];
        own_arrives = impulse[0] <= open;
        own_pull = own_arrives ? impulse * per_period : Vector{};
        const auto own_level = static_cast<std::size_t>(arrivals.level[block][0]);
        const auto& means = arrivals.stencil_means ? particles.mean_speed[own_level - 1]
                                                   : particles.speed;
        for (std::size_t r = 0; r < 3; ++r) {
            own_step_speed[r] = means[r].lanes();
            own_step_own[r] = means[r][block];
            renewed_speed[r] = particles.renewed_speed[r].lanes();
        }
        for (std::size_t l = 0; l <= Schedule::highest_level; ++l) {
            if ((arrivals.levels >> l & 1u) == 0) continue;
            const bool kept = (arrivals.block_means >> l & 1u) != 0;
            const auto& velocity = kept ? particles.mean_speed[l - 1] : particles.speed;
            number[levels] = static_cast<float>(l);
            for (std::size_t r = 0; r < 3; ++r) own[levels][r] = velocity[r][block];
            ++levels;
        }
    }
    /// Whether nothing passes now between the block and the sixteen slots from j on.
    bool silent(std::size_t j) const {
        return !own_arrives && impulses[j] > open && impulses[j + block_size - 1] > open;
    }
    Vector pull(std::size_t j) const {
        const Vector impulse = Vector::load(impulses + j);
        return lane_select(impulse > open, Vector{}, impulse * per_period);
    }
    Vector damping(std::size_t r, std::size_t j, const Vector& pull,
                   const Vector& own_viscosity, const Vector& viscosity) const {
        const Vector of = Vector::load(level + j);
        Vector seen = own[0][r];
        for (std::size_t l = 1; l < levels; ++l) {
            // Levels are listed from the finest.
            seen = lane_select(of < number[l], seen, own[l][r]);
        }
        return own_pull * own_viscosity *
                   (Vector::load(own_step_speed[r] + j) - own_step_own[r]) +
               pull * viscosity * (Vector::load(renewed_speed[r] + j) - seen);
    }
};

}  // namespace

template <class Vector, class Steps>
void Reference::accelerate_in(const Steps& steps, Particles& particles,
                              std::size_t block) const {
    const auto load = [](const float* first) { return Vector::load(first); };
    const float* volume = volume_.lanes();
    const float* place[3];
    const float* pull[9];
    const float* misfit_pull[3];
    for (std::size_t c = 0; c < 3; ++c) {
        place[c] = place_[c].lanes();
        misfit_pull[c] = particles.misfit_pull[c].lanes();
    }
    for (std::size_t c = 0; c < 9; ++c) pull[c] = particles.pull[c].lanes();
    const std::size_t slot = block * block_size;
    const Vector x0[3] = {place_[0][block], place_[1][block], place_[2][block]};
    Vector force[3];         // Q_i sum_j w X_ij + sum_j w Q_j X_ij + sum_j w (q_i - q_j)
    Vector damping[3] = {};  // sum_j w c v_ij, for i's and for j's part
    const Vector own_viscosity = viscosity_[block];
    for (std::size_t r = 0; r < 3; ++r) {
        force[r] =
            steps.own_pull * (particles.pull[3 * r][block] * first_moment_[0][block] +
                              particles.pull[3 * r + 1][block] * first_moment_[1][block] +
                              particles.pull[3 * r + 2][block] * first_moment_[2][block] +
                              particles.misfit_pull[r][block] * zeroth_moment_[block]);
    }
    for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
        const std::size_t first = slot + static_cast<std::size_t>(n.offset);
        for (std::size_t e = 0; e < n.count; ++e) {
            const std::size_t j = first + e;
            if (steps.silent(j)) continue;
            const Vector w = n.steepness[e] * load(volume + j);
            const auto pulled = steps.pull(j);
            const Vector viscosity = load(viscosity_.lanes() + j);
            const Vector wp = w * pulled;
            const Vector wx = wp * (load(place[0] + j) - x0[0]);
            const Vector wy = wp * (load(place[1] + j) - x0[1]);
            const Vector wz = wp * (load(place[2] + j) - x0[2]);
            for (std::size_t r = 0; r < 3; ++r) {
                force[r] += load(pull[3 * r] + j) * wx + load(pull[3 * r + 1] + j) * wy +
                            load(pull[3 * r + 2] + j) * wz -
                            load(misfit_pull[r] + j) * wp;
                damping[r] += w * steps.damping(r, j, pulled, own_viscosity, viscosity);
            }
        }
    }
    for (std::size_t r = 0; r < 3; ++r) {
        particles.acceleration[r][block] =
            specific_volume_[block] * (force[r] + damping[r]);
    }
}

void Reference::accelerate(Particles& particles, std::size_t block, float share) const {
    simd::run([&](auto chosen) {
        using V = Registers<float, chosen.value>;
        accelerate_in<V>(Alike<V>(particles, block, share), particles, block);
    });
}

void Reference::accelerate(Particles& particles, std::size_t block,
                           const Arrivals& arrivals) const {
    simd::run([&](auto chosen) {
        using V = Registers<float, chosen.value>;
        accelerate_in<V>(Mixed<V>(particles, block, arrivals), particles, block);
    });
}

std::vector<std::vector<std::uint32_t>> Reference::stencils(
    const Packing& packing) const {
    std::vector<std::uint32_t> index_of_block(packing.slots / block_size);
    for (std::size_t i = 0; i < active_.size(); ++i) {
        index_of_block[active_[i]] = static_cast<std::uint32_t>(i);
    }
    std::vector<std::vector<std::uint32_t>> stencils;
    for (const std::size_t block : active_) {
        std::set<std::uint32_t> stencil = {index_of_block[block]};
        for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
            for (std::size_t e = 0; e < n.count; ++e) {
                for (std::size_t k = 0; k < block_size; ++k) {
                    const std::size_t i = block * block_size + k;
                    const std::size_t j = i + static_cast<std::size_t>(n.offset) + e;
                    if (packing.volume[i] > 0 && packing.volume[j] > 0)
                        stencil.insert(index_of_block[j / block_size]);
                }
            }
        }
        stencils.emplace_back(stencil.begin(), stencil.end());
    }
    return stencils;
}

}  // namespace taylorcal::sph
