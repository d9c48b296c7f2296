#include "solver/axisymmetric/local_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace taylorcal::axisymmetric {
namespace {

constexpr double step_growth = 1.2;  // of the stable step from one cycle to the next
constexpr int deepest_level = 5;
constexpr int shallowest_cycle = 2;  // levels: fewer would spend time dealing out steps
constexpr int candidates = 8;        // for the shortest step, within a factor of two
// Steps longer than the shortest leave this room to what is stable. Impulses that come
// less often than a finer neighbour's resonate with it where they are nearly as far apart
// as can be: metal that rings without slipping gained energy.
constexpr double room = 1.2;

/// Largest stable step of a cell times `numerics.cfl` [s].
double stable_step(const Body& body, std::size_t cell) {
    const double width =
        narrowest_width(body.ring[cell], body.last_radius[cell], body.last_height[cell]);
    const double sound = sound_speed(body, cell);
    const double density = body.cell_mass[cell] / body.ring[cell].volume;
    const double viscous_speed = 4 * body.viscous_pressure[cell] / (density * sound);
    return body.numerics.cfl * width / (sound + viscous_speed);
}

int level_of(double stable, double shortest) {
    int level = 0;
    while (level < deepest_level && stable >= room * shortest * (2 << level)) ++level;
    return level;
}

/// The shortest step, no longer than `longest`, for which all groups take the fewest
/// updates: a little less than what is stable may let the bulk take twice the step.
double cheapest_step(const std::vector<double>& stable, double longest) {
    double best = longest;
    double least_updates = std::numeric_limits<double>::infinity();
    for (int i = 0; i < candidates; ++i) {
        const double step = longest * std::exp2(-static_cast<double>(i) / candidates);
        double updates = 0;  // a second
        for (const double s : stable) updates += 1 / (step * (1 << level_of(s, step)));
        if (updates < least_updates * (1 - 1e-9)) {
            least_updates = updates;
            best = step;
        }
    }
    return best;
}

}  // namespace

LocalSteps::LocalSteps(const Body& body) : node_level_(body.nodes()) {
    const auto grains = static_cast<std::size_t>(body.numerics.grains_per_point);
    const std::size_t together =
        std::max<std::size_t>(1, material::lane_count<float> / grains);
    for (std::size_t first = 0; first < body.cells(); first += together)
        groups_.push_back({first, std::min(first + together, body.cells()), 0});
}

double LocalSteps::assign(const Body& body, double left,
                          const std::vector<std::size_t>& touching) {
    std::vector<double> stable;
    stable.reserve(groups_.size());
    double shortest = step_growth * last_shortest_;
    for (const Group& group : groups_) {
        double step = std::numeric_limits<double>::infinity();
        for (std::size_t c = group.first; c < group.last; ++c)
            step = std::min(step, stable_step(body, c));
        stable.push_back(step);
        shortest = std::min(shortest, step);
    }
    last_shortest_ = shortest;
    shortest = cheapest_step(stable, shortest);
    for (std::size_t g = 0; g < groups_.size(); ++g)
        groups_[g].level = level_of(stable[g], shortest);
    limit_to_neighbours(body, touching);
    deepest_ = shallowest_cycle;
    for (const Group& group : groups_) deepest_ = std::max(deepest_, group.level);
    return std::min(shortest, left / cycle());
}

void LocalSteps::limit_to_neighbours(const Body& body,
                                     const std::vector<std::size_t>& touching) {
    for (bool changed = true; changed;) {
        changed = false;
        std::fill(node_level_.begin(), node_level_.end(), deepest_level);
        for (const std::size_t n : touching) node_level_[n] = -1;
        for (const Group& group : groups_)
            for (std::size_t c = group.first; c < group.last; ++c)
                for (const std::size_t n : body.mesh.cells[c])
                    node_level_[n] = std::min(node_level_[n], group.level);
        for (Group& group : groups_) {
            int level = group.level;
            for (std::size_t c = group.first; c < group.last; ++c)
                for (const std::size_t n : body.mesh.cells[c])
                    level = std::min(level, node_level_[n] + 1);
            changed |= level != group.level;
            group.level = level;
        }
    }
}

}  // namespace taylorcal::axisymmetric
