// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/group_borders.hpp"

#include "smoothing/second_order/fields.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace nephroid::tests::group_borders_test {

using namespace fields;

using namespace nephroid::detail;

// The outermost photons on the left are at column 30 of 0 to 62, on the right at column 31: borders are laid there.
TEST_CASE("group borders: both sides of a change of path have a border") {
    const TwoGroups map;
    const Field field = field_of(map);
    const double s2 = straight_radius2(), width = side * step;
    const double left = 30.5 / side, right = 31.5 / side;
    for (const double away : {0.005, 0.03, 0.08, 0.2}) {
        CAPTURE(away);
        for (const double u : {left - away, right + away}) {
            const auto here = at(field, map, u, 0.5);
            REQUIRE(here);
            const double narrow = narrowed_by_group(s2, away * width);
            check_close(here->shape, {between(narrow, u * width, width), 0, between(narrow, 0.5 * width, width)},
                        1e-6 * s2);
            CHECK(std::sqrt(inner(here->second[0], here->second[0])) <= 1e-12); // no difference was taken across
        }
    }
    // Between the middles of two cells values are blended; across the border, where the map bends, they are not.
    const auto bent_beyond = [](double u, double v) {
        Landing landing = u < 0.5 ? affine(u, v) : quadratic(u, v);
        landing.signature = u < 0.5 ? 1 : 2;
        return landing;
    };
    const auto last = at(field_of(bent_beyond), bent_beyond, 0.499, 0.5);
    REQUIRE(last);
    check_close(last->shape, Symmetric2::isotropic(narrowed_by_group(s2, 0)), 1e-6 * s2);
    for (const Double3& h : last->second)
        CHECK(std::sqrt(inner(h, h)) <= 1e-12);
}

// A border that runs askew to the cells is laid through the outermost photon of a strip, half a cell to either side of
// a cell's middle, and felt by photons a cell across from there at most, as the middles of four cells are blended. Its
// direction is off by 45 degrees at most (where of a cell's surroundings a corner is cut off, or a side), so that it
// may be laid 1.5 cells too far out. More than 2 steps are rare: 1% of the photons looked at, of which there are some
// 300 to a lattice; the 2% allowed are not derived.
TEST_CASE("group borders: borders are found in any direction") {
    const auto askew = [](double u, double v) {
        Landing landing = affine(u, v);
        landing.signature = u + 0.6 * v < 0.8 ? 1 : 2;
        return landing;
    };
    const Plane2 n{1 / std::hypot(1, 0.6), 0.6 / std::hypot(1, 0.6)};
    for (const auto& samples : {lattice(63, 63), halton(4000)}) {
        const auto photons = photons_of(askew, samples);
        const Field field = field_of(photons, {.stratified = true, .photons = double(samples.size())});
        const double u0 = unit_of(double(samples.size()));
        std::size_t checked = 0, far = 0;
        for (std::size_t i = 0; i < photons.size(); i += 3) {
            const auto& [u, v] = photons[i].sample.at;
            const double away = std::abs(u + 0.6 * v - 0.8) / std::hypot(1, 0.6) / u0;
            if (u < 0.2 || u > 0.8 || v < 0.2 || v > 0.8 || away > 25)
                continue;
            const auto here = field.at(photons[i].sample.at, photons[i].frame, photons[i].signature);
            REQUIRE(here);
            const double radius = std::sqrt(inner(n, here->shape(n)));
            CHECK(radius <= reach_to_found(away + 1.5 * unit_per_cell * step));
            far += radius > reach_to_found(away + 2 * step);
            ++checked;
        }
        CHECK(checked > 100);
        CHECK(double(far) < 0.02 * double(checked));
    }
}

// A quarter of the domain, narrower than the widest footprints. A border is laid up to 1.5 cells too far out, as
// above, in both directions now; on average it is within half a cell.
TEST_CASE("group borders: footprints of a small group are bounded on all of its sides") {
    const auto patch = [](double u, double v) {
        Landing landing = affine(u, v);
        landing.signature = std::abs(u - 0.5) < 0.125 && std::abs(v - 0.45) < 0.125 ? 2 : 1;
        return landing;
    };
    for (const auto& samples : {lattice(63, 63), halton(4000)}) {
        const auto photons = photons_of(patch, samples);
        const Field field = field_of(photons, {.stratified = true, .photons = double(samples.size())});
        const double u0 = unit_of(double(samples.size()));
        double over = 0;
        int checked = 0, in_the_middle = 0;
        for (const auto& photon : photons) {
            if (photon.signature != 2)
                continue;
            const auto here = field.at(photon.sample.at, photon.frame, photon.signature);
            if (!here)
                continue;
            const auto& [u, v] = photon.sample.at;
            const double radius = std::sqrt((std::max)(here->shape.xx, here->shape.yy)),
                         away = (0.125 - (std::max)(std::abs(u - 0.5), std::abs(v - 0.45))) / u0;
            CHECK(radius <= reach_to_found(away + 1.5 * unit_per_cell * step));
            over += (std::max)(0.0, radius - reach_to_found(away));
            ++checked;
            if (std::hypot(u - 0.5, v - 0.45) > 0.02)
                continue;
            // In the middle both borders are as far: (ρ⁻⁴ + m⁻⁴)^(−1/4) is 0.84 m where the radius ρ is
            // the reach m or more, and borders are found to a cell and a half.
            const double half_width = 0.125 / u0;
            CHECK(std::sqrt(here->shape.xx) >= 0.84 * reach_to_found(half_width - 1.5 * unit_per_cell * step) - 1);
            ++in_the_middle;
        }
        REQUIRE(checked > 200);
        REQUIRE(in_the_middle > 3);
        CHECK(over / checked <= 0.5 * unit_per_cell * step);
    }
}

TEST_CASE("group borders: lost photons make a border") {
    auto photons = photons_of(affine, lattice(std::size_t(side), std::size_t(side)));
    for (MapPhoton& photon : photons)
        if (photon.sample.at[0] > 0.501)
            photon = lost(photon);
    const Field field = field_of(photons, stratified());
    const double s2 = straight_radius2(), width = side * step, away = 0.07;
    const auto here = at(field, affine, 0.5 - away, 0.5);
    REQUIRE(here);
    const double narrow = narrowed_by_group(s2, away * width);
    CHECK(here->shape.xx == doctest::Approx(between(narrow, (0.5 - away) * width, width)).epsilon(1e-6));
    CHECK(here->shape.yy == doctest::Approx(between(narrow, 0.5 * width, width)).epsilon(1e-6));
    CHECK(!at(field, affine, 0.8, 0.5));
}

// All nine photons of a cell lost: those beside it are a step away from its border, and the next cells three more.
TEST_CASE("group borders: a hole makes a border for the cells around it") {
    auto photons = photons_of(affine, lattice(std::size_t(side), std::size_t(side)));
    for (std::size_t y = 30; y < 33; ++y)
        for (std::size_t x = 30; x < 33; ++x)
            photons[y * 63 + x] = lost(photons[y * 63 + x]);
    const Field field = field_of(photons, stratified());
    const double s2 = straight_radius2(), width = side * step, cell = unit_per_cell / side;
    const auto right = at(field, affine, 0.5 + cell, 0.5), above = at(field, affine, 0.5, 0.5 + 2 * cell);
    REQUIRE((right && above));
    CHECK(!at(field, affine, 0.5, 0.5));
    const auto beside = [&](double distance, double cells) {
        return between(narrowed_by_group(s2, distance), (0.5 + cells * cell) * width, width);
    };
    check_close(right->shape, {beside(step, 1), 0, beside(step, 0)}, 1e-6 * s2);
    check_close(above->shape, {beside(4 * step, 0), 0, beside(4 * step, 2)}, 1e-6 * s2);
}

TEST_CASE("group borders: single lost photons make no border") {
    constexpr double wide = 240, count = wide * wide;
    auto photons = photons_of(affine, lattice(std::size_t(wide), std::size_t(wide)));
    for (std::size_t i = 5; i < photons.size(); i += 37) // apart from one another
        photons[i] = lost(photons[i]);
    FieldOptions options{.stratified = true, .photons = count};
    options.bounds.largest_radius = 100; // else that were the radius
    const Field field = field_of(photons, options);
    for (const double u : {0.49, 0.5, 0.51})
        for (const double v : {0.492, 0.5, 0.51}) {
            const MapPhoton photon = photon_at(affine, {u, v}, count);
            const auto here = field.at(photon.sample.at, photon.frame, 1);
            REQUIRE(here); // its share is counted in windows of 144 photons, of which four are missing, or three
            CHECK(here->shape.xx >= straight_radius2(count, 141.0 / 144, options.bounds));
            CHECK(here->shape.xx <= straight_radius2(count, 139.0 / 144, options.bounds));
            CHECK(std::abs(here->shape.xx - here->shape.yy) <= 1e-6 * here->shape.xx);
        }
}

} // namespace nephroid::tests::group_borders_test
