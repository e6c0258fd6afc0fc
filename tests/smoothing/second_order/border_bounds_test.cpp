// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/border_bounds.hpp"

#include "nephroid/emission/warp.hpp"

#include "smoothing/second_order/fields.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace nephroid::tests::border_bounds_test {

using namespace fields;

using namespace nephroid::detail;

TEST_CASE("border bounds: footprints reach to the border of the domain and no further") {
    const Field field = field_of(affine);
    const double s2 = straight_radius2(), width = side * step;
    for (const double u : {0.001, 0.02, 0.1, 0.32, 0.5, 0.9, 0.999})
        for (const double v : {0.01, 0.4, 0.5, 0.97}) {
            CAPTURE(u);
            CAPTURE(v);
            const auto here = at(field, affine, u, v);
            REQUIRE(here);
            const Symmetric2 expected{between(s2, u * width, width), 0, between(s2, v * width, width)};
            check_close(here->shape, expected, 1e-9 * s2);
            CHECK(std::sqrt(here->shape.xx) <= (std::max)(2.0, (std::min)(u, 1 - u) * width));
        }
}

// Within a cell, a 21st of the square's side, the map onto the disk turns by (π/4) (2/21) = 0.075 at most, and so may
// the distance to the rim be off by that share: 0.15 of its square. Along the diagonals the map has kinks.
TEST_CASE("border bounds: a disk bounds footprints by the distance to its rim, at the corners of the square too") {
    const auto on_disk = [](const std::array<double, 2>& sample) {
        const DiskPoint<double> at = concentric_disk(sample[0], sample[1]);
        const double tangent = 2 * unit_of(all, pi<double>);
        const glm::dvec3 zero(0), place(at.x, at.y, 1);
        const Photon<glm::dvec3, double> emitted{
            place, {0, 0, -1}, 1 / all, {Tangent<glm::dvec3>{{tangent, 0, 0}, zero}, {{0, tangent, 0}, zero}}};
        const Deposit<glm::dvec3, double, 2> landed{
            {at.x, at.y, 0}, {0, 0, 1}, {0, 0, -1}, emitted.flux, {{{tangent, 0, 0}, {0, tangent, 0}}}};
        return MapPhoton{{sample, 0, 2}, EmissionFrame(emitted), 1, landed};
    };
    std::vector<MapPhoton> photons;
    for (const auto& sample : lattice(std::size_t(side), std::size_t(side)))
        photons.push_back(on_disk(sample));
    const Field field = field_of(photons, stratified());
    const double s2 = straight_radius2();
    for (const double radius : {0.75, 0.85, 0.92})
        for (int i = 0; i < 64; ++i) {
            // A point of the square that is mapped to this radius, next to a corner for every eighth one.
            const double around = (i % 16 - 7.5) / 8 * 0.999;
            const double a = (i & 16 ? 1 : -1) * radius, b = around * radius;
            const std::array<double, 2> sample{0.5 + 0.5 * (i & 32 ? a : b), 0.5 + 0.5 * (i & 32 ? b : a)};
            const DiskPoint<double> place = concentric_disk(sample[0], sample[1]);
            CAPTURE(place.x);
            CAPTURE(place.y);
            const MapPhoton photon = on_disk(sample);
            const auto here = field.at(photon.sample.at, photon.frame, photon.signature);
            REQUIRE(here);
            const Plane2 outwards{place.x / radius, place.y / radius};
            const double expected = narrowed(s2, (1 - radius) * std::sqrt(all));
            CHECK(inner(outwards, here->shape(outwards)) == doctest::Approx(expected).epsilon(0.15));
        }
}

// A kernel with twice the second moment reaches as far with half of S, up to borders too.
TEST_CASE("border bounds: a wider kernel gets smaller footprints at a border") {
    FieldOptions wide = stratified();
    wide.scale = 0.5;
    const Field biweight = field_of(affine), other = field_of(affine, wide);
    for (const double u : {0.02, 0.35}) {
        const auto narrow = at(biweight, affine, u, 0.4), half = at(other, affine, u, 0.4);
        REQUIRE((narrow && half));
        check_close(half->shape, 0.5 * narrow->shape, 1e-12 * narrow->shape.trace());
    }
}

TEST_CASE("border bounds: a repeating domain has no borders") {
    FieldOptions options = stratified();
    options.repeats = true;
    const Field field = field_of(affine, options);
    const double s2 = straight_radius2();
    for (const double u : {0.0, 0.01, 0.4, 0.999})
        for (const double v : {0.001, 0.5, 0.98}) {
            const auto here = at(field, affine, u, v);
            REQUIRE(here);
            check_close(here->shape, Symmetric2::isotropic(s2), 1e-9 * s2);
            CHECK(std::abs(here->divergence.x) + std::abs(here->divergence.y) <= 1e-9 * s2);
        }
}

// 240 × 30 photons over 8 × 1, 53 units from side to side.
TEST_CASE("border bounds: a long domain bounds footprints by the distance to its borders") {
    constexpr double extent = 8, photons = 240 * 30;
    const Field field =
        field_of(photons_of(affine, lattice(240, 30), 0, extent), {.stratified = true, .photons = photons});
    const double s2 = straight_radius2(photons), width = 30 * step;
    for (const double u : {0.002, 0.02, 0.5, 0.985})
        for (const double v : {0.05, 0.5, 0.8}) {
            const MapPhoton photon = photon_at(affine, {u, v}, photons, extent);
            const auto here = field.at(photon.sample.at, photon.frame, 1);
            REQUIRE(here);
            check_close(here->shape,
                        {between(s2, extent * u * width, extent * width), 0, between(s2, v * width, width)}, 1e-6 * s2);
        }
}

} // namespace nephroid::tests::border_bounds_test
