#pragma once

#include <string>

namespace taylorcal::calibrate {

/// Prior of an effect's amplitude, in the amplitude's own unit.
struct AmplitudePrior {
    enum class Kind { half_normal, normal, uniform };
    Kind kind = Kind::half_normal;
    double scale = 1;  ///< standard deviation; for `uniform` the width beyond absence

    /// ln of the density at an amplitude, before the physical range cuts it.
    double log_density(double amplitude) const;
    /// What the range [lower, upper] keeps of it.
    double mass(double lower, double upper) const;
    /// The same with a width changed by a factor.
    AmplitudePrior widened(double factor) const { return {kind, factor * scale}; }
};

/// Something the model may miss: an effect that is switched off, or a constant of the
/// material that the study keeps fixed. Its amplitude is value - base, 0 = absent.
struct Candidate {
    std::string name;
    bool is_constant = false;
    std::string unit;
    double base = 0;  ///< value at which it is absent
    double lowest = 0;
    double highest = 1;
    AmplitudePrior prior;

    double lower() const { return lowest - base; }  ///< of the amplitude
    double upper() const { return highest - base; }
    bool may_fall() const { return lower() < 0; }
    bool may_rise() const { return upper() > 0; }
    bool is_allowed(double amplitude) const {
        return amplitude > 0 ? may_rise() : amplitude < 0 && may_fall();
    }
    /// An amplitude of the size that the prior expects, inside the physical range.
    double typical() const;
};

}  // namespace taylorcal::calibrate
