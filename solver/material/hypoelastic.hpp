#pragma once

#include "solver/material/strength.hpp"

#include <cstddef>
#include <vector>

namespace taylorcal::material {

/// What a yield rule is asked about a block of grains, lane by lane.
template <class Real>
struct YieldQuestion {
    Lanes<Real> trial_stress;    ///< von Mises stress if the step were elastic [Pa]
    Lanes<Real> plastic_strain;  ///< equivalent, accumulated before the step
    Lanes<Real> temperature;     ///< [K]
    Lanes<Real> shear_modulus;   ///< [Pa]
    Real time_step;              ///< [s]
};

/// The frame that the isotropic reference strengths share: a hypoelastic deviator with
/// the Jaumann rate, returned radially to the yield surface. The stress is turned by the
/// orthogonal Cayley map of the spin (Hughes and Winget 1980, doi
/// 10.1002/nme.1620151210), so that a rigid rotation of any size changes no invariant.
template <class Real>
class HypoelasticStrength : public Strength<Real> {
  public:
    explicit HypoelasticStrength(std::size_t grains);
    void update(std::size_t block, const BlockInput<Real>& input,
                BlockOutput<Real>& output) final;
    GrainState state(std::size_t grain) const final;

  protected:
    /// Growth of the equivalent plastic strain over the step, zero where it is elastic.
    virtual Lanes<Real> plastic_increment(const YieldQuestion<Real>& question) const = 0;
    /// Yield stress at an equivalent plastic strain, for outputs [Pa].
    virtual double yield_stress(double plastic_strain) const = 0;

  private:
    struct Block {
        Lanes<Real> stress[6];       // xx yy zz xy xz yz [Pa]
        Lanes<Real> plastic_strain;  // equivalent, accumulated
        Lanes<Real> shear_modulus;   // of the last step [Pa]
    };
    std::vector<Block> blocks_;
};

}  // namespace taylorcal::material
