// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/emission_frame.hpp"

#include "emission/light/light_laws.hpp"
#include "support/space.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/disk.hpp"
#include "nephroid/emission/light/point.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace nephroid::tests::emission_frame_test {

using namespace nephroid::detail;
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
    check_close(frame.displacement_to(other), {dot(step, e) / u0, dot(step, f) / u0}, 1e4 * epsilon);
    check_close(frame.displacement_to(frame), {0, 0}, 0);
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
        const Plane2 to = frame.displacement_to(other);
        CHECK(std::sqrt(inner(to, to)) == doctest::Approx(sine / u0).epsilon(1e-9));
        // The same displacement seen from the other end, in its axes, but for the cosine between the directions.
        const Plane2 back = other.displacement_to(frame), turned = frame.axes_of(other)(back);
        CHECK(std::sqrt(inner(back, back)) == doctest::Approx(sine / u0).epsilon(1e-9));
        check_close(turned, -1.0 * to, 2 * (sine * sine) * sine / u0);
        // Its axes are turned, and foreshortened by that cosine in one direction.
        CHECK(std::abs(frame.axes_of(other).determinant()) ==
              doctest::Approx(std::sqrt(1 - sine * sine)).epsilon(1e-9));
    }
}

TEST_CASE("emission frame: changes of axes compose") {
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
        check_close(a.displacement_to(b) + a.axes_of(b)(b.displacement_to(c)), a.displacement_to(c), 1024 * epsilon);
    }
}

// u0 of places is sqrt(area / (π N)) = radius / sqrt(N), of directions as many units as make N of them π.
TEST_CASE("emission frame: an area light's photons differ in position and in direction") {
    const double photons = 400, radius = 3;
    const DiskLight<D, double> disk({.centre = {1, 2, 3}, .normal = {0, 0, -1}, .radius = radius, .radiance = 1});
    const auto photon = [&](std::vector<double> samples) {
        GivenSamples given(samples);
        return disk.emit(given, Spread<double>{photons, 1});
    };
    const auto from = photon({0.6, 0.3, 0.7, 0.4}), there = photon({0.65, 0.25, 0.7, 0.4}),
               turned = photon({0.6, 0.3, 0.72, 0.43});
    const EmissionFrame frame(from);
    REQUIRE(frame.is_of_area());
    CHECK(frame.is_regular());
    const AreaStep to_there = frame.step_to(EmissionFrame(there)), to_turned = frame.step_to(EmissionFrame(turned));
    // The directions are as apart as there is density of them, 1/π of the cosine.
    const double unit_of_place = radius / std::sqrt(photons),
                 unit_of_direction = std::sqrt(1 / (photons * std::abs(from.direction.z)));
    CHECK(std::hypot(to_there.position.x, to_there.position.y) ==
          doctest::Approx(length(there.position - from.position) / unit_of_place).epsilon(1e-9));
    CHECK(std::hypot(to_there.direction.x, to_there.direction.y) < 1e-9);
    CHECK(std::hypot(to_turned.position.x, to_turned.position.y) < 1e-9);
    const D change = turned.direction - from.direction, across = change - dot(change, from.direction) * from.direction;
    CHECK(std::hypot(to_turned.direction.x, to_turned.direction.y) ==
          doctest::Approx(length(across) / unit_of_direction).epsilon(1e-9));

    const DirectionalLight<D, double> sun(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = BoundingSphere<D>{{0, 0, 0}, 1}});
    CHECK(!EmissionFrame(photon_from(sun, 0.5, 0.5, 100)).is_of_area());
    CHECK(!EmissionFrame().is_of_area());
}

TEST_CASE("emission frame: finds the rotation of tangents about the ray") {
    const auto with = [](double angle, double scale) {
        const double c = scale * std::cos(angle), s = scale * std::sin(angle);
        return EmissionFrame(Photon<D, double>{
            {0, 0, 0}, {0, 0, -1}, 1, {Tangent<D>{{c, s, 0}, {c, s, 0}}, Tangent<D>{{-s, c, 0}, {-s, c, 0}}}});
    };
    for (const double angle : {0.0, 0.3, 2.0, -3.0}) {
        const PlaneMatrix turn = with(0.5, 1).rotation_of(with(0.5 + angle, 1.7)); // whatever their lengths
        check_close(turn.first, {std::cos(angle), std::sin(angle)}, 64 * epsilon);
        check_close(turn.second, {-std::sin(angle), std::cos(angle)}, 64 * epsilon);
    }
}

TEST_CASE("emission frame: tangents on a line are not regular") {
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

} // namespace nephroid::tests::emission_frame_test
