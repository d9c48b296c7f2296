#include "common/simd.hpp"

#include "common/errors.hpp"

#include <cstdlib>
#include <vector>

#include <fmt/core.h>

namespace taylorcal::simd {

namespace {

constexpr const char* environment_variable = "TAYLORCAL_SIMD";

/// What this build holds and this machine runs, the best last.
std::vector<Variant> runnable() {
    std::vector<Variant> found = {Variant::v2};
#ifdef TAYLORCAL_SIMD_VARIANTS
    __builtin_cpu_init();
    if (__builtin_cpu_supports("x86-64-v3")) found.push_back(Variant::v3);
    if (__builtin_cpu_supports("x86-64-v4")) found.push_back(Variant::v4);
#endif
    return found;
}

Variant choose() {
    const std::vector<Variant> variants = runnable();
    const char* wanted = std::getenv(environment_variable);
    if (wanted == nullptr) return variants.back();
    std::string expected;
    for (const Variant candidate : variants) {
        if (name(candidate) == wanted) return candidate;
        expected += (expected.empty() ? "" : ", ") + name(candidate);
    }
    throw InputError(fmt::format(
        "{} = \"{}\" (expected on this machine: {}). Unset it to use the best.",
        environment_variable, wanted, expected));
}

}  // namespace

Variant variant() {
    static const Variant chosen = choose();
    return chosen;
}

std::string name(Variant variant) {
#ifdef __x86_64__
    switch (variant) {
        case Variant::v4:
            return "v4";
        case Variant::v3:
            return "v3";
        case Variant::v2:
            break;
    }
    return "v2";
#else
    (void)variant;
    return "generic";
#endif
}

}  // namespace taylorcal::simd
