// SPDX-License-Identifier: MIT
#include "nephroid/receiver/pixel_footprint.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::pixel_footprint_test {

using tests::Space;
using tests::Wide;

// u* · u = 1, u* · v = 0, and both lie in the plane. A dual vector is as long as the height is short: relative to its
// length and the sides' it is as exact as the products of the wider scalar, which for float are exact; for double the
// cross product's components are, and the rest is a few roundings.
TEST_CASE_TEMPLATE("pixel footprint: the rows are the dual basis of the sides however thin it is", T, float, double) {
    using V = glm::vec<3, T>;
    tests::Draws draw(91);
    for (int round = 0; round < 2000; ++round) {
        const Space along = draw.direction(), across = draw.direction();
        const Wide thin(std::exp2(-draw.in(0, 12))), size(std::exp2(draw.in(-20, 20)));
        const PixelFootprint<V> footprint{tests::narrow<V>(size * along),
                                          tests::narrow<V>(size * (Wide(draw.in(-1, 1)) * along + thin * across))};
        const FootprintRows<V> rows = detail::rows_of(footprint);
        const Space u = tests::widen(footprint.u), v = tests::widen(footprint.v);
        const Space ru = tests::widen(rows.u), rv = tests::widen(rows.v), n = u.cross(v);
        // Each rounded vector is off by half an epsilon of its components; 16 of them cover the sums.
        const double eps = 16 * double(std::numeric_limits<T>::epsilon());
        const auto near = [&](const Space& a, const Space& b, double expected) {
            const double tolerance = eps * tests::magnitude(a) * tests::magnitude(b);
            return std::abs(static_cast<double>(a.dot(b)) - expected) <= tolerance;
        };
        REQUIRE(near(ru, u, 1));
        REQUIRE(near(ru, v, 0));
        REQUIRE(near(rv, u, 0));
        REQUIRE(near(rv, v, 1));
        REQUIRE(near(ru, n, 0));
        REQUIRE(near(rv, n, 0));
        REQUIRE(std::abs(double(rows.inverse_area) * tests::magnitude(n) - 1) <= eps);
    }
}

TEST_CASE_TEMPLATE("pixel footprint: the rows of a square are its frame over its side", T, float, double) {
    using V = glm::vec<3, T>;
    const V normal(T(0.6), 0, T(0.8));
    const FootprintRows<V> rows = detail::square_rows(normal, T(0.25));
    const T tolerance = 16 * std::numeric_limits<T>::epsilon();
    CHECK(rows.inverse_area == 16);
    CHECK(std::abs(length(rows.u) - 4) <= 4 * tolerance);
    CHECK(std::abs(dot(rows.u, rows.v)) <= 16 * tolerance);
    CHECK(std::abs(dot(rows.u, normal)) <= 4 * tolerance);
    CHECK(std::abs(dot(rows.v, normal)) <= 4 * tolerance);
    CHECK(detail::square_rows(normal, T(0)).inverse_area == 0); // no spacing, no light
}

// A ray from height h at the angle a meets the floor at h tan a, on a slope of angle s at h / (cos a (sin s + cos s /
// tan a))... here by the reference's own intersection in wide precision.
TEST_CASE_TEMPLATE("pixel footprint: footprints from rays are a plane's section of the pixel's pyramid", T, float,
                   double) {
    using V = glm::vec<3, T>;
    tests::Draws draw(92);
    int behind = 0;
    for (int round = 0; round < 500; ++round) {
        const V eye = tests::narrow<V>(draw.in_cube()), normal = tests::narrow<V>(draw.direction());
        const V position = eye + T(draw.in(2, 10)) * tests::narrow<V>(draw.direction());
        const T pixel = T(0.001);
        const V forward = normalize(V(position - eye));
        const Frame<V> film = frame_about(forward);
        const auto ray = [&](T x, T y) {
            return PixelRay<V>{eye, V(forward + pixel * x * film.u + pixel * y * film.v)};
        };
        const PixelRay<V> left = ray(T(-0.5), 0), right = ray(T(0.5), 0), below = ray(0, T(-0.5)),
                          above = ray(0, T(0.5));
        const auto footprint = footprint_from_rays(position, normal, left, right, below, above);
        const double cosine = std::abs(double(dot(forward, normal)));
        if (cosine < 0.01) { // the horizon runs through the pixel, or nearly
            behind += detail::is_unknown(footprint);
            continue;
        }
        const auto met = [&](const PixelRay<V>& r) {
            return tests::on_plane(tests::widen(r.origin), tests::widen(r.direction), tests::widen(position),
                                   tests::widen(normal));
        };
        // Places are worked out in the wider scalar: for double with a few roundings of the distance, some 1 / cosine
        // along the plane; the sides are rounded.
        const double eps = double(std::numeric_limits<T>::epsilon());
        const Space u = met(right) - met(left), v = met(above) - met(below);
        const double tolerance = 32 * eps * (std::is_same_v<T, double> ? 20 / cosine : tests::magnitude(u + v) + 0.01);
        CHECK(tests::distance(footprint.u, u) <= tolerance);
        CHECK(tests::distance(footprint.v, v) <= tolerance);
    }
    CHECK(behind < 10);
}

TEST_CASE("pixel footprint: it is unknown if a ray passes the horizon") {
    using V = glm::vec3;
    const V eye(0, 0, 1);
    const auto ray = [&](float x, float z) { return PixelRay<V>{eye, V(x, 1, z)}; };
    const auto seen = footprint_from_rays(V(0, 100, 0), V(0, 0, 1), ray(-0.01f, -0.01f), ray(0.01f, -0.01f),
                                          ray(0, -0.011f), ray(0, -0.009f));
    CHECK(!detail::is_unknown(seen));
    const auto horizon = footprint_from_rays(V(0, 100, 0), V(0, 0, 1), ray(-0.01f, -0.01f), ray(0.01f, -0.01f),
                                             ray(0, -0.02f), ray(0, 0.001f));
    CHECK(detail::is_unknown(horizon));
    const auto along = footprint_from_rays(V(0, 100, 0), V(0, 0, 1), ray(-0.01f, -0.01f), ray(0.01f, -0.01f),
                                           ray(0, -0.02f), ray(0, 0));
    CHECK(detail::is_unknown(along));
}

} // namespace nephroid::tests::pixel_footprint_test
