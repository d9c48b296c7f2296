#include "common/lanes.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

using namespace taylorcal;

namespace {

template <class Real, simd::Variant v>
struct Case {
    using Number = Real;
    static constexpr simd::Variant variant = v;
};

/// What `function` makes of a block, compiled for the case's variant.
template <class Case, class Function>
Lanes<typename Case::Number> made_of(const Lanes<typename Case::Number>& block,
                                     const Function& function) {
    Lanes<typename Case::Number> result;
    simd::on<Case::variant>([&] {
        result = function(Registers<typename Case::Number, Case::variant>(block));
    });
    return result;
}

}  // namespace

#define EVERY_CASE                                                           \
    (Case<float, simd::Variant::v2>), (Case<float, simd::Variant::v3>),      \
        (Case<float, simd::Variant::v4>), (Case<double, simd::Variant::v2>), \
        (Case<double, simd::Variant::v3>), (Case<double, simd::Variant::v4>)

TEMPLATE_TEST_CASE("a block does in every variant what its numbers do", "[lanes]",
                   EVERY_CASE) {
    using Real = typename TestType::Number;
    if (TestType::variant > simd::variant()) return;  // not on this machine
    const double rounding = 4 * static_cast<double>(std::numeric_limits<Real>::epsilon());
    Lanes<Real> x;
    for (std::size_t lane = 0; lane < lane_count<Real>; ++lane)
        x[lane] = static_cast<Real>(0.37 * (static_cast<double>(lane) - 5.2));
    const auto check = [&](const auto& block_function, const auto& function) {
        const Lanes<Real> result = made_of<TestType>(x, block_function);
        for (std::size_t lane = 0; lane < lane_count<Real>; ++lane) {
            const auto number = static_cast<double>(x[lane]);
            CHECK(static_cast<double>(result[lane]) ==
                  Approx(function(number)).epsilon(rounding).margin(1e-30));
        }
    };
    check([](auto a) { return 2 * a + a * a - a / 3; },
          [](double a) { return 2 * a + a * a - a / 3; });
    check([](auto a) { return lane_abs(a); }, [](double a) { return std::abs(a); });
    check([](auto a) { return lane_sqrt(lane_abs(a)); },
          [](double a) { return std::sqrt(std::abs(a)); });
    check([](auto a) { return lane_inverse(a); }, [](double a) { return 1 / a; });
    check([](auto a) { return lane_inverse_sqrt(a * a); },
          [](double a) { return 1 / std::abs(a); });
    check([](auto a) { return lane_exp(20 * a); },
          [](double a) {
              return std::exp(static_cast<double>(20 * static_cast<Real>(a)));
          });
    check([](auto a) { return lane_select(a < 0.4, a, decltype(a)(7)); },
          [](double a) { return a < 0.4 ? a : 7; });
}

TEMPLATE_TEST_CASE("one true lane is any lane", "[lanes]", EVERY_CASE) {
    using Real = typename TestType::Number;
    if (TestType::variant > simd::variant()) return;
    for (std::size_t lane = 0; lane < lane_count<Real>; ++lane) {
        Lanes<Real> x = 0;
        x[lane] = 1;
        bool one = false, all_but_one = false, none = true;
        simd::on<TestType::variant>([&] {
            const Registers<Real, TestType::variant> a(x);
            one = any_lane(a > 0.5);
            all_but_one = any_lane(~(a > 0.5));
            none = any_lane((a > 0.5) & (a < 0.5));
        });
        CHECK(one);
        CHECK(all_but_one);
        CHECK_FALSE(none);
    }
}
