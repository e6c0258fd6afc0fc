// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/landings.hpp"

#include "smoothing/second_order/maps.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::landings_test {

using namespace nephroid::detail;

namespace {

/// Steps of a lattice around the point, 1 apart.
template <class Visit>
void for_each_step(Visit&& visit) {
    for (int y = -3; y <= 3; ++y)
        for (int x = -3; x <= 3; ++x)
            visit(Plane2{double(x), double(y)});
}

/// With the tangents that a map gives them.
template <class PlaceOf>
[[nodiscard]] Landings landings_of(const PathDerivatives& map, const PlaceOf& place_of) {
    Landings landings;
    for_each_step([&](Plane2 at) { landings.add(at, place_of(at), tangents_at(map, at), 1); });
    return landings;
}

/// The unit square stays what it is.
[[nodiscard]] PathDerivatives identity() { return {{{{1, 0, 0}, {0, 1, 0}}}, {}, {}}; }

} // namespace

// F = (u + u²/2 − u v² / 2 + v³/6, v + u v + u³/6, 5): its derivatives at 0 are written down by hand.
TEST_CASE("landings: a cubic map predicts where its photons land, wherever it begins") {
    const PathDerivatives map{
        {{{1, 0, 0}, {0, 1, 0}}}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 0}}}, {{{0, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {1, 0, 0}}}};
    for (const double far_away : {0.0, 5.0}) {
        const auto place = [&](Plane2 at) {
            const double u = at.x, v = at.y;
            return Double3{u + u * u / 2 - u * v * v / 2 + v * v * v / 6 + far_away, v + u * v + u * u * u / 6, 5};
        };
        CHECK(!landings_of(map, place).contradict(map, 1e-9));
        PathDerivatives wrong = map;
        wrong.third[1].x = 1;
        CHECK(landings_of(wrong, place).contradict(wrong, 0.1));
    }
}

// A fold: F = (u²/2, v). At u = 0 a step along u goes nowhere, and is still predicted.
TEST_CASE("landings: a fold contradicts nothing") {
    const PathDerivatives map{{{{0, 0, 0}, {0, 1, 0}}}, {{{1, 0, 0}, {0, 0, 0}, {0, 0, 0}}}, {}};
    CHECK(!landings_of(map, [](Plane2 at) { return Double3{at.x * at.x / 2, at.y, 0}; }).contradict(map, 1e-9));
}

// Photons with x > 0 jump by g along y: of 49, n = 21 do. The mean square of what the place in the middle does not
// explain is g² n (49 − n) / 49², and that of the distances is 8.
TEST_CASE("landings: two facets contradict tangents that are the same on both, by how far they part") {
    for (const double gap : {0.1, 1.0, 10.0}) {
        const Landings landings = landings_of(identity(), [&](Plane2 at) {
            return Double3{at.x, at.y + (at.x > 0 ? gap : 0), 0};
        });
        const double part = gap * std::sqrt(21.0 * 28) / 49 / std::sqrt(8.0);
        CHECK(landings.contradict(identity(), 0.999 * part));
        CHECK(!landings.contradict(identity(), 1.001 * part));
        CHECK(!landings.contradict(identity(), std::numeric_limits<double>::infinity()));
    }
}

// Tangents that are off by e at every photon, to this side and that, lead a step of length d at most e d astray. Twice
// that is let pass: of a facet whose part is p, tangents off by more than p / 2 say themselves that the map is rough.
TEST_CASE("landings: a miss that the tangents' scatter explains is no contradiction") {
    const double gap = 1, part = gap * std::sqrt(21.0 * 28) / 49 / std::sqrt(8.0);
    for (const double times : {0.49, 0.51}) {
        Landings landings;
        int n = 0;
        for_each_step([&](Plane2 at) {
            const double off = ++n % 2 == 0 ? times * part : -times * part;
            landings.add(at, {at.x, at.y + (at.x > 0 ? gap : 0), 0}, {{{1, off, 0}, {0, 1, off}}}, 1);
        });
        CHECK(landings.contradict(identity(), 0.5 * part) == (times < 0.5));
    }
}

TEST_CASE("landings: rounded places contradict nothing, and places that are no numbers do") {
    const auto rounded = [](Plane2 at) { // to floats, as far from the origin as 10⁵ photons' distances
        return Double3{double(float(1e5 + at.x)), double(float(1e5 + at.y)), 0};
    };
    CHECK(!landings_of(identity(), rounded).contradict(identity(), 1e-9));
    const auto broken = [](Plane2 at) { return Double3{at.x, std::numeric_limits<double>::quiet_NaN(), 0}; };
    CHECK(landings_of(identity(), broken).contradict(identity(), 0.1));
    CHECK(!Landings{}.contradict(identity(), 0));
}

} // namespace nephroid::tests::landings_test
