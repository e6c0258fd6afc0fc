// SPDX-License-Identifier: MIT
#include "nephroid/differential/transfer.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::transfer_test {

using tests::derivative;
using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

// Rays fanned by the angle a from height h meet the floor at x = h tan a, so dx/da = h / cos² a. With F = |dx| + t
// |dω| = h / cos a the bound is that of the next test, in closed form.
TEST_CASE_TEMPLATE("transfer: a fan of rays from height h spreads by h over cos squared", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        for (const T angle : {T(0), T(0.3), T(-1.2), T(1.5)}) {
            const T h = 2, c = std::cos(angle), s = std::sin(angle), expected = h / (c * c);
            const V down = make_vector<V>(s, 0, -c);
            const auto flight = transfer(down, h / c, make_vector<V>(0, 0, 1));
            REQUIRE(flight.has_value());
            const Tangent<V> hit = (*flight)(Tangent<V>{zero_vector<V>(), make_vector<V>(c, 0, s)});
            const double tolerance = 8 * double(std::numeric_limits<T>::epsilon() * expected / c);
            CHECK(tests::distance(hit.d_position, Space{Wide(expected), 0, 0}) <= tolerance);
        }
    });
}

TEST_CASE_TEMPLATE("transfer: parallel rays spread by one over the cosine on a tilted plane and do not turn", T, float,
                   double) {
    tests::for_each_vector<T>([]<class V>() {
        // Down onto a plane that rises 4 over 3: a step of 3 along x is one of 5 along the slope, exactly.
        const auto flight = transfer(make_vector<V>(0, 0, -1), T(7), make_vector<V>(T(-4), 0, T(3)));
        REQUIRE(flight.has_value());
        const Tangent<V> hit = (*flight)(Tangent<V>{make_vector<V>(3, 0, 0), zero_vector<V>()});
        const double tolerance = 8 * 5 * double(std::numeric_limits<T>::epsilon());
        CHECK(tests::distance(hit.d_position, Space{3, 0, 4}) <= tolerance);
        CHECK(tests::distance(hit.d_direction, Space{0, 0, 0}) == 0);
    });
}

struct Event {
    Space position, direction, d_position, d_direction, normal;
    Wide distance;
};

template <class V>
Event drawn(Draws& draw, double least_cosine) {
    for (;;) {
        Event e{draw.in_cube(), draw.direction(), draw.in_cube(), draw.in_cube(), draw.direction(), draw.in(0.1, 9)};
        e.d_direction = e.d_direction.across(e.direction);
        // As the vector type rounds them; then unit and orthogonal again.
        const auto rounded = [](const Space& s) { return tests::widen(tests::narrow<V>(s)); };
        e.direction = rounded(e.direction).unit();
        e.d_position = rounded(e.d_position);
        e.d_direction = rounded(e.d_direction).across(e.direction);
        e.normal = rounded(e.normal);
        e.distance = static_cast<scalar_t<V>>(e.distance);
        if (abs(e.direction.dot(e.normal)) > Wide(least_cosine))
            return e;
    }
}

// With F = |dx| + t |dω| and the cosine c at the plane: dx + t dω rounds twice, 2 u F in halves u of epsilon, and the
// direction, a unit vector to 2 u, gives 2 u F; n · (dx + t dω) / (n · ω) multiplies these by 1/c, adds 5 u F/c for
// its own roundings, and 5 u F/c² for n · ω, off by 5 u; one rounding of the sum. In all (4 + 9/c + 5/c² + 1) u F <
// 10 epsilon F / c². The difference: x(p) has its singularity where the ray becomes parallel, farther than c / 8 for
// |dω| <= sqrt 3.
TEST_CASE_TEMPLATE("transfer: is the derivative of where a ray meets a tilted plane", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(41);
        for (int i = 0; i < 100; ++i) {
            const Event e = drawn<V>(draw, 0.05);
            const Space hit = e.position + e.distance * e.direction;
            const Space expected = derivative([&](const Wide& p) {
                return tests::on_plane(e.position + p * e.d_position, (e.direction + p * e.d_direction).unit(), hit,
                                       e.normal);
            });
            const auto flight =
                transfer(tests::narrow<V>(e.direction), static_cast<T>(e.distance), tests::narrow<V>(e.normal));
            REQUIRE(flight.has_value());
            const Tangent<V> before{tests::narrow<V>(e.d_position), tests::narrow<V>(e.d_direction)};
            const Tangent<V> found = (*flight)(before);

            const double c = std::abs(double(e.direction.dot(e.normal)));
            const double f = tests::magnitude(e.d_position) + double(e.distance) * tests::magnitude(e.d_direction);
            const double epsilon = double(std::numeric_limits<T>::epsilon());
            CHECK(tests::distance(found.d_position, expected) <=
                  10 * epsilon * f / (c * c) + tests::derivative_error(c / 8) * (tests::magnitude(hit) + f / c));
            CHECK(tests::distance(found.d_direction, tests::widen(before.d_direction)) == 0);
            // In the plane: the correction's own error is along ω, so n sees it times c; the sum rounds.
            CHECK(std::abs(double(tests::widen(found.d_position).dot(e.normal))) <= 10 * epsilon * f / c);
        }
    });
}

// Negating the normal, or doubling it, changes no rounding.
TEST_CASE_TEMPLATE("transfer: the side and the length of the normal do not matter", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(42);
        for (int i = 0; i < 50; ++i) {
            const Event e = drawn<V>(draw, 0.05);
            const V direction = tests::narrow<V>(e.direction);
            const Tangent<V> before{tests::narrow<V>(e.d_position), tests::narrow<V>(e.d_direction)};
            const auto after = [&](double scale) {
                const auto flight =
                    transfer(direction, static_cast<T>(e.distance), tests::narrow<V>(Wide(scale) * e.normal));
                REQUIRE(flight.has_value());
                return tests::widen((*flight)(before).d_position);
            };
            CHECK((after(-1) - after(1)).length() == Wide(0));
            CHECK((after(1024) - after(1)).length() == Wide(0));
        }
    });
}

TEST_CASE_TEMPLATE("transfer: a ray parallel to the plane has no footprint there", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        CHECK(!transfer(make_vector<V>(1, 0, 0), T(1), make_vector<V>(0, 0, 1)).has_value());
        CHECK(!transfer(make_vector<V>(0, -1, 0), T(1), make_vector<V>(0, 0, -5)).has_value());
        CHECK(!transfer(make_vector<V>(0, 0, 1), T(0), make_vector<V>(3, 4, 0)).has_value());
        CHECK(!transfer(make_vector<V>(1, 0, 0), T(1), make_vector<V>(0, 0, 0)).has_value()); // no plane at all
    });
    if constexpr (std::is_floating_point_v<T>) { // so nearly parallel that the inverse overflows
        const T least = std::numeric_limits<T>::denorm_min();
        CHECK(!transfer(foreign::Plain<T>{1, 0, least}, T(1), {0, 0, 1}).has_value());
    }
}

TEST_CASE_TEMPLATE("transfer: over no distance onto a plane across the ray only removes the part along the ray", T,
                   float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const auto flight = transfer(make_vector<V>(0, 0, 1), T(0), make_vector<V>(0, 0, -1));
        REQUIRE(flight.has_value());
        const Tangent<V> hit = (*flight)(Tangent<V>{make_vector<V>(1, 2, 3), make_vector<V>(4, 5, 0)});
        CHECK(tests::distance(hit.d_position, Space{1, 2, 0}) == 0);
        CHECK(tests::distance(hit.d_direction, Space{4, 5, 0}) == 0);
    });
}

} // namespace

} // namespace nephroid::tests::transfer_test
