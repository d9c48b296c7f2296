#pragma once

#include "calibrate/settings/settings.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace taylorcal::calibrate {

/// Points of the unit cube in at most four dimensions, each a function of its number
/// alone: the draws of a pass may be made in any order and by any thread. A coordinate is
/// a 32-bit fraction.
///
/// `random`: the four words of one Philox counter. `sobol`: Sobol's sequence (direction
/// numbers of Joe and Kuo 2008, doi 10.1137/070709359), scrambled by Owen's nested
/// permutations in the form of a hash (Burley 2020, J. Comput. Graph. Tech. 9(4)). The
/// draws are dealt in blocks to `replicates` sequences, each with a scrambling of its
/// own, whose scatter measures the error; one that has run through its 2^32 points goes
/// on with the next scrambling.
class UnitSequence {
  public:
    static constexpr std::size_t most_dimensions = 4;
    static constexpr std::uint64_t replicates = 16;
    static constexpr std::uint64_t block = 1U << 14U;
    using Words = std::array<std::uint32_t, most_dimensions>;

    UnitSequence(DrawSequence kind, std::uint64_t seed, std::size_t dimensions);

    /// Draws `number_of_block * block` onwards: coordinate d of the i-th in words[d][i].
    void fill(std::uint64_t number_of_block, std::size_t count,
              std::array<std::vector<std::uint32_t>, most_dimensions>& words) const;
    std::size_t dimensions() const { return dimensions_; }

  private:
    void fill_sobol(std::uint64_t number_of_block, std::size_t count,
                    std::array<std::vector<std::uint32_t>, most_dimensions>& words) const;
    DrawSequence kind_;
    std::uint64_t seed_;
    std::size_t dimensions_;
};

/// The replicate that a block of draws belongs to.
inline std::uint64_t replicate_of(std::uint64_t number_of_block) {
    return number_of_block % UnitSequence::replicates;
}

/// The middle of the cell of the unit interval that a word stands for.
inline double unit_of(std::uint32_t word) { return (word + 0.5) * 0x1p-32; }

}  // namespace taylorcal::calibrate
