// SPDX-License-Identifier: MIT
#include "nephroid/estimate/second_order/roughness.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace nephroid;
using tests::Draws;

namespace {

const PathDerivatives map{{Space3{2, 0.3, 0}, Space3{-0.4, 1, 0.2}},
                          {Space3{0.1, 0, 0}, Space3{0, 0.2, 0.1}, Space3{-0.1, 0.05, 0}},
                          {Space3{0.01, 0, 0}, Space3{0, 0, 0.01}, Space3{0.02, 0, 0}, Space3{0, -0.01, 0}}};

[[nodiscard]] std::vector<TangentSample> photons_on(const PathDerivatives& path) {
    std::vector<TangentSample> photons;
    Draws draw(1);
    for (int i = 0; i < 16; ++i) {
        const Plane2 at{draw.in(-3, 3), draw.in(-3, 3)};
        photons.push_back({at, tangents_at(path, at)});
    }
    return photons;
}

} // namespace

TEST_CASE("roughness: photons on the map itself show none") {
    CHECK(roughness(map, photons_on(map)) <= 1e-24); // the square of rounding
    CHECK(roughness(map, {}) == 0);
    const auto one = photons_on(map);
    CHECK(roughness(map, std::span(one).first(1)) == 0);
}

// Two photons a step of 2 apart whose tangents are J (1 ± e): they differ by 2 e J, and J⁻¹ of that, by either one's own
// J, has |.|² of 2 (2 e / (1 ± e))², the lesser of which counts.
TEST_CASE("roughness: the jump between two photons by their distance") {
    const PathDerivatives straight{map.first, {}, {}};
    const double e = 0.1;
    const auto scaled = [&](double s) { return std::array<Space3, 2>{s * map.first[0], s * map.first[1]}; };
    const std::vector<TangentSample> photons{{{0, 1}, scaled(1 + e)}, {{2, 1}, scaled(1 - e)}};
    const double ratio = 2 * e / (1 + e);
    CHECK(roughness(straight, photons) == doctest::Approx(2 * ratio * ratio / 4).epsilon(1e-9));
}

TEST_CASE("roughness: no jump counts for more than so much") {
    std::vector<TangentSample> photons = photons_on(map);
    for (std::size_t i = 0; i < photons.size(); ++i)
        photons[i].tangents = {(i % 2 ? 1e6 : 1.0) * map.first[i % 2], (i % 3 ? -1e3 : 2.0) * map.first[1]};
    CHECK(roughness(map, photons) <= 0.15);
    photons[0].at = photons[1].at; // no distance to speak of
    CHECK(roughness(map, photons) <= 0.15);
}
