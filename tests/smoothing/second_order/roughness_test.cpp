// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/roughness.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::roughness_test {

using namespace nephroid::detail;
using tests::Draws;

namespace {

const PathDerivatives map{{Double3{2, 0.3, 0}, Double3{-0.4, 1, 0.2}},
                          {Double3{0.1, 0, 0}, Double3{0, 0.2, 0.1}, Double3{-0.1, 0.05, 0}},
                          {Double3{0.01, 0, 0}, Double3{0, 0, 0.01}, Double3{0.02, 0, 0}, Double3{0, -0.01, 0}}};

using Tangents = std::array<Double3, 2>;

[[nodiscard]] TangentResidual residual(Plane2 at, const Tangents& tangents, const PathDerivatives& of) {
    const auto fitted = tangents_at(of, at);
    return {{at.x, at.y, 0, 0}, tangents, {tangents[0] - fitted[0], tangents[1] - fitted[1]}};
}

[[nodiscard]] std::vector<TangentResidual> photons_on(const PathDerivatives& path) {
    std::vector<TangentResidual> photons;
    Draws draw(1);
    for (int i = 0; i < 16; ++i) {
        const Plane2 at{draw.in(-3, 3), draw.in(-3, 3)};
        photons.push_back(residual(at, tangents_at(path, at), path));
    }
    return photons;
}

[[nodiscard]] double roughness_of(const std::vector<TangentResidual>& photons) {
    return roughness(tangent_jumps(photons));
}

} // namespace

// Along a line of the map: J + H d + T d d / 2, by hand.
TEST_CASE("roughness: the tangents of a map follow its derivatives") {
    const double d = 0.7;
    const auto along_u = tangents_at(map, {d, 0}), along_v = tangents_at(map, {0, d});
    const auto check = [](const Double3& a, const Double3& b) { CHECK(inner(a - b, a - b) <= 1e-28); };
    check(along_u[0], map.first[0] + (d * map.second[0] + (0.5 * d * d) * map.third[0]));
    check(along_u[1], map.first[1] + (d * map.second[1] + (0.5 * d * d) * map.third[1]));
    check(along_v[0], map.first[0] + (d * map.second[1] + (0.5 * d * d) * map.third[2]));
    check(along_v[1], map.first[1] + (d * map.second[2] + (0.5 * d * d) * map.third[3]));
}

TEST_CASE("roughness: photons on the map itself show none") {
    CHECK(roughness_of(photons_on(map)) == 0);
    CHECK(roughness_of({}) == 0);
    const auto one = photons_on(map);
    CHECK(roughness_of({one[0]}) == 0);
}

// Two photons a step of 2 apart whose tangents are J (1 ± e): they differ by 2 e J, and J⁻¹ of that, by either
// one's own J, has |.|² of 2 (2 e / (1 ± e))², the lesser of which counts.
TEST_CASE("roughness: it is the jump between two photons over their distance") {
    const PathDerivatives straight{map.first, {}, {}};
    const double e = 0.1;
    const auto scaled = [&](double s) { return Tangents{s * map.first[0], s * map.first[1]}; };
    const double ratio = 2 * e / (1 + e);
    std::vector<TangentResidual> photons{residual({0, 1}, scaled(1 + e), straight),
                                         residual({2, 1}, scaled(1 - e), straight)};
    CHECK(roughness_of(photons) == doctest::Approx(2 * ratio * ratio / 4).epsilon(1e-9));
    photons[1].at[3] = 2; // apart in the light's other coordinates too
    CHECK(roughness_of(photons) == doctest::Approx(2 * ratio * ratio / 8).epsilon(1e-9));
}

TEST_CASE("roughness: each jump counts for at most the limit") {
    std::vector<TangentResidual> photons = photons_on(map);
    for (std::size_t i = 0; i < photons.size(); ++i)
        photons[i] = residual({photons[i].at[0], photons[i].at[1]},
                              {(i % 2 ? 1.0 : -1.0) * map.first[0], (i % 2 ? 1.0 : -1.0) * map.first[1]}, map);
    CHECK(roughness_of(photons) > 0.01);
    CHECK(roughness_of(photons) <= 0.15);
    photons[0].at = photons[1].at; // no distance to speak of
    CHECK(roughness_of(photons) <= 0.15);
}

} // namespace nephroid::tests::roughness_test
