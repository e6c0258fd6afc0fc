// SPDX-License-Identifier: MIT
#include "nephroid/footprint/beam.hpp"

#include "nephroid/differential/transfer.hpp"
#include "nephroid/footprint/kernel.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::beam_test {

using tests::Draws;

namespace {

template <class V>
V somewhere(Draws& draw) {
    using T = scalar_t<V>;
    const double x = draw.in(-1, 1), y = draw.in(-1, 1), z = draw.in(-1, 1);
    return V(T(x), T(y), T(z));
}

template <class V>
Beam<V> some_beam(Draws& draw, double filter) {
    using T = scalar_t<V>;
    const V direction = normalize(somewhere<V>(draw)), origin = somewhere<V>(draw);
    PhotonDifferential<V, 2> tangents;
    for (Tangent<V>& tangent : tangents)
        tangent = {somewhere<V>(draw), somewhere<V>(draw)};
    return beam_of(origin, direction, tangents, T(1), T(filter));
}

} // namespace

// The oracle is the ellipse with a disk added, by its own matrix: r² = |M q|². That inverts the area, so that where
// it cancels it is worse than the sum of squares; with a filter of 0.3 conditions are below 100.
TEST_CASE("beam: at each depth it is the ellipse of the tangents there, with the filter's disk added") {
    using V = glm::dvec3;
    Draws draw(11);
    for (int round = 0; round < 2000; ++round) {
        const Beam<V> beam = some_beam<V>(draw, 0.3);
        const double t = draw.in(0, 2);
        const auto axis = [&](int i) {
            const std::size_t k = std::size_t(i);
            return V((beam.start[k][0] + t * beam.growth[k][0]) * beam.frame.u +
                     (beam.start[k][1] + t * beam.growth[k][1]) * beam.frame.v);
        };
        const Ellipse<V> filtered = add_disk(Ellipse<V>{axis(0), axis(1), beam.direction}, 0.3);
        const FilterMatrix<V> matrix = filter_matrix(filtered);
        const double x = draw.in(-1, 1), y = draw.in(-1, 1);
        const V q = x * beam.frame.u + y * beam.frame.v;
        const double expected = square(dot(matrix.row_a, q)) + square(dot(matrix.row_b, q));
        const auto at = beam.at(t);
        REQUIRE(beam.radius2(at, x, y) == doctest::Approx(expected).epsilon(1e-10));
        REQUIRE(std::sqrt(at.determinant) == doctest::Approx(std::abs(area_scale(filtered))).epsilon(1e-10));
        REQUIRE(beam.largest_radius(t) == doctest::Approx(radii(filtered).major).epsilon(1e-10));
    }
}

// A plane across the ray: transfer moves the tangents there, without the beam's formula.
TEST_CASE("beam: its semi-axes are half of the tangents that transfer carries to a plane across it") {
    using V = glm::dvec3;
    Draws draw(12);
    for (int round = 0; round < 200; ++round) {
        const V direction = normalize(somewhere<V>(draw));
        PhotonDifferential<V, 2> tangents;
        for (Tangent<V>& tangent : tangents) {
            const V d = somewhere<V>(draw);
            tangent = {somewhere<V>(draw), d - dot(d, direction) * direction};
        }
        const Beam<V> beam = beam_of(V(0, 0, 0), direction, tangents);
        const double t = draw.in(0, 3);
        const auto moved = transfer(direction, t, direction);
        REQUIRE(moved.has_value());
        for (std::size_t i = 0; i < 2; ++i) {
            const V axis = (beam.start[i][0] + t * beam.growth[i][0]) * beam.frame.u +
                           (beam.start[i][1] + t * beam.growth[i][1]) * beam.frame.v;
            const V d = 0.5 * (*moved)(tangents[i]).d_position - axis;
            CHECK(length(d) < 1e-13);
        }
    }
}

// Norms are rounded to a few epsilon.
TEST_CASE_TEMPLATE("beam: its radius lies nowhere above the line between two depths, converging ones included", T,
                   float, double) {
    using V = glm::vec<3, T>;
    Draws draw(13);
    int converging = 0;
    for (int round = 0; round < 5000; ++round) {
        const Beam<V> beam = some_beam<V>(draw, round % 2 == 0 ? 0 : 0.1);
        const T end = T(draw.in(0, 3)), share = T(draw.in(0, 1));
        const T first = beam.largest_radius(0), last = beam.largest_radius(end);
        converging += last < first;
        REQUIRE(beam.largest_radius(share * end) <=
                ((1 - share) * first + share * last) * (1 + 16 * std::numeric_limits<T>::epsilon()));
    }
    CHECK(converging > 300);
}

// ∫ k(r²)/√D over the plane is 1: a lattice of 400² points over twice the radius. The biweight's second
// derivative is bounded, so that the lattice errs by less than 1e-3 of a footprint 40 cells wide.
TEST_CASE("beam: its kernel spreads all flux over the plane at any depth, at a focus too") {
    using V = glm::dvec3;
    // Both semi-axes are parallel at t = 1: without the filter it would be a line.
    const PhotonDifferential<V, 2> tangents{Tangent<V>{V(2, 0, 0), V(-1, 0, 0)}, Tangent<V>{V(0, 1, 0), V(0, -1, 0)}};
    const Beam<V> beam = beam_of(V(0, 0, 0), V(0, 0, 1), tangents, 1.0, 0.2);
    for (const double t : {0.0, 0.7, 1.0, 2.0, 2.5}) {
        const auto at = beam.at(t);
        const double half = 1.05 * beam.largest_radius(t), step = 2 * half / 400;
        double sum = 0;
        for (int i = 0; i < 400; ++i)
            for (int j = 0; j < 400; ++j)
                sum += BiweightKernel{}(beam.radius2(at, -half + (i + 0.5) * step, -half + (j + 0.5) * step));
        CHECK(sum * step * step / std::sqrt(at.determinant) == doctest::Approx(1).epsilon(2e-3));
    }
}

TEST_CASE("beam: a cone has the radius r0 + r1 t at depth t") {
    using V = glm::dvec3;
    const Beam<V> cone = cone_beam(V(1, 2, 3), normalize(V(1, 1, 0)), 0.1, -0.02);
    for (const double t : {0.0, 1.0, 4.0}) {
        const double radius = 0.1 - 0.02 * t;
        CHECK(cone.largest_radius(t) == doctest::Approx(radius).epsilon(1e-14));
        CHECK(cone.radius2(cone.at(t), 0.6 * radius, 0.8 * radius) == doctest::Approx(1).epsilon(1e-13));
        CHECK(std::sqrt(cone.at(t).determinant) == doctest::Approx(radius * radius).epsilon(1e-13));
    }
}

} // namespace nephroid::tests::beam_test
