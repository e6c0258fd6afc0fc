// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/group_fit.hpp"

#include "smoothing/second_order/fields.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::group_fit_test {

using namespace fields;

using namespace nephroid::detail;

TEST_CASE("group fit: a quadratic map's second derivatives are the same everywhere") {
    for (const bool given : {false, true}) {
        FieldOptions options = stratified();
        if (given)
            options.smoothing = 7;
        const Field field = field_of(quadratic, options);
        const double u02 = unit_of(all) * unit_of(all);
        for (const double u : {0.01, 0.3, 0.5, 0.99})
            for (const double v : {0.02, 0.47, 0.9}) {
                const auto here = at(field, quadratic, u, v);
                REQUIRE(here);
                const double tolerance = 1e-9 * u02;
                CHECK(distance(here->second[0], {0.8 * u02, -0.2 * u02, 0}) <= tolerance);
                CHECK(distance(here->second[1], {0.3 * u02, 0.1 * u02, 0}) <= tolerance);
                CHECK(distance(here->second[2], {-0.4 * u02, 0.6 * u02, 0}) <= tolerance);
                if (given) { // nothing is chosen, not even at the domain's borders
                    check_close(here->shape, Symmetric2::isotropic(49), 1e-12 * 49);
                    CHECK(std::abs(here->divergence.x) + std::abs(here->divergence.y) <= 1e-9);
                }
            }
    }
}

// Facets 3 lattice steps wide, each with a J of its own: no quadratic map fits, and a footprint over several of them
// would show a picture of their average.
TEST_CASE("group fit: facets make footprints smaller than a smooth map does") {
    const auto facets = [](double u, double v) {
        Landing landing = affine(u, v);
        const auto facet = int(u * side / 3) * 7919 + int(v * side / 3) * 104729;
        const double tilt = 0.5 * (double(facet % 101) / 50 - 1);
        landing.d_u += tilt * landing.d_u;
        landing.d_v -= tilt * landing.d_v;
        return landing;
    };
    const auto smooth = at(field_of(affine), affine, 0.5, 0.5), rough = at(field_of(facets), facets, 0.5, 0.5);
    REQUIRE((smooth && rough));
    CHECK(rough->shape.trace() < 0.2 * smooth->shape.trace());
}

TEST_CASE("group fit: a photon with invalid tangents does not spoil its neighbours") {
    auto photons = photons_of(quadratic, lattice(std::size_t(side), std::size_t(side)));
    const Field plain = field_of(photons, stratified());
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    photons[32 * 63 + 32].tangents[0].x = nan;
    const auto& sample = photons[20 * 63 + 20].sample.at;
    photons[20 * 63 + 20].frame = EmissionFrame( // was emitted with tangents that span nothing
        Photon<glm::dvec3, double>{{sample[0], sample[1], 1}, {0, 0, -1}, 1, {}});
    const Field field = field_of(photons, stratified());
    for (const auto& [u, v] : lattice(32, 32)) {
        const auto expected = at(plain, quadratic, u, v), here = at(field, quadratic, u, v);
        REQUIRE(here);
        check_close(here->shape, expected->shape, 1e-6 * expected->shape.trace());
        CHECK(distance(here->second[0], expected->second[0]) <= 1e-9 * unit_of(all) * unit_of(all));
    }
}

// Beside a pole of the map. The photon's tangents are K times the others', and its weight is 1/K² of theirs: what it
// adds to the fitted J is at most of the order of |J|/K, to H as much per unit step. With an even weight it would be K
// |J|.
TEST_CASE("group fit: a photon with far longer tangents than its neighbours does not dominate them") {
    constexpr double longer = 1e4;
    auto photons = photons_of(quadratic, lattice(std::size_t(side), std::size_t(side)));
    MapPhoton& pole = photons[30 * 63 + 30]; // a corner of the cell in the middle
    for (Double3& tangent : pole.tangents)
        tangent = longer * tangent;
    const auto plain = at(field_of(quadratic), quadratic, 0.5, 0.5),
               here = at(field_of(photons, stratified()), quadratic, 0.5, 0.5);
    REQUIRE((plain && here));
    const double size = std::sqrt(inner(pole.tangents[0], pole.tangents[0])) / longer; // |J|
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(distance(here->second[i], plain->second[i]) <= 4 * size / longer);
}

} // namespace nephroid::tests::group_fit_test
