// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/area_photons.hpp"

#include "smoothing/second_order/area_maps.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <numeric>

namespace nephroid::tests::area_photons_test {

using namespace nephroid::detail;
using tests::AreaLamp;
using tests::AreaLanding;
using tests::AreaPhoton;

namespace {

[[nodiscard]] std::vector<std::uint32_t> first(std::uint32_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
}

/// Of path 5, but for every third photon, of path 3.
[[nodiscard]] std::vector<AreaPhoton> photons_of_two_paths() {
    auto photons = AreaLamp{}.photons(tests::spheres, 9);
    for (std::size_t i = 0; i < photons.size(); ++i)
        photons[i].signature = i % 3 == 0 ? 3 : 5;
    return photons;
}

} // namespace

TEST_CASE("area photons: the commonest path is that of most photons") {
    auto photons = photons_of_two_paths();
    const AreaPhotons all{PathSamples(photons)};
    REQUIRE(all.size() == 9);
    CHECK(all.commonest_path(first(9)).value() == 5);
    CHECK(all.commonest_path(std::vector<std::uint32_t>{0, 1, 3}).value() == 3);
    CHECK(all.commonest_path(std::vector<std::uint32_t>{0, 1}).value() == 3); // the lower of two that are as common
    CHECK(!all.commonest_path({}));
    CHECK(all.is_usable_on(1, 5));
    CHECK(!all.is_usable_on(1, 3));
}

TEST_CASE("area photons: lost photons and those with infinite tangents are not usable") {
    auto photons = photons_of_two_paths();
    for (auto& photon : photons)
        if (photon.signature == 5)
            photon.has_landed = false;
    photons[0].tangents[1].y = std::numeric_limits<double>::infinity();
    const AreaPhotons all{PathSamples(photons)};
    CHECK(all.commonest_path(first(9)).value() == 3);
    CHECK(all.is_on(0, 3)); // it landed there nevertheless: no border is beside it
    CHECK(!all.is_usable_on(0, 3));
    CHECK(!all.is_on(1, 5));
    CHECK(!all.commonest_path(std::vector<std::uint32_t>{0, 1}));
}

// F = (p_x + d_x + 10 d_x², p_y + d_y): of all four numbers d_x alone changes the tangents.
TEST_CASE("area photons: axes along which the tangents change get more cells") {
    const auto bent = [](const AreaSample& u) {
        return AreaLanding{{u[0] + u[2] + 10 * u[2] * u[2], u[1] + u[3], 0},
                           {{{1, 0, 0}, {0, 1, 0}, {1 + 20 * u[2], 0, 0}, {0, 1, 0}}}};
    };
    const auto photons = AreaLamp{.width = 0.1}.photons(bent, 65536);
    const auto counts = AreaPhotons(PathSamples(photons)).cell_counts();
    CHECK(counts[2] > 100);
    for (const std::size_t axis : {0u, 1u, 3u})
        CHECK(counts[axis] <= 4);
}

TEST_CASE("area photons: the cells are cubes if the tangents change equally along all axes") {
    const auto bent = [](const AreaSample& u) {
        const double sum = u[0] + u[1] + u[2] + u[3], slope = 1 + 2 * sum;
        return AreaLanding{{sum + sum * sum, u[1] - u[3], 0},
                           {{{slope, 0, 0}, {slope, 1, 0}, {slope, 0, 0}, {slope, -1, 0}}}};
    };
    const auto photons = AreaLamp{.width = 0.1}.photons(bent, 65536);
    const auto counts = AreaPhotons(PathSamples(photons)).cell_counts();
    for (const std::size_t axis : {0u, 1u, 2u, 3u}) {
        CHECK(counts[axis] >= 7);
        CHECK(counts[axis] <= 9);
    }
}

} // namespace nephroid::tests::area_photons_test
