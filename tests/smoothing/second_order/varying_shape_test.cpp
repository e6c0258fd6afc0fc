// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/varying_shape.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::varying_shape_test {

using namespace nephroid::detail;
using tests::Draws;

namespace {

[[nodiscard]] Symmetric2 any_tensor(Draws& draw, double size) {
    return {draw.in(-size, size), draw.in(-size, size), draw.in(-size, size)};
}

} // namespace

// S + x S', with a bound of d + x d': differences of what comes out for x = ± h, by h² and rounding over h.
TEST_CASE("varying shape: bounding a shape bounds its derivatives consistently") {
    Draws draw(1);
    constexpr double h = 1e-4;
    for (int i = 0; i < 200; ++i) {
        const Symmetric2 s{draw.in(40, 90), draw.in(-20, 20), draw.in(40, 90)};
        const Symmetric2 along_u = any_tensor(draw, 5), along_v = any_tensor(draw, 5);
        const double angle = draw.in(0, 6.3), most = draw.in(3, 12);
        const Plane2 n{std::cos(angle), std::sin(angle)}, slope{draw.in(-1, 1), draw.in(-1, 1)};
        VaryingShape shape{s, along_u, along_v};
        shape.bound_along(n, most, slope);
        const auto at = [&](const Symmetric2& along, double d_most, double x) {
            VaryingShape moved{s + x * along, {}, {}};
            moved.bound_along(n, most + x * d_most, {});
            return moved.value;
        };
        const auto check = [&](const Symmetric2& derivative, const Symmetric2& along, double d_most) {
            const Symmetric2 difference = (0.5 / h) * (at(along, d_most, h) + -1.0 * at(along, d_most, -h));
            CHECK(std::abs(derivative.xx - difference.xx) < 1e-6);
            CHECK(std::abs(derivative.xy - difference.xy) < 1e-6);
            CHECK(std::abs(derivative.yy - difference.yy) < 1e-6);
        };
        check(shape.along_u, along_u, slope.x);
        check(shape.along_v, along_v, slope.y);
        const double radius2 = inner(n, s(n)), bounded2 = inner(n, shape.value(n));
        CHECK(bounded2 < most * most);
        CHECK(bounded2 == doctest::Approx(1 / std::hypot(1 / radius2, 1 / (most * most))));
        // Across, in the direction that is conjugate to n, nothing changes.
        const Plane2 touch = s(n), across{-touch.y, touch.x}, before = s(across), after = shape.value(across);
        CHECK(std::abs(before.x - after.x) + std::abs(before.y - after.y) <= 1e-9 * s.trace() * s.trace());
    }
}

// As above; the mean squared radius ρ² is half the trace, and 1/ρ⁴ grows by 1/m⁴.
TEST_CASE("varying shape: bounding the size keeps the form and bounds the derivatives consistently") {
    Draws draw(2);
    constexpr double h = 1e-4;
    for (int i = 0; i < 200; ++i) {
        const Symmetric2 s{draw.in(40, 90), draw.in(-20, 20), draw.in(40, 90)};
        const Symmetric2 along_u = any_tensor(draw, 5), along_v = any_tensor(draw, 5);
        const double most = draw.in(3, 12);
        const Plane2 slope{draw.in(-1, 1), draw.in(-1, 1)};
        VaryingShape shape{s, along_u, along_v};
        shape.bound_size(most, slope);
        const auto at = [&](const Symmetric2& along, double d_most, double x) {
            VaryingShape moved{s + x * along, {}, {}};
            moved.bound_size(most + x * d_most, {});
            return moved.value;
        };
        const auto check = [&](const Symmetric2& derivative, const Symmetric2& along, double d_most) {
            const Symmetric2 difference = (0.5 / h) * (at(along, d_most, h) + -1.0 * at(along, d_most, -h));
            CHECK(std::abs(derivative.xx - difference.xx) < 1e-6);
            CHECK(std::abs(derivative.xy - difference.xy) < 1e-6);
            CHECK(std::abs(derivative.yy - difference.yy) < 1e-6);
        };
        check(shape.along_u, along_u, slope.x);
        check(shape.along_v, along_v, slope.y);
        const double radius2 = 0.5 * s.trace(), bounded2 = 0.5 * shape.value.trace();
        CHECK(bounded2 == doctest::Approx(1 / std::hypot(1 / radius2, 1 / (most * most))));
        CHECK(shape.value.xy / s.xy == doctest::Approx(bounded2 / radius2));
        CHECK(shape.value.xx / s.xx == doctest::Approx(bounded2 / radius2));
    }
}

TEST_CASE("varying shape: a distant bound changes nothing") {
    VaryingShape along{{9, 1, 4}, {1, 2, 3}, {4, 5, 6}}, size = along;
    along.bound_along({1, 0}, 8.5, {1, 1});
    size.bound_size(8.5, {1, 1});
    for (const VaryingShape& shape : {along, size}) {
        CHECK((shape.value.xx == 9 && shape.value.xy == 1 && shape.value.yy == 4));
        CHECK((shape.along_u.xx == 1 && shape.along_v.yy == 6));
    }
}

} // namespace nephroid::tests::varying_shape_test
