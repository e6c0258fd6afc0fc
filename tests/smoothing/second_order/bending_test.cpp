// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/bending.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::bending_test {

using namespace nephroid::detail;
using tests::Draws;

namespace {

using Second = std::array<Plane2, 3>;
using Third = std::array<Plane2, 4>;

constexpr double many = 1e15; // photons: the part of Q that the domain's size makes is nothing
constexpr std::array<Double3, 2> slanted{{{2, 0.5, 1}, {-0.3, 1, 0.2}}};

/// A map into space with derivatives J h and J t, h and t in emission coordinates.
[[nodiscard]] PathDerivatives map_of(const std::array<Double3, 2>& j, const Second& h, const Third& t = {}) {
    PathDerivatives map{j, {}, {}};
    for (std::size_t i = 0; i < 3; ++i)
        map.second[i] = h[i].x * j[0] + h[i].y * j[1];
    for (std::size_t i = 0; i < 4; ++i)
        map.third[i] = t[i].x * j[0] + t[i].y * j[1];
    return map;
}

[[nodiscard]] Plane2 any_vector(Draws& draw, double size) { return {draw.in(-size, size), draw.in(-size, size)}; }

[[nodiscard]] PathDerivatives any_map(Draws& draw) {
    Second h;
    Third t;
    for (Plane2& v : h)
        v = any_vector(draw, 0.02);
    for (Plane2& v : t)
        v = any_vector(draw, 0.001);
    return map_of(slanted, h, t);
}

/// B of a footprint L, from all entries of h and t by their definition.
[[nodiscard]] double size_by_definition(const PathDerivatives& map, const PlaneMatrix& l, double isotropic) {
    const detail::EmissionPullback pull_back(map.first);
    const PlaneMatrix back = l.inverse();
    const std::array<Plane2, 2> axes{l.first, l.second};
    const auto coordinate = [](Plane2 v, std::size_t i) { return i == 0 ? v.x : v.y; };
    double second2 = 0, third2 = 0;
    for (const Plane2 a : axes)
        for (const Plane2 b : axes) {
            Double3 h{};
            for (std::size_t i = 0; i < 2; ++i)
                for (std::size_t k = 0; k < 2; ++k)
                    h += (coordinate(a, i) * coordinate(b, k)) * map.second[i + k];
            const Plane2 v = back(pull_back(h));
            second2 += inner(v, v);
            for (const Plane2 c : axes) {
                Double3 t{};
                for (std::size_t i = 0; i < 2; ++i)
                    for (std::size_t k = 0; k < 2; ++k)
                        for (std::size_t m = 0; m < 2; ++m)
                            t += (coordinate(a, i) * coordinate(b, k) * coordinate(c, m)) * map.third[i + k + m];
                const Plane2 w = back(pull_back(t));
                third2 += inner(w, w);
            }
        }
    return second2 + 0.3 * std::sqrt(third2) + isotropic * (inner(l.first, l.first) + inner(l.second, l.second));
}

/// A shape of area 1, stretched by up to e² either way.
[[nodiscard]] PlaneMatrix any_shape(Draws& draw, double size) {
    return detail::stretching_matrix(any_vector(draw, size)) * detail::stretching_matrix(any_vector(draw, size));
}

[[nodiscard]] double traced(const Symmetric2& s, const Symmetric2& q) {
    return s.xx * q.xx + 2 * s.xy * q.xy + s.yy * q.yy;
}

} // namespace

TEST_CASE("bending: B is that of the derivatives in the footprint's own coordinates") {
    Draws draw(1);
    for (int i = 0; i < 100; ++i) {
        const PathDerivatives map = any_map(draw);
        const PlaneMatrix l = any_shape(draw, 0.5);
        const detail::BendingTerms bend(map, 1, 1e-4);
        CHECK(bend.rotated(l).total() == doctest::Approx(size_by_definition(map, l, 1e-4)).epsilon(1e-9));
    }
}

// Central differences: h² times a third derivative of some 27, and rounding over h.
TEST_CASE("bending: the slope is the gradient of log B") {
    Draws draw(2);
    constexpr double h = 1e-4;
    for (int i = 0; i < 100; ++i) {
        const detail::BendingTerms bend = detail::BendingTerms(any_map(draw), 1, 1e-4).rotated(any_shape(draw, 0.5));
        const auto log_size = [&](double p, double q) {
            return std::log(bend.rotated(detail::stretching_matrix({p, q})).total());
        };
        const Plane2 slope = bend.slope();
        CHECK(std::abs(slope.x - (log_size(h, 0) - log_size(-h, 0)) / (2 * h)) < 1e-6);
        CHECK(std::abs(slope.y - (log_size(0, h) - log_size(0, -h)) / (2 * h)) < 1e-6);
    }
}

TEST_CASE("bending: no shape of the same area bends less") {
    Draws draw(3);
    for (int i = 0; i < 100; ++i) {
        const PathDerivatives map = any_map(draw);
        const Symmetric2 q = bending(map, many);
        REQUIRE(q.determinant() > 0);
        // S = Q⁻¹ sqrt(det Q), which bends by 2 sqrt(det Q).
        const double root = std::sqrt(q.determinant());
        const Symmetric2 best = (1 / root) * Symmetric2{q.yy, -q.xy, q.xx};
        CHECK(traced(best, q) == doctest::Approx(2 * root));
        const double l00 = std::sqrt(best.xx), l10 = best.xy / l00;
        const PlaneMatrix l{{l00, l10}, {0, 1 / l00}};
        CHECK(size_by_definition(map, l, 0) == doctest::Approx(2 * root).epsilon(1e-6));
        for (int k = 0; k < 10; ++k)
            CHECK(size_by_definition(map, any_shape(draw, 1), 0) >= 2 * root * (1 - 1e-9));
    }
}

// The bias does not know which coordinates emission is described in. Neither does what a footprint bends by.
TEST_CASE("bending: other emission coordinates give the same footprint on the surface") {
    Draws draw(4);
    for (int i = 0; i < 100; ++i) {
        const PathDerivatives map = any_map(draw);
        const PlaneMatrix m = any_shape(draw, 0.4); // takes the new coordinates to the old
        PathDerivatives other = map;
        other.first = {m.first.x * map.first[0] + m.first.y * map.first[1],
                       m.second.x * map.first[0] + m.second.y * map.first[1]};
        other.second = rotated(map.second, m);
        const std::array<Plane2, 2> axes{m.first, m.second};
        for (std::size_t k = 0; k < 4; ++k) { // with k times the second axis
            const Plane2 a = axes[k > 2], b = axes[k > 1], c = axes[k > 0];
            const auto& t = map.third;
            other.third[k] =
                (a.x * b.x * c.x) * t[0] +
                ((a.x * b.x * c.y + a.x * b.y * c.x + a.y * b.x * c.x) * t[1] +
                 ((a.x * b.y * c.y + a.y * b.x * c.y + a.y * b.y * c.x) * t[2] + (a.y * b.y * c.y) * t[3]));
        }
        const Symmetric2 q = bending(map, many), p = bending(other, many);
        const Symmetric2 expected = congruent(m.transposed(), q);
        CHECK(std::abs(p.xx - expected.xx) <= 1e-5 * expected.trace());
        CHECK(std::abs(p.xy - expected.xy) <= 1e-5 * expected.trace());
        CHECK(std::abs(p.yy - expected.yy) <= 1e-5 * expected.trace());
    }
}

// x' = x + a x²/2, y' = y (1 + m x): m changes how wide the map is across with x, which bends what is long along x and
// not what is long along y. The measure that this one replaces counted it for both.
TEST_CASE("bending: a map that only widens lets footprints be long across") {
    const Symmetric2 q = bending(map_of(slanted, {{{0.01, 0}, {0, 0.01}, {0, 0}}}), many, 1, 0, 8);
    CHECK(std::abs(q.xy) <= 1e-5 * q.xx);
    CHECK(q.xx == doctest::Approx(64 * q.yy).epsilon(1e-6));
}

TEST_CASE("bending: B is limited to a photon's share") {
    const Second strong{{{20, -10}, {30, 15}, {-25, 5}}};
    const Third strongest{{{20, 0}, {0, 10}, {10, 10}, {0, 30}}};
    const auto size = [](const PathDerivatives& map, double share) {
        return detail::BendingTerms(map, share, 0).total();
    };
    CHECK(size(map_of(slanted, strong), 1) == doctest::Approx(1).epsilon(1e-9));
    CHECK(size(map_of(slanted, {}, strongest), 1) == doctest::Approx(0.3).epsilon(1e-9));
    CHECK(size(map_of(slanted, strong, strongest), 0.5) == doctest::Approx(0.65).epsilon(1e-9));
}

TEST_CASE("bending: on a straight map only the domain's size and the roughness count") {
    const Symmetric2 q = bending(map_of(slanted, {}), 1000, 1, 0.02);
    CHECK(q.xx == doctest::Approx(5 / (1000 * pi<double>)+0.01));
    CHECK(q.yy == doctest::Approx(q.xx));
    CHECK(std::abs(q.xy) <= 1e-15);
}

// At a fold J is singular: what sticks out of its image counts for nothing, the rest for as much as may be.
TEST_CASE("bending: it is finite at folds and points") {
    const std::array<Double3, 2> fold{{{1, 0, 0}, {1, 0, 0}}}, point{};
    for (const auto& first : {fold, point})
        for (const double stretch : {8.0, std::numeric_limits<double>::infinity()}) {
            const PathDerivatives map{first, {{{0.1, 0.3, 0}, {0, 0.1, 0}, {0.2, 0, 0.1}}}, {}};
            const Symmetric2 q = bending(map, 1000, 1, 0, stretch);
            CHECK(std::isfinite(q.trace()));
            CHECK(q.determinant() > 0);
            const Principal2 principal(q);
            CHECK(principal.larger <= square(stretch) * principal.smaller * (1 + 1e-6));
        }
}

} // namespace nephroid::tests::bending_test
