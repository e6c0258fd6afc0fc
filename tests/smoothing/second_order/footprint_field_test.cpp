// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/footprint_field.hpp"

#include "nephroid/execution/executor.hpp"

#include "smoothing/second_order/maps.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::footprint_field_test {

using namespace nephroid::detail;
using tests::affine;
using tests::Draws;
using tests::halton;
using tests::MapPhoton;
using tests::photon_at;
using tests::photons_of;
using tests::quadratic;
using tests::unit_of;

namespace {

constexpr std::size_t count = 16384;

[[nodiscard]] FootprintField field_of(const std::vector<MapPhoton>& photons, bool stratified = true,
                                      double largest = SmoothingBounds{}.largest_radius) {
    SerialExecutor executor;
    const FieldOptions options{
        .stratified = stratified, .photons = double(photons.size()), .bounds = {.largest_radius = largest}};
    return FootprintField(photons, options, executor);
}

/// Photons that take the map, on path 1, but some by chance another way, on path 2.
[[nodiscard]] std::vector<MapPhoton> reflected_by_chance(double share) {
    Draws draw(3);
    std::vector<MapPhoton> photons;
    for (const auto& sample : halton(count)) {
        const bool elsewhere = draw.in(0, 1) < share;
        photons.push_back(elsewhere ? photon_at(quadratic, sample, double(count))
                                    : photon_at(affine, sample, double(count)));
        photons.back().signature = elsewhere ? 2 : 1;
    }
    return photons;
}

[[nodiscard]] double size_of(const Symmetric2& shape) { return std::sqrt(std::sqrt(shape.determinant())); }

} // namespace

TEST_CASE("footprint field: a path that too few photons took has no field") {
    auto photons = photons_of(affine, halton(1000));
    for (std::size_t i = 0; i < 63; ++i)
        photons[16 * i].signature = 2;
    photons[7].signature = 3;
    const FootprintField field = field_of(photons);
    CHECK(field.at({0.5, 0.5}, photons[1].frame, 1));
    CHECK(!field.at({0.5, 0.5}, photons[1].frame, 2));
    CHECK(!field.at(photons[7].sample.at, photons[7].frame, 3));
    CHECK(!field.at({0.5, 0.5}, photons[1].frame, 77));
}

// Each group has derivatives of its own, and neither has a border where the other one's photons are.
TEST_CASE("footprint field: groups that overlap by chance do not disturb each other") {
    const double u02 = unit_of(double(count)) * unit_of(double(count));
    for (const double share : {0.5, 0.2, 0.05}) {
        CAPTURE(share);
        const auto photons = reflected_by_chance(share);
        const FootprintField field = field_of(photons);
        const FootprintField alone = field_of(photons_of(affine, halton(count)));
        for (const double u : {0.35, 0.5, 0.6})
            for (const double v : {0.4, 0.55}) {
                const MapPhoton through = photon_at(affine, {u, v}, double(count)),
                                back = photon_at(quadratic, {u, v}, double(count));
                const auto first = field.at({u, v}, through.frame, 1), second = field.at({u, v}, back.frame, 2),
                           all = alone.at({u, v}, through.frame, 1);
                REQUIRE((first && second && all));
                // Fewer photons, and no longer in order: a wider footprint, unless all that is allowed was taken.
                CHECK(size_of(first->shape) >= size_of(all->shape) * (1 - 1e-6));
                const Double3 error = second->second[0] - Double3{0.8 * u02, -0.2 * u02, 0};
                CHECK(std::sqrt(inner(error, error)) <= 1e-9 * u02);
            }
    }
}

// With random photons on a straight map the rule asks for s in proportion to g^(-1/5) / sqrt(p) in the group's own
// unit, g in proportion to (Q / p)²: that is p^(-1/10).
TEST_CASE("footprint field: photons of a small group have wider footprints") {
    const FootprintField all = field_of(photons_of(quadratic, halton(count)), false, 1000);
    for (const double share : {0.5, 0.8}) {
        CAPTURE(share);
        const FootprintField field = field_of(reflected_by_chance(share), false, 1000);
        const MapPhoton photon = photon_at(quadratic, {0.5, 0.5}, double(count));
        const auto some = field.at({0.5, 0.5}, photon.frame, 2), every = all.at({0.5, 0.5}, photon.frame, 1);
        REQUIRE((some && every));
        REQUIRE(size_of(every->shape) < 70); // the border is 113 away
        // The share is a median over windows of 144 photons and more: four standard deviations of its mean are below
        // 5%.
        CHECK(size_of(some->shape) / size_of(every->shape) == doctest::Approx(std::pow(share, -0.1)).epsilon(0.01));
    }
}

TEST_CASE("footprint field: groups side by side have a border between them") {
    auto photons = photons_of(affine, halton(count));
    const FootprintField whole = field_of(photons);
    for (MapPhoton& photon : photons)
        photon.signature = photon.sample.at[0] < 0.47 ? 1 : 2;
    const FootprintField field = field_of(photons);
    const double u0 = unit_of(double(count));
    for (const double away : {0.002, 0.03, 0.06})
        for (const bool left : {false, true}) {
            const MapPhoton photon = photon_at(affine, {0.47 + (left ? -away : away), 0.5}, double(count));
            const auto here = field.at(photon.sample.at, photon.frame, left ? 1 : 2);
            const auto unbounded = whole.at(photon.sample.at, photon.frame, 1);
            REQUIRE((here && unbounded));
            // Bounded by the distance d as (4⁴ + (16 d)²)^(1/4), which is found to a cell (of 4 by 4 photons).
            const double cell = 4 * std::sqrt(pi<double>), distance = away / u0;
            const auto reach2 = [](double d) { return std::hypot(16, 16 * (std::max)(d, 0.0)); };
            const double radius2 = 0.5 * here->shape.trace(), free2 = 0.5 * unbounded->shape.trace();
            CHECK(radius2 <= 1 / std::hypot(1 / reach2(distance + cell), 1 / free2) * 1.01);
            CHECK(radius2 >= 1 / std::hypot(1 / reach2(distance - cell), 1 / free2) * 0.99);
        }
}

} // namespace nephroid::tests::footprint_field_test
