#pragma once

#include <string>
#include <type_traits>

namespace taylorcal::simd {

// The programs are built for x86-64-v2, a processor of 2009. Hot loops exist once more
// for AVX2 and for AVX-512, and the machine decides at run time. How: `work` is an
// ordinary lambda, compiled for the baseline; `flatten` inlines it, and all that it
// calls, into one function which is compiled for more. No other function is, so that the
// linker can never pick an AVX copy of a function that all share, such as std::vector's.
//
// Two rules for what `work` calls. Bodies must be visible (templates, or the same file),
// for a call that stays a call runs the baseline's code. And such a call, of a virtual
// function say, passes vectors by reference: by value each variant passes them otherwise.

/// What hot loops are compiled for, from the least to the most: the levels of the x86-64
/// psABI. This list, `on` and the names in simd.cpp are all that knows them.
enum class Variant {
    v2,  ///< SSE4.2; other processors: whatever their compiler makes of 16-byte vectors
    v3,  ///< AVX2 and FMA
    v4,  ///< AVX-512
};

// Where nothing is inlined (debug builds) and elsewhere than on x86-64 with GCC, the
// baseline is all there is.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    defined(__OPTIMIZE__)
#define TAYLORCAL_SIMD_VARIANTS
inline constexpr bool has_variants = true;
#else
inline constexpr bool has_variants = false;
#endif

/// The best variant that the processor runs, or the one that the environment variable
/// TAYLORCAL_SIMD names; InputError if it names none that this machine runs.
Variant variant();

/// "v2", "v3" or "v4"; "generic" for the only variant elsewhere than on x86-64.
std::string name(Variant variant);

template <class Work>
[[gnu::flatten, gnu::noinline]] void on_v2(const Work& work) {
    work();
}
#ifdef TAYLORCAL_SIMD_VARIANTS
template <class Work>
[[gnu::target("arch=x86-64-v3"), gnu::flatten, gnu::noinline]] void on_v3(
    const Work& work) {
    work();
}
template <class Work>
[[gnu::target("arch=x86-64-v4"), gnu::flatten, gnu::noinline]] void on_v4(
    const Work& work) {
    work();
}
#endif

/// Runs work(), compiled for `chosen`.
template <Variant chosen, class Work>
void on(const Work& work) {
#ifdef TAYLORCAL_SIMD_VARIANTS
    if constexpr (chosen == Variant::v4) return on_v4(work);
    if constexpr (chosen == Variant::v3) return on_v3(work);
#endif
    on_v2(work);
}

/// A variant as a type.
template <Variant v>
using Constant = std::integral_constant<Variant, v>;

/// Returns pick(Constant<variant()>()).
template <class Pick>
auto with_variant(const Pick& pick) {
    if constexpr (has_variants) {
        if (variant() == Variant::v4) return pick(Constant<Variant::v4>());
        if (variant() == Variant::v3) return pick(Constant<Variant::v3>());
    }
    return pick(Constant<Variant::v2>());
}

/// Runs work(Constant<variant()>()), compiled for that variant.
template <class Work>
void run(const Work& work) {
    with_variant([&](auto chosen) { on<chosen.value>([&] { work(chosen); }); });
}

}  // namespace taylorcal::simd
