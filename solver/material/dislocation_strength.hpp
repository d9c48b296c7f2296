#pragma once

#include "solver/material/slip_systems.hpp"
#include "solver/material/strength.hpp"

#include <memory>
#include <vector>

#include <Eigen/Geometry>

namespace taylorcal::material {

/// The dislocation model of MODEL.md: twelve fcc slip systems a grain, drag-limited slip
/// above the threshold, kinetics of mobile and immobilized dislocations, Taylor
/// hardening.
///
/// Everything is kept in the crystal frame, which rotates with the spin W: there the
/// rotation terms of Eqs. 5-7 and 10 vanish, S = 2 G e with e = dev(u) - w, and
/// de/dt = dev(D) - wdot. Where the pressure changes G, it is S that stays, and e that
/// changes (dS = 2 G de). A step solves the backward-Euler equations of e together with
/// the drag roots of the twelve systems by Newton's method.
template <class Real, simd::Variant variant>
class DislocationStrength final : public Strength<Real> {
  public:
    DislocationStrength(const Parameters& parameters,
                        const std::vector<Eigen::Quaterniond>& orientations);
    void update(std::size_t block, const BlockInput<Real>& input,
                BlockOutput<Real>& output) override {
        simd::on<variant>([&] { advance(blocks_[block], input, output); });
    }
    GrainState state(std::size_t grain) const override;
    void change(const GrainChanges& changes) override;

  private:
    using V = Registers<Real, variant>;

    /// One block of grains.
    struct Block {
        V orientation[9];                ///< crystal to lab, row-major
        V elastic[5];                    ///< e = dev(u) - w
        V elastic_rate[5];               ///< de/dt of the last substep [1/s]
        V plastic[5];                    ///< w
        V mobile[slip_system_count];     ///< rhoD [1/m2]
        V immobile[slip_system_count];   ///< rhoI [1/m2]
        V drag_root[slip_system_count];  ///< z of the last step
        V annihilated_energy;            ///< J [J/m3]
        V initial_resistance;            ///< Ys0, or what hooks make of it [Pa]
        V shear_modulus;                 ///< G of the last step [Pa]
        V temperature;                   ///< of the last step [K]
        double next_substep;             ///< that the kinetics allow [s]
        V rest_dilatation;               ///< integral of div v while at rest
        double rest_time;                ///< since no system slips [s]
        bool slips;                      ///< some system did in the last substep
    };

    /// What a substep needs besides the block.
    struct Step {
        V rate[5];        ///< dev(D) in the crystal frame [1/s]
        V dilatation;     ///< div v [1/s]
        V shear_modulus;  ///< [Pa]
        V sound_speed;    ///< transverse, ct [m/s]
        V drag;           ///< B(T) [Pa s]
        Real duration;    ///< [s]
    };

    /// Slip of the twelve systems during a substep, magnitudes.
    struct Slip {
        V speed[slip_system_count];  ///< |V| [m/s]
        V force[slip_system_count];  ///< |X| [N/m]
        V power;                     ///< S : wdot [W/m3]
    };

    /// Where a substep would lead.
    struct Outcome {
        V elastic[5];
        V mobile[slip_system_count];
        V immobile[slip_system_count];
        V annihilated_energy;
        V growth;  ///< of the mobile density that grew most, above one
    };

    /// How a back stress moves e during a substep, and the plastic strain before it.
    struct Lean {
        V elastic[5];  ///< X/2G
        V plastic[5];  ///< w
    };

    void advance(Block& block, const BlockInput<Real>& input,
                 BlockOutput<Real>& output) const;
    bool is_elastic(const Block& block, const Step& step) const;
    void rest(Block& block, const Step& step) const;
    void end_rest(Block& block) const;
    void solve_stress(Block& block, const Step& step, Slip& slip, Outcome& outcome) const;
    void evolve_densities(const Block& block, const Step& step, const Slip& slip,
                          Outcome& outcome) const;
    void accept(const Outcome& outcome, const Step& step, Block& block, Slip& slip) const;
    V hardening(const Block& block, const V& shear_modulus) const;
    void before_slip(Block& block, Lean& lean) const;
    void after_slip(const Lean& lean, const Step& step, Block& block, Slip& slip) const;
    static GrainBlock seen(const Block& block);
    void change_resistance(Block& block) const;
    void lean_back(Block& block, Lean& lean) const;
    void straighten(const Lean& lean, Real duration, Block& block, V& power) const;
    void change_densities(Block& block, Real duration, const Slip& slip) const;
    void substep(Block& block, Step& step, double shortest, Slip& slip) const;

    Parameters parameters_;
    GrainHooks hooks_;
    std::vector<Block> blocks_;
};

/// The dislocation model, for what the machine runs.
template <class Real>
std::unique_ptr<Strength<Real>> make_dislocation_strength(
    const Parameters& parameters, const std::vector<Eigen::Quaterniond>& orientations);

}  // namespace taylorcal::material
