// SPDX-License-Identifier: MIT
#include "nephroid/differential/reflection.hpp"

#include "nephroid/differential/transfer.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::reflection_test {

using tests::derivative;
using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

template <class T>
double epsilon() {
    return double(std::numeric_limits<T>::epsilon());
}

/// A unit vector and its derivative, as the vector type V rounds them, then unit and orthogonal again.
template <class V>
struct Turning {
    Space at, slope;

    explicit Turning(Draws& draw)
        : at(tests::widen(tests::narrow<V>(draw.direction())).unit()),
          slope(tests::widen(tests::narrow<V>(draw.in_cube().across(at))).across(at)) {}
    Space operator()(const Wide& p) const { return (at + p * slope).unit(); }
};

// u: half an epsilon. ω and n are unit to 2 u, so ω − 2 (ω·n) n is off by up to (1 + 2 · 3) · 2 u from them,
// and 5 u for ω·n, times 2, and 4 u for the rest: 28 u = 14 epsilon.
TEST_CASE_TEMPLATE("reflection: sends a ray to the mirror image of where it came from", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(51);
        for (int i = 0; i < 100; ++i) {
            const Turning<V> ray(draw), normal(draw);
            const Reflection<V> found(tests::narrow<V>(ray.at), tests::narrow<V>(normal.at));
            CHECK(tests::distance(found.direction(), tests::mirrored(ray.at, normal.at)) <= 14 * epsilon<T>());
        }
    });
}

// The formula's terms are at most M = 3 |dω| + 4 |dn| in all. In halves u of epsilon: dot products 3 each, doubled and
// summed 5, times n 6, plus the rest 8; the last projection 5; ω, n unit to 2 u, which occur up to twice in a term, 8;
// dω, dn orthogonal to 2 u, 4. 25 u M < 16 epsilon M. The difference: unit vectors at + p · slope are analytic for
// |p| < 1 / |slope|.
TEST_CASE_TEMPLATE("reflection: differentiates as differences do", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(52);
        for (int i = 0; i < 100; ++i) {
            const Turning<V> ray(draw), normal(draw);
            const Reflection<V> reflection(tests::narrow<V>(ray.at), tests::narrow<V>(normal.at));
            const V found = reflection.differentiate(tests::narrow<V>(ray.slope), tests::narrow<V>(normal.slope));
            const Space expected = derivative([&](const Wide& p) { return tests::mirrored(ray(p), normal(p)); });
            const double m = 3 * tests::magnitude(ray.slope) + 4 * tests::magnitude(normal.slope);
            CHECK(tests::distance(found, expected) <= 16 * epsilon<T>() * m + 5 * tests::derivative_error(0.5));
            // Orthogonal: the projection leaves 5 u of what it removed, and 4 u since ω' is unit to 14 epsilon only.
            const Space direction = tests::widen(reflection.direction());
            CHECK(std::abs(double(tests::widen(found).dot(direction))) <= 32 * epsilon<T>() * m);
        }
    });
}

// The mirror image of the ray itself is the reflected ray, and nothing of that stays: both unit to 14 epsilon, and 5
// roundings.
TEST_CASE_TEMPLATE("reflection: what rounding has put along the ray does not stay", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(54);
        for (int i = 0; i < 100; ++i) {
            const Turning<V> ray(draw), normal(draw);
            const V direction = tests::narrow<V>(ray.at);
            const Reflection<V> mirror(direction, tests::narrow<V>(normal.at));
            CHECK(tests::magnitude(tests::widen(mirror.differentiate(direction, zero_vector<V>()))) <=
                  40 * epsilon<T>());
        }
    });
}

// The mirror image of a tangent is what a flat mirror makes of it: same length, and twice mirrored is itself.
TEST_CASE_TEMPLATE("reflection: a flat mirror mirrors the tangent", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const Reflection<V> mirror(make_vector<V>(T(0.6), 0, T(-0.8)), make_vector<V>(0, 0, 1));
        CHECK(tests::distance(mirror.direction(), Space{Wide(T(0.6)), 0, Wide(T(0.8))}) <= 2 * epsilon<T>());
        const V found = mirror.differentiate(make_vector<V>(T(0.8), 2, T(0.6)), zero_vector<V>());
        CHECK(tests::distance(found, Space{Wide(T(0.8)), 2, Wide(T(-0.6))}) <= 16 * epsilon<T>() * 3 * std::sqrt(5.0));
    });
}

// A beam parallel to the axis of a spherical mirror of radius R, at the height y = R sin a: it turns by 2 a, so dω'/dy
// is 2 / (R cos a) along the reflected circle, and neighbouring rays meet at the distance (R/2) cos a: the caustic (for
// a = 0 the focus). Bound: M = 4 |dn| = 4 / (R cos a), and the angle's rounding.
TEST_CASE_TEMPLATE("reflection: a concave mirror of radius R focuses at half of R cos a", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const T radius = T(2.5);
        for (const T angle : {T(0), T(0.25), T(1), T(1.4)}) {
            const T c = std::cos(angle), s = std::sin(angle);
            const V normal = make_vector<V>(0, -s, -c); // inwards, at the point R (0, s, c) of the mirror
            const V direction = make_vector<V>(0, 0, 1);
            const auto arrival = transfer(direction, T(1), normal);
            REQUIRE(arrival.has_value());
            const Tangent<V> hit = (*arrival)(Tangent<V>{make_vector<V>(0, 1, 0), zero_vector<V>()});
            const V d_normal = make_vector<V>(-vector_traits<V>::x(hit.d_position) / radius,
                                              -vector_traits<V>::y(hit.d_position) / radius,
                                              -vector_traits<V>::z(hit.d_position) / radius);
            const Reflection<V> mirror(direction, normal);
            const V found = mirror.differentiate(zero_vector<V>(), d_normal);

            const Wide wc = c, ws = s, rate = Wide(2) / (Wide(radius) * wc);
            const Space expected =
                rate * Space{0, Wide(1) - Wide(2) * wc * wc, Wide(2) * ws * wc}; // d/da (−sin 2a, −cos 2a) / 2
            const double tolerance = (16 + 16) * epsilon<T>() * 4 / double(radius * c * c);
            CHECK(tests::distance(found, expected) <= tolerance);

            const auto to_focus = transfer(mirror.direction(), T(0.5) * radius * c, mirror.direction());
            REQUIRE(to_focus.has_value());
            const Tangent<V> focus = (*to_focus)(Tangent<V>{hit.d_position, found});
            CHECK(tests::distance(focus.d_position, Space{0, 0, 0}) <= tolerance * double(radius));
        }
    });
}

// Every rounding is the same but for its sign.
TEST_CASE_TEMPLATE("reflection: turning the normal round and its derivative with it changes nothing", T, float,
                   double) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(53);
        for (int i = 0; i < 50; ++i) {
            const Turning<V> ray(draw), normal(draw);
            const V direction = tests::narrow<V>(ray.at), slope = tests::narrow<V>(ray.slope);
            const auto by = [&](double side) {
                const Reflection<V> mirror(direction, tests::narrow<V>(Wide(side) * normal.at));
                return tests::widen(mirror.differentiate(slope, tests::narrow<V>(Wide(side) * normal.slope)));
            };
            CHECK((by(1) - by(-1)).length() == Wide(0));
        }
    });
}

TEST_CASE_TEMPLATE("reflection: turning only the derivative of the normal round is another surface", T, float, double) {
    using V = foreign::Plain<T>;
    const Reflection<V> mirror(V{0, 0, -1}, V{0, 0, 1});
    CHECK(tests::distance(mirror.differentiate(V{0, 0, 0}, V{1, 0, 0}), Space{2, 0, 0}) == 0);
    CHECK(tests::distance(mirror.differentiate(V{0, 0, 0}, V{-1, 0, 0}), Space{-2, 0, 0}) == 0);
}

} // namespace

} // namespace nephroid::tests::reflection_test
