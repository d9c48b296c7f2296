// What turns, mirrors or moves the whole experiment must not change its outcome. The
// grains are independent, so that the specimen itself has no symmetry. What differs is
// the rounding to single precision (3e-7 of sizes and energies when written).
#include "solver/material/uniform_rotation.hpp"
#include "solver/sph/monitor.hpp"

#include <map>
#include <numbers>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

constexpr double rounding = 1e-5;     // of sizes and energies
constexpr double seeds_apart = 5e-3;  // what another seed changes, at the least

using Site = std::array<std::int64_t, 3>;  // ix, iy, slot along the column
using SiteMap = std::function<Site(const Site&)>;

impact::ImpactCase small_case() {
    impact::ImpactCase impact_case;
    impact_case.shape = specimen::make_shape(specimen::reduced_head_4mm);
    impact_case.velocity_m_s = 90;
    impact_case.numerics.geometry = impact::Geometry::three_dimensional;
    impact_case.numerics.elements_across_radius = 4;
    impact_case.numerics.grains_per_point = 1;
    return impact_case;
}

/// Slot of every site, in the order in which a body wants its grains, and padding lanes.
std::vector<Site> sites_in_order(const sph::Packing& packing) {
    std::vector<const sph::Column*> column_of(packing.slots / sph::block_size, nullptr);
    for (const sph::Column& column : packing.columns) {
        for (std::size_t b = 0; b + 1 < packing.blocks_per_column; ++b)
            column_of[column.first_block + b] = &column;
    }
    std::vector<Site> sites;
    for (const std::size_t block : packing.active) {
        for (std::size_t lane = 0; lane < sph::block_size; ++lane) {
            const std::size_t slot = block * sph::block_size + lane;
            const sph::Column& column = *column_of[block];
            sites.push_back({column.ix, column.iy,
                             static_cast<std::int64_t>(slot - column.first_slot)});
        }
    }
    return sites;
}

/// Independent grains, of which the one that `origin` says comes to a site, turned by
/// `turn`.
sph::StrengthFactory grains(const impact::ImpactCase& impact_case, std::uint64_t seed,
                            const Eigen::Quaterniond& turn, const SiteMap& origin) {
    const sph::Packing packing =
        sph::pack(impact_case.shape, impact_case.shape.rear_radius() /
                                         impact_case.numerics.elements_across_radius);
    const std::vector<Site> sites = sites_in_order(packing);
    const RandomStream random(seed, 0);
    std::map<Site, Eigen::Quaterniond> first;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        first[sites[i]] = material::uniform_rotation(random, i);
    }
    std::vector<Eigen::Quaterniond> orientations;
    for (const Site& site : sites) orientations.push_back(turn * first.at(origin(site)));
    return [orientations](const material::Parameters& parameters,
                          const std::vector<Eigen::Quaterniond>& own) {
        REQUIRE(own.size() == orientations.size());
        return material::make_strength<float>(parameters, orientations);
    };
}

sph::StrengthFactory plain_grains(const impact::ImpactCase& impact_case,
                                  std::uint64_t seed = 1) {
    return grains(impact_case, seed, Eigen::Quaterniond::Identity(),
                  [](const Site& site) { return site; });
}

struct Outcome {
    std::vector<double> sizes;  // [mm]
    double plastic_work;        // [J]
    double kinetic_energy;      // less that of the flight along the anvil [J]
    double energy_error;        // gained or lost [J]
};

/// The first part of an impact of a specimen that also flies along the anvil.
Outcome shoot(const impact::ImpactCase& impact_case,
              const sph::StrengthFactory& make_strength,
              const Eigen::Vector2d& along_anvil = Eigen::Vector2d::Zero()) {
    sph::Body body(impact_case, make_strength);
    body.set_velocity([&](const Eigen::Vector3d&) {
        return Eigen::Vector3d(along_anvil.x(), along_anvil.y(),
                               -impact_case.velocity_m_s);
    });
    sph::Monitor monitor(impact_case, body);
    double mass = 0;
    for (std::size_t slot = 0; slot < body.packing().slots; ++slot)
        mass += body.mass(slot);
    const auto drift = [&](std::size_t c) {
        double momentum = 0;
        for (std::size_t slot = 0; slot < body.packing().slots; ++slot) {
            momentum += body.mass(slot) * body.particles().velocity[c][slot];
        }
        return momentum / mass;
    };
    const double speed = along_anvil.norm();
    const double flight_energy = mass * speed * speed / 2;
    const double initial = body.total_energy();
    while (body.time() < 20e-6) body.cycle();
    for (std::size_t c = 0; c < 2; ++c) {
        const double flight = along_anvil(static_cast<Eigen::Index>(c));
        CHECK(std::abs(drift(c) - flight) < 1e-6 * impact_case.velocity_m_s);
    }
    const auto profile = monitor.outline().measure(body.particles());
    return {observe::size_values(observe::measure(profile)),
            body.constitutive().work().plastic, body.kinetic_energy() - flight_energy,
            body.total_energy() - initial};
}

/// The largest relative one of sizes and energies.
double difference(const Outcome& a, const Outcome& b) {
    double largest = std::max(std::abs(a.plastic_work / b.plastic_work - 1),
                              std::abs(a.kinetic_energy / b.kinetic_energy - 1));
    largest =
        std::max(largest, std::abs(a.energy_error - b.energy_error) / b.kinetic_energy);
    for (std::size_t i = 0; i < a.sizes.size(); ++i) {
        largest = std::max(largest, std::abs(a.sizes[i] / b.sizes[i] - 1));
    }
    return largest;
}

}  // namespace

TEST_CASE("turned, mirrored and moving specimens deform alike", "[invariances]") {
    const impact::ImpactCase impact_case = small_case();
    const Outcome still = shoot(impact_case, plain_grains(impact_case));
    const double pi = std::numbers::pi;
    const auto about = [](double angle, const Eigen::Vector3d& axis) {
        return Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis));
    };
    {
        INFO("another seed");
        CHECK(difference(shoot(impact_case, plain_grains(impact_case, 2)), still) >
              seeds_apart);
    }
    {
        INFO("flight along the anvil as fast as towards it");
        const Outcome boosted =
            shoot(impact_case, plain_grains(impact_case), {54.0, -72.0});
        CHECK(difference(boosted, still) < rounding);
    }
    {
        INFO("a quarter turn about the axis, a symmetry of the packing");
        // The site (x, y) is where (y, -x) was.
        const auto turned = grains(
            impact_case, 1, about(pi / 2, Eigen::Vector3d::UnitZ()), [](const Site& s) {
                return Site{s[1], -s[0], s[2]};
            });
        CHECK(difference(shoot(impact_case, turned), still) < rounding);
    }
    {
        INFO("the mirror x -> -x");
        // Of a lattice with a centre of symmetry the mirror image is half a turn about x.
        const auto mirrored = grains(impact_case, 1, about(pi, Eigen::Vector3d::UnitX()),
                                     [](const Site& s) {
                                         return Site{-s[0], s[1], s[2]};
                                     });
        CHECK(difference(shoot(impact_case, mirrored), still) < rounding);
    }
}
