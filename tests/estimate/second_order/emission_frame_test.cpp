// SPDX-License-Identifier: MIT
#include "nephroid/estimate/second_order/emission_frame.hpp"

#include "emission/light/light_laws.hpp"
#include "support/space.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/point.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace nephroid;
using tests::Draws;
using tests::GivenSamples;

namespace {

using D = glm::dvec3;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// A light's photon from these samples with smoothing 1.
template <class L>
[[nodiscard]] auto photon_from(const L& light, double u1, double u2, double photons) {
    GivenSamples samples({u1, u2});
    return light.emit(samples, Spread<double>{photons, 1});
}

void check_close(Plane2 a, Plane2 b, double tolerance) {
    CHECK(std::abs(a.x - b.x) <= tolerance);
    CHECK(std::abs(a.y - b.y) <= tolerance);
}

} // namespace

// u0 = sqrt(area / (π N)); the lamp's patch is 2 × 3.
TEST_CASE("emission frame: coordinates are places in units of u0 for a light with parallel rays") {
    const DirectionalLight<D, double> lamp({{0, 0, -1}, 1.0, Parallelogram<D>{{5, 5, 2}, {2, 0, 0}, {0, 3, 0}}});
    const double n = 1000, u0 = std::sqrt(6 / (pi<double> * n));
    const auto here = photon_from(lamp, 0.5, 0.5, n), there = photon_from(lamp, 0.6, 0.3, n);
    const EmissionFrame frame(here), other(there);
    REQUIRE(frame.is_regular());
    const D e = here.differential[0].d_position / length(here.differential[0].d_position),
            f = here.differential[1].d_position / length(here.differential[1].d_position), step(0.2, -0.6, 0);
    check_close(frame.to(other), {dot(step, e) / u0, dot(step, f) / u0}, 1e4 * epsilon);
    check_close(frame.to(frame), {0, 0}, 0);
    const PlaneMatrix axes = frame.axes_of(other);
    check_close(axes.first, {1, 0}, 16 * epsilon);
    check_close(axes.second, {0, 1}, 16 * epsilon);
}

// Between directions an angle a apart lies a displacement of sin a across the first one, in units of sqrt(Ω / (π N)).
TEST_CASE("emission frame: coordinates are directions in units of u0 for a point light") {
    const PointLight<D, double> lamp({.position = {1, 2, 3}, .intensity = 1});
    const double n = 4000, u0 = std::sqrt(4 * pi<double> / (pi<double> * n));
    Draws draw(4);
    for (int i = 0; i < 100; ++i) {
        const double u1 = draw.in(0.1, 0.9), u2 = draw.in(0.1, 0.9);
        const auto here = photon_from(lamp, u1, u2, n), there = photon_from(lamp, u1 + 0.01, u2 - 0.01, n);
        const EmissionFrame frame(here), other(there);
        REQUIRE(frame.is_regular());
        const double sine = length(cross(here.direction, there.direction));
        const Plane2 to = frame.to(other);
        CHECK(std::sqrt(inner(to, to)) == doctest::Approx(sine / u0).epsilon(1e-9));
        // The same displacement seen from the other end, in its axes, but for the cosine between the directions.
        const Plane2 back = other.to(frame), turned = frame.axes_of(other)(back);
        CHECK(std::sqrt(inner(back, back)) == doctest::Approx(sine / u0).epsilon(1e-9));
        check_close(turned, -1.0 * to, 2 * (sine * sine) * sine / u0);
        // Its axes are turned, and foreshortened by that cosine in one direction.
        CHECK(std::abs(frame.axes_of(other).determinant()) ==
              doctest::Approx(std::sqrt(1 - sine * sine)).epsilon(1e-9));
    }
}

TEST_CASE("emission frame: axes of axes are those of both steps") {
    Draws draw(5);
    const auto any = [&] {
        const D zero(0);
        return Photon<D, double>{
            {draw.in(-1, 1), draw.in(-1, 1), 0},
            {0, 0, -1},
            1,
            {Tangent<D>{{draw.in(1, 2), draw.in(-0.5, 0.5), 0}, zero}, {{draw.in(-0.5, 0.5), draw.in(1, 2), 0}, zero}}};
    };
    for (int i = 0; i < 100; ++i) {
        const EmissionFrame a(any()), b(any()), c(any());
        const PlaneMatrix direct = a.axes_of(c), by_steps = a.axes_of(b) * b.axes_of(c),
                          one = a.axes_of(b) * b.axes_of(a);
        check_close(by_steps.first, direct.first, 256 * epsilon);
        check_close(by_steps.second, direct.second, 256 * epsilon);
        check_close(one.first, {1, 0}, 256 * epsilon);
        check_close(one.second, {0, 1}, 256 * epsilon);
        // A place is the same place by way of another one.
        check_close(a.to(b) + a.axes_of(b)(b.to(c)), a.to(c), 1024 * epsilon);
    }
}

TEST_CASE("emission frame: tangents that span nothing are not regular") {
    const auto with = [](const D& du, const D& dv) {
        const D zero(0);
        return EmissionFrame(Photon<D, double>{{1, 2, 3}, {0, 0, -1}, 1, {Tangent<D>{du, zero}, {dv, zero}}});
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    CHECK(with({1e-9, 0, 0}, {0, 1e-9, 0}).is_regular());
    CHECK(with({1e6, 0, 0}, {0, 1e-6, 0}).is_regular()); // a long one and a short one, but orthogonal
    CHECK(!with({1, 1, 0}, {2, 2, 0}).is_regular());
    CHECK(!with({1, 0, 0}, {0, 0, 0}).is_regular());
    CHECK(!with({0, 0, 0}, {0, 0, 0}).is_regular());
    CHECK(!with({nan, 0, 0}, {0, 1, 0}).is_regular());
    CHECK(!with({infinity, 0, 0}, {0, 1, 0}).is_regular());
    CHECK(!EmissionFrame().is_regular());
}
