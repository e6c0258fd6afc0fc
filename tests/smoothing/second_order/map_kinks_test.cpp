// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/map_kinks.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace nephroid::tests::map_kinks_test {

using namespace nephroid::detail;
using tests::Draws;

namespace {

/// A photon of a map that is the identity, but for a kink along x = 0: beyond it the tangent along x is longer by a
/// part. The fit is the identity everywhere.
[[nodiscard]] TangentResidual photon_of_step(double x, double y, double part) {
    const double longer = x > 0 ? part : 0;
    return {{x, y, 0, 0}, {{{1 + longer, 0, 0}, {0, 1, 0}}}, {{{longer, 0, 0}, {0, 0, 0}}}};
}

/// What a jump counts for, by the longer tangent, as half of it is counted at 0.1.
[[nodiscard]] double counted(double part) {
    const double jump2 = square(part / (1 + part));
    return jump2 / (1 + square(jump2 / 0.1));
}

[[nodiscard]] MapKinks kinks_of(const std::vector<TangentResidual>& photons) {
    return map_kinks(tangent_jumps(photons));
}

} // namespace

// A square of 20 × 20 with a kink through its middle has 1/20 kinks per length, of which a step in any direction
// crosses 2/π. About 0.64/20 · 0.5 · 400 = 6 photons of a set have their nearest one across, mostly in pairs: 1000
// sets are off by 1/sqrt(3000) = 1.8%, three times that is 5.5%. Within half a step of the two ends of the kink,
// 1/20 of it, steps are the more along the border: by at most π/2, 3%. Four times as many photons a set have twice
// as many pairs across, so that 100 sets are off by 4.1%. Pairs closer than 0.1, π/100 of the photons per unit
// area, count on average for two thirds.
TEST_CASE("map kinks: their density is that of the lines across which tangents jump, however dense the photons are") {
    Draws draw(1);
    const double side = 20, part = 0.1;
    for (const double spacing : {1.0, 0.5}) {
        MapKinks all;
        const int sets = spacing < 1 ? 100 : 1000;
        for (int set = 0; set < sets; ++set) {
            std::vector<TangentResidual> photons;
            for (int i = 0; i < int(square(side / spacing)); ++i)
                photons.push_back(photon_of_step(draw.in(-side / 2, side / 2), draw.in(-side / 2, side / 2), part));
            all.add(kinks_of(photons), 1);
        }
        const double close = pi<double> / 100 / square(spacing);
        const double expected = (1 - close / 3) * counted(part) / side * 2 / pi<double>;
        CHECK(std::abs(all.density() / expected - 1) < (spacing < 1 ? 0.155 : 0.085));
    }
}

TEST_CASE("map kinks: a smooth map has none, nor have fewer than two photons") {
    std::vector<TangentResidual> photons;
    CHECK(kinks_of(photons).density() == 0);
    photons.push_back(photon_of_step(1, 2, 0.3));
    CHECK(kinks_of(photons).density() == 0);
    photons.push_back(photon_of_step(2, 3, 0.3)); // on the same side
    CHECK(kinks_of(photons).density() == 0);
    CHECK(kinks_of(photons).photons == 2);
}

TEST_CASE("map kinks: a pair counts by its jump over its distance, and the less the further it jumps beyond a third") {
    const auto of_pair = [](double part, double distance) {
        return kinks_of({photon_of_step(0, 0, part), photon_of_step(distance, 0, part)}).density();
    };
    for (const double part : {1e-3, 0.1, 0.5, 3.0})
        for (const double distance : {0.3, 1.0, 4.0})
            CHECK(of_pair(part, distance) == doctest::Approx(counted(part) / distance).epsilon(1e-12));
    CHECK(of_pair(0.1, 0.001) == doctest::Approx(counted(0.1) / 0.1).epsilon(1e-12)); // as if a tenth apart
    const double half = std::sqrt(0.1) / (1 - std::sqrt(0.1));                        // jumps by 0.1, squared
    CHECK(of_pair(half, 1) == doctest::Approx(0.05).epsilon(1e-12));
    CHECK(of_pair(1e200, 1) <= 0.1);
    std::vector<TangentResidual> apart{photon_of_step(0, 0, 0), photon_of_step(1, 0, 0)};
    apart[1].residual[0].x = std::numeric_limits<double>::infinity();
    CHECK(kinks_of(apart).density() == 0);
    CHECK(of_pair(0.1, 0) == 0); // photons in one point have no direction
}

TEST_CASE("map kinks: those of several cells add up by their photons") {
    MapKinks sum, two = kinks_of({photon_of_step(0, 0, 0.1), photon_of_step(1, 0, 0.1)}),
                  none = kinks_of({photon_of_step(1, 0, 0.1), photon_of_step(2, 0, 0.1)});
    sum.add(two, 3);
    sum.add(none, 1);
    CHECK(sum.density() == doctest::Approx(0.75 * two.density()).epsilon(1e-12));
}

} // namespace nephroid::tests::map_kinks_test
