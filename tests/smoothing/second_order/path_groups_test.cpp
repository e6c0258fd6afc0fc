// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/path_groups.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include "smoothing/second_order/maps.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::path_groups_test {

using namespace nephroid::detail;
using tests::affine;
using tests::Draws;
using tests::halton;
using tests::MapPhoton;
using tests::photons_of;

namespace {

const SerialExecutor one_by_one;

[[nodiscard]] PathGroups groups_of(const std::vector<MapPhoton>& photons, bool repeats = false) {
    return {PathSamples(photons), repeats, TaskRunner(one_by_one)};
}

/// @param path  a photon's signature, or 0 if it is lost, by its sample
template <class Path>
[[nodiscard]] std::vector<MapPhoton> photons_on(const Path& path, std::size_t count = 8192) {
    auto photons = photons_of(affine, halton(count));
    for (MapPhoton& photon : photons) {
        photon.signature = path(photon.sample.at[0], photon.sample.at[1]);
        if (photon.signature == 0)
            photon = tests::lost(photon);
    }
    return photons;
}

} // namespace

TEST_CASE("path groups: each photon that landed is in the group of its path and lost ones are in none") {
    const auto photons = photons_on([](double u, double v) { return u + v > 1.5 ? 0u : u < v ? 9u : 4u; });
    const PathGroups groups = groups_of(photons);
    REQUIRE(groups.groups().size() == 2);
    CHECK(groups.groups()[0].signature == 4);
    CHECK(groups.groups()[1].signature == 9);
    std::size_t landed = 0;
    for (const PathGroup& group : groups.groups())
        for (const std::uint32_t i : group.photons) {
            CHECK(photons[i].signature == group.signature);
            ++landed;
        }
    for (const MapPhoton& photon : photons)
        landed += !photon.has_landed;
    CHECK(landed == photons.size());
}

TEST_CASE("path groups: groups side by side have a share of 1 and a border") {
    const auto photons = photons_on([](double u, double v) { return std::hypot(u - 0.4, v - 0.5) < 0.3 ? 1u : 2u; });
    const PathGroups groups = groups_of(photons);
    for (const PathGroup& group : groups.groups())
        CHECK(group.share == 1);
    // 512 cells: a photon within half a cell of the border has it in its own cell or not; further than a cell's
    // diagonal it cannot.
    const double cell = 1 / std::sqrt(512.0);
    std::size_t near = 0, flagged = 0;
    for (std::size_t i = 0; i < photons.size(); ++i) {
        const auto& at = photons[i].sample.at;
        const double away = std::abs(std::hypot(at[0] - 0.4, at[1] - 0.5) - 0.3);
        if (away > 1.5 * cell)
            CHECK(!groups.is_next_to_border(i));
        if (away < 0.2 * cell) {
            ++near;
            flagged += groups.is_next_to_border(i);
        }
    }
    CHECK(near > 100);
    CHECK(double(flagged) > 0.8 * double(near)); // others lie beside a cell's own border
}

TEST_CASE("path groups: groups that overlap by chance have shares and no border") {
    for (const double share : {0.5, 0.1, 0.02}) {
        Draws draw(7);
        const auto photons = photons_on([&](double, double) { return draw.in(0, 1) < share ? 2u : 1u; });
        const PathGroups groups = groups_of(photons);
        REQUIRE(groups.groups().size() == 2);
        // A median over windows of 144 photons, whose own scatter it half follows.
        const double tolerance = 4 * std::sqrt(share * (1 - share) / 144) / 2;
        CHECK(std::abs(groups.groups()[1].share - share) <= tolerance);
        CHECK(std::abs(groups.groups()[0].share - (1 - share)) <= tolerance);
        std::size_t flagged = 0;
        for (std::size_t i = 0; i < photons.size(); ++i)
            flagged += groups.is_next_to_border(i);
        CHECK(double(flagged) <= 0.02 * double(photons.size()));
    }
}

TEST_CASE("path groups: photons that are all lost make no groups") {
    CHECK(groups_of({}).groups().empty());
    CHECK(groups_of(photons_on([](double, double) { return 0u; }, 100)).groups().empty());
    const PathGroups one = groups_of(photons_on([](double, double) { return 5u; }, 1));
    REQUIRE(one.groups().size() == 1);
    CHECK(one.groups()[0].share == 1);
}

TEST_CASE("path groups: any number of threads finds the same groups") {
    Draws draw(2);
    const auto photons = photons_on([&](double u, double) { return u < 0.3 ? 1u : draw.in(0, 1) < 0.3 ? 2u : 3u; });
    const PathGroups serial = groups_of(photons);
    for (const unsigned threads : {2u, 7u}) {
        ThreadExecutor executor(threads);
        const PathGroups again(PathSamples(photons), false, TaskRunner(executor));
        for (std::size_t k = 0; k < serial.groups().size(); ++k)
            CHECK(again.groups()[k].share == serial.groups()[k].share);
        for (std::size_t i = 0; i < photons.size(); ++i)
            REQUIRE(again.is_next_to_border(i) == serial.is_next_to_border(i));
    }
}

} // namespace nephroid::tests::path_groups_test
