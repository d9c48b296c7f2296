#pragma once

#include "common/simd.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <type_traits>

#ifdef TAYLORCAL_SIMD_VARIANTS
#include <immintrin.h>
#endif

namespace taylorcal {

/// Number of lanes of a block: 16 floats or 8 doubles, one grain or particle a lane.
template <class Real>
inline constexpr std::size_t lane_count = 64 / sizeof(Real);

/// A block in the registers that a variant has: one of 64 bytes, two of 32 or four of 16;
/// or fewer lanes, as many as fill one register. All arithmetic is lane by lane. The
/// lanes lie in memory in their order whatever the variant, so that blocks of one convert
/// to those of another.
template <class Real, simd::Variant variant, std::size_t lane_total = lane_count<Real>>
class Registers {
    static constexpr std::size_t bytes = variant == simd::Variant::v4   ? 64
                                         : variant == simd::Variant::v3 ? 32
                                                                        : 16;
    static constexpr std::size_t part_size = bytes / sizeof(Real);
    typedef Real Part __attribute__((vector_size(bytes)));
    typedef Real Unaligned
        __attribute__((vector_size(bytes), aligned(sizeof(Real)), may_alias));
    using Truth = decltype(Part{} < Part{});

  public:
    using Lane = Real;
    static constexpr std::size_t lanes = lane_total;
    static constexpr std::size_t parts = lanes / part_size;
    using One = Registers<Real, variant, part_size>;  ///< a single register

    /// A comparison's result, lane by lane.
    struct Mask {
        alignas(lane_total * sizeof(Real)) Truth part[parts];

        friend Mask operator&(Mask a, const Mask& b) {
            for (std::size_t i = 0; i < parts; ++i) a.part[i] &= b.part[i];
            return a;
        }
        friend Mask operator~(Mask a) {
            for (Truth& truth : a.part) truth = ~truth;
            return a;
        }
        /// Whether any lane is true.
        friend bool any_lane(const Mask& mask) {
            Truth any = mask.part[0];
            for (std::size_t i = 1; i < parts; ++i) any |= mask.part[i];
            std::uint64_t bits = 0;
            using Words = std::array<std::uint64_t, bytes / 8>;
            for (const std::uint64_t word : std::bit_cast<Words>(any)) bits |= word;
            return bits != 0;
        }
    };

    Registers() = default;
    ~Registers() = default;
    // Written out, since the compiler's own copies are of 16 bytes each, which stall the
    // wider reads that follow.
    Registers(const Registers& from) { *this = from; }
    Registers& operator=(const Registers& from) {
        for (std::size_t i = 0; i < parts; ++i) part_[i] = from.part_[i];
        return *this;
    }
    template <class Number>
    requires std::is_arithmetic_v<Number> Registers(Number value) {
        for (Part& part : part_) part = Part{} + static_cast<Real>(value);
    }
    /// From narrower registers without a word, from wider ones by assignment.
    template <simd::Variant other>
    requires(other != variant) explicit(other > variant)
        Registers(const Registers<Real, other>& from)
        : Registers(load(from.data())) {}
    template <simd::Variant other>
    requires(other != variant) Registers& operator=(const Registers<Real, other>& from) {
        return *this = load(from.data());
    }

    /// Consecutive numbers that start anywhere.
    static Registers load(const Real* first) {
        Registers loaded;
        for (std::size_t i = 0; i < parts; ++i)
            loaded.part_[i] = *reinterpret_cast<const Unaligned*>(first + i * part_size);
        return loaded;
    }
    void store(Real* first) const {
        for (std::size_t i = 0; i < parts; ++i)
            *reinterpret_cast<Unaligned*>(first + i * part_size) = part_[i];
    }
    One one(std::size_t part) const { return One::load(data() + part * part_size); }
    void set_one(std::size_t part, const One& from) {
        from.store(data() + part * part_size);
    }
    const Real* data() const { return reinterpret_cast<const Real*>(part_); }
    Real* data() { return reinterpret_cast<Real*>(part_); }

    /// One lane: not for hot loops.
    Real& operator[](std::size_t lane) { return data()[lane]; }
    Real operator[](std::size_t lane) const { return data()[lane]; }

    Registers& operator+=(const Registers& b) { return *this = *this + b; }
    Registers& operator-=(const Registers& b) { return *this = *this - b; }
    Registers& operator*=(const Registers& b) { return *this = *this * b; }
    friend Registers operator+(const Registers& a, const Registers& b) {
        return part_by_part(a, b, [](Part x, Part y) -> Part { return x + y; });
    }
    friend Registers operator-(const Registers& a, const Registers& b) {
        return part_by_part(a, b, [](Part x, Part y) -> Part { return x - y; });
    }
    friend Registers operator*(const Registers& a, const Registers& b) {
        return part_by_part(a, b, [](Part x, Part y) -> Part { return x * y; });
    }
    friend Registers operator/(const Registers& a, const Registers& b) {
        return part_by_part(a, b, [](Part x, Part y) -> Part { return x / y; });
    }
    friend Registers operator-(const Registers& a) {
        return part_by_part(a, a, [](Part x, Part) -> Part { return -x; });
    }
    friend Registers lane_max(const Registers& a, const Registers& b) {
        return part_by_part(a, b, [](Part x, Part y) -> Part { return x > y ? x : y; });
    }
    friend Registers lane_abs(const Registers& a) { return lane_max(a, -a); }
    friend Registers lane_sqrt(const Registers& a) {
        return part_by_part(a, a, [](Part x, Part) -> Part {
            for (std::size_t lane = 0; lane < part_size; ++lane)
                x[lane] = std::sqrt(x[lane]);
            return x;
        });
    }
    /// exp(a) to two units in the last place; a beyond +-87 counts as +-87. Cody and
    /// Waite's reduction, and the polynomial of the Cephes library's expf.
    friend Registers lane_exp(const Registers& a) requires std::is_same_v<Real, float> {
        return part_by_part(a, a, [](Part x, Part) -> Part {
            constexpr float edge = 87;
            x = x > edge ? Part{} + edge : x;
            x = x < -edge ? Part{} - edge : x;
            // Adding it leaves the nearest integer in the lowest bits.
            constexpr float shift = 0x1.8p23f;
            const Part shifted = x * std::numbers::log2e_v<float> + shift;
            const Part integer = shifted - shift;
            const Part r = x - integer * 0.693359375f + integer * 2.12194440e-4f;
            const Part tail =
                ((((1.9875691500e-4f * r + 1.3981999507e-3f) * r + 8.3334519073e-3f) * r +
                  4.1665795894e-2f) *
                     r +
                 1.6666665459e-1f) *
                    r +
                5.0000001201e-1f;
            const Part fraction = tail * r * r + r + 1;
            constexpr int exponent_bit = 23;
            return std::bit_cast<Part>(std::bit_cast<Truth>(fraction) +
                                       (std::bit_cast<Truth>(shifted) << exponent_bit));
        });
    }
    /// a 2^n, with n in the lowest bits of `shifted` = n + 1.5 2^23; nothing may
    /// overflow.
    friend Registers lane_times_power_of_two(
        const Registers& a,
        const Registers& shifted) requires std::is_same_v<Real, float> {
        return part_by_part(a, shifted, [](Part x, Part n) -> Part {
            constexpr int exponent_bit = 23;
            return std::bit_cast<Part>(std::bit_cast<Truth>(x) +
                                       (std::bit_cast<Truth>(n) << exponent_bit));
        });
    }
    friend Mask operator>(const Registers& a, const Registers& b) {
        Mask mask;
        for (std::size_t i = 0; i < parts; ++i) mask.part[i] = a.part_[i] > b.part_[i];
        return mask;
    }
    friend Mask operator<(const Registers& a, const Registers& b) { return b > a; }
    /// Lane by lane: mask ? a : b.
    friend Registers lane_select(const Mask& mask, const Registers& a,
                                 const Registers& b) {
        Registers chosen;
        for (std::size_t i = 0; i < parts; ++i)
            chosen.part_[i] = mask.part[i] ? a.part_[i] : b.part_[i];
        return chosen;
    }

  private:
    template <class Function>
    static Registers part_by_part(const Registers& a, const Registers& b,
                                  const Function& function) {
        Registers result;
        for (std::size_t i = 0; i < parts; ++i)
            result.part_[i] = function(a.part_[i], b.part_[i]);
        return result;
    }

    alignas(lane_total * sizeof(Real)) Part part_[parts];
};

/// How blocks are stored and handed on.
template <class Real>
using Lanes = Registers<Real, simd::Variant::v2>;

/// A block with `value` in every lane.
template <class Real>
inline Lanes<Real> broadcast(Real value) {
    return value;
}

/// A function of every lane, one by one: not for hot loops.
template <class Vector, class Function>
inline Vector lane_map(Vector a, const Function& function) {
    for (std::size_t lane = 0; lane < Vector::lanes; ++lane) a[lane] = function(a[lane]);
    return a;
}

template <simd::Variant variant>
inline Registers<double, variant> lane_exp(const Registers<double, variant>& a) {
    return lane_map(a, [](double x) { return std::exp(x); });
}

/// 1/a and 1/sqrt(a) to rounding (float: within two units in the last place).
template <class Vector>
inline Vector lane_inverse(const Vector& a) {
    return 1 / a;
}
template <class Vector>
inline Vector lane_inverse_sqrt(const Vector& a) {
    return 1 / lane_sqrt(a);
}
#ifdef TAYLORCAL_SIMD_VARIANTS
// Estimates of the processor and one step of Newton's (AVX-512, 14 bits) or Halley's
// method (AVX2, 12 bits): several times faster than its division and square root, which
// would dominate the plasticity update. AVX2's estimates differ between makers of
// processors, and with them the last bit of a result.
using Estimable16 = Registers<float, simd::Variant::v4>;
[[gnu::target("arch=x86-64-v4")]] inline void estimate_inverse(const Estimable16& a,
                                                               Estimable16& estimate) {
    _mm512_store_ps(estimate.data(),
                    _mm512_maskz_rcp14_ps(0xffff, _mm512_load_ps(a.data())));
}
[[gnu::target("arch=x86-64-v4")]] inline void estimate_inverse_sqrt(
    const Estimable16& a, Estimable16& estimate) {
    _mm512_store_ps(estimate.data(),
                    _mm512_maskz_rsqrt14_ps(0xffff, _mm512_load_ps(a.data())));
}
inline Estimable16 lane_inverse(const Estimable16& a) {
    Estimable16 estimate;
    estimate_inverse(a, estimate);
    return estimate * (2 - a * estimate);
}
inline Estimable16 lane_inverse_sqrt(const Estimable16& a) {
    Estimable16 estimate;
    estimate_inverse_sqrt(a, estimate);
    return estimate * (1.5f - 0.5f * a * estimate * estimate);
}

template <std::size_t lanes>
using Estimable8 = Registers<float, simd::Variant::v3, lanes>;
template <std::size_t lanes>
[[gnu::target("arch=x86-64-v3")]] inline void estimate_inverse(
    const Estimable8<lanes>& a, Estimable8<lanes>& estimate) {
    for (std::size_t i = 0; i < lanes; i += 8)
        _mm256_store_ps(estimate.data() + i, _mm256_rcp_ps(_mm256_load_ps(a.data() + i)));
}
template <std::size_t lanes>
[[gnu::target("arch=x86-64-v3")]] inline void estimate_inverse_sqrt(
    const Estimable8<lanes>& a, Estimable8<lanes>& estimate) {
    for (std::size_t i = 0; i < lanes; i += 8)
        _mm256_store_ps(estimate.data() + i,
                        _mm256_rsqrt_ps(_mm256_load_ps(a.data() + i)));
}
template <std::size_t lanes>
inline Estimable8<lanes> lane_inverse(const Estimable8<lanes>& a) {
    Estimable8<lanes> estimate;
    estimate_inverse(a, estimate);
    const Estimable8<lanes> rest = 1 - a * estimate;
    return estimate + estimate * (rest + rest * rest);
}
template <std::size_t lanes>
inline Estimable8<lanes> lane_inverse_sqrt(const Estimable8<lanes>& a) {
    Estimable8<lanes> estimate;
    estimate_inverse_sqrt(a, estimate);
    const Estimable8<lanes> rest = 1 - a * estimate * estimate;
    return estimate + estimate * rest * (0.5f + 0.375f * rest);
}
#endif

}  // namespace taylorcal
