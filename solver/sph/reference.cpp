#include "solver/sph/reference.hpp"

#include "solver/sph/kernel.hpp"
#include "solver/sph/misfit.hpp"

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

Reference::Reference(const Packing& packing, double density)
    : active_(packing.active),
      column_of_block_(packing.slots / block_size),
      volume_(packing.slots),
      specific_volume_(packing.slots),
      first_pair_(packing.slots / block_size),
      weight_sum_(packing.slots) {
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
    measure_misfits(packing);
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

template <class Visit>
void Reference::visit_neighbours(std::size_t slot, const Visit& visit) const {
    std::size_t pair = 0;
    for (const NeighbourColumn& n : neighbours_[column_of_block_[slot / block_size]]) {
        for (std::size_t e = 0; e < n.count; ++e, ++pair) {
            const std::size_t j = slot + static_cast<std::size_t>(n.offset) + e;
            if (n.steepness[e] > 0 && volume_.lanes()[j] > 0)
                visit(pair, j, n.steepness[e]);
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
            visit_neighbours(slot, [&](std::size_t, std::size_t, float) { ++pairs; });
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
            visit_neighbours(slot, [&](std::size_t, std::size_t j, float steepness) {
                const double w = packing.volume[j] * static_cast<double>(steepness);
                Eigen::Vector3d offset;
                for (int c = 0; c < 3; ++c) {
                    const float* place = place_[static_cast<std::size_t>(c)].lanes();
                    offset(c) = static_cast<double>(place[j] - place[slot]);
                }
                moment += w * offset * offset.transpose();
                first += w * offset;
            });
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

void Reference::measure_misfits(const Packing& packing) {
    // A pair's number in its column's list, by the distance of its slots.
    std::vector<std::map<std::ptrdiff_t, std::size_t>> pair_at;
    for (const auto& list : neighbours_) {
        auto& numbers = pair_at.emplace_back();
        for (const NeighbourColumn& n : list) {
            for (std::size_t e = 0; e < n.count; ++e)
                numbers.emplace(n.offset + static_cast<std::ptrdiff_t>(e),
                                numbers.size());
        }
    }
    std::size_t pairs = 0;
    for (const std::size_t block : active_) {
        first_pair_[block] = pairs;
        pairs += pair_at[column_of_block_[block]].size();
    }
    misfit_weight_.assign(pairs, Vector{});
    reaction_weight_.assign(pairs, Vector{});
    for (const std::size_t block : active_) {
        for (std::size_t k = 0; k < block_size; ++k) {
            const std::size_t slot = block * block_size + k;
            if (packing.volume[slot] <= 0) continue;
            std::vector<Neighbour> neighbours;
            visit_neighbours(slot, [&](std::size_t, std::size_t j, float) {
                neighbours.push_back(
                    {{packing.x[j] - packing.x[slot], packing.y[j] - packing.y[slot],
                      packing.z[j] - packing.z[slot]},
                     packing.volume[j]});
            });
            const std::vector<double> weights =
                misfit_weights(neighbours, packing.local_edge[slot]);
            auto weight = weights.begin();
            double sum = 0;
            visit_neighbours(slot, [&](std::size_t pair, std::size_t j, float) {
                misfit_weight_[first_pair_[block] + pair][k] =
                    static_cast<float>(*weight);
                const std::size_t other = j / block_size;
                const std::size_t back = pair_at[column_of_block_[other]].at(
                    static_cast<std::ptrdiff_t>(slot) - static_cast<std::ptrdiff_t>(j));
                reaction_weight_[first_pair_[other] + back][j % block_size] =
                    static_cast<float>(*weight * packing.volume[slot] /
                                       packing.volume[j]);
                sum += *weight++;
            });
            weight_sum_.lanes()[slot] = static_cast<float>(sum);
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
    Vector misfit[3] = {};
    const float* weight = misfit_weight_[first_pair_[block]].data();
    for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
        const std::size_t first = slot + static_cast<std::size_t>(n.offset);
        for (std::size_t e = 0; e < n.count; ++e) {
            const std::size_t j = first + e;
            const Vector c = load(weight);
            weight += block_size;
            const Vector w = n.steepness[e] * load(volume + j);
            const Vector x = load(place[0] + j) - x0[0];
            const Vector y = load(place[1] + j) - x0[1];
            const Vector z = load(place[2] + j) - x0[2];
            for (std::size_t r = 0; r < 3; ++r) {
                const Vector v = load(speed[r] + j) - v0[r];
                const Vector wv = w * v;
                misfit[r] += c * v;
                sum[3 * r] += wv * x;
                sum[3 * r + 1] += wv * y;
                sum[3 * r + 2] += wv * z;
            }
        }
    }
    Vector rate[9];
    times_symmetric(sum, inverse_, block, rate);
    for (std::size_t c = 0; c < 9; ++c) particles.rate[c][block] = rate[c];
    for (std::size_t r = 0; r < 3; ++r) particles.misfit_rate[r][block] = misfit[r];
}

namespace {

/// All of the stencil is in step.
struct Alike {
    float own_pull;

    bool silent(std::size_t) const { return false; }
    float pull(std::size_t) const { return own_pull; }
};

/// What arrives now of stresses that were renewed over several levels' steps.
template <class Vector>
struct Mixed {
    const float* impulses;
    bool own_arrives;
    Vector own_pull;
    Vector per_period;
    float open;

    Mixed(std::size_t block, const Arrivals& arrivals)
        : impulses(arrivals.impulse.lanes()),
          per_period(1 / arrivals.period),
          open(arrivals.open) {
        const Vector impulse = arrivals.impulse[block];
        own_arrives = impulse[0] <= open;
        own_pull = own_arrives ? impulse * per_period : Vector{};
    }
    /// Whether nothing passes now between the block and the sixteen slots from j on.
    bool silent(std::size_t j) const {
        return !own_arrives && impulses[j] > open && impulses[j + block_size - 1] > open;
    }
    Vector pull(std::size_t j) const {
        const Vector impulse = Vector::load(impulses + j);
        return lane_select(impulse > open, Vector{}, impulse * per_period);
    }
};

}  // namespace

template <class Vector, class Steps>
void Reference::accelerate_in(const Steps& steps, Particles& particles,
                              std::size_t block) const {
    const auto load = [](const float* first) { return Vector::load(first); };
    const float* volume = volume_.lanes();
    const float* reaction = reaction_weight_[first_pair_[block]].data();
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
    // Q_i sum_j w X_ij + sum_j w Q_j X_ij + sum_j (c_ij q_i - c_ji q_j V_j/V_i)
    Vector force[3];
    for (std::size_t r = 0; r < 3; ++r) {
        force[r] =
            steps.own_pull * (particles.pull[3 * r][block] * first_moment_[0][block] +
                              particles.pull[3 * r + 1][block] * first_moment_[1][block] +
                              particles.pull[3 * r + 2][block] * first_moment_[2][block] +
                              particles.misfit_pull[r][block] * weight_sum_[block]);
    }
    for (const NeighbourColumn& n : neighbours_[column_of_block_[block]]) {
        const std::size_t first = slot + static_cast<std::size_t>(n.offset);
        for (std::size_t e = 0; e < n.count; ++e, reaction += block_size) {
            const std::size_t j = first + e;
            if (steps.silent(j)) continue;
            const auto pulled = steps.pull(j);
            const Vector wp = n.steepness[e] * load(volume + j) * pulled;
            const Vector wx = wp * (load(place[0] + j) - x0[0]);
            const Vector wy = wp * (load(place[1] + j) - x0[1]);
            const Vector wz = wp * (load(place[2] + j) - x0[2]);
            const Vector cp = load(reaction) * pulled;
            for (std::size_t r = 0; r < 3; ++r) {
                force[r] += load(pull[3 * r] + j) * wx + load(pull[3 * r + 1] + j) * wy +
                            load(pull[3 * r + 2] + j) * wz -
                            load(misfit_pull[r] + j) * cp;
            }
        }
    }
    for (std::size_t r = 0; r < 3; ++r)
        particles.acceleration[r][block] = specific_volume_[block] * force[r];
}

void Reference::accelerate(Particles& particles, std::size_t block, float share) const {
    simd::run([&](auto chosen) {
        accelerate_in<Registers<float, chosen.value>>(Alike{share}, particles, block);
    });
}

void Reference::accelerate(Particles& particles, std::size_t block,
                           const Arrivals& arrivals) const {
    simd::run([&](auto chosen) {
        using V = Registers<float, chosen.value>;
        accelerate_in<V>(Mixed<V>(block, arrivals), particles, block);
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
