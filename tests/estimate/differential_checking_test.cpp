// SPDX-License-Identifier: MIT
#include "nephroid/estimate/differential_checking.hpp"

#include "estimate/stored_photons.hpp"

#include <doctest/doctest.h>

using namespace nephroid;
using tests::complaint_of;

namespace {

/// Photons about the origin such that the n-th has seen an estimate f(n): r² = (n − 1)/f(n), all of flux 1.
template <class F>
std::size_t checked(std::size_t count, const DifferentialChecking& checking, const F& f) {
    using V = glm::dvec3;
    std::vector<tests::Stored<V>> photons;
    for (std::size_t n = 1; n <= count; ++n)
        photons.push_back(tests::on_floor<V>(std::sqrt(double(n - 1) / f(double(n))), 0, 1));
    const auto map = tests::map_of_stored(photons);
    std::vector<Neighbour<double>> sorted(count);
    const V origin = map.tree().relative({0, 0, 0});
    REQUIRE(map.tree().nearest(origin, sorted) == count);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
    return detail::checked_count<V, double>(map, sorted, checking);
}

} // namespace

TEST_CASE("differential checking: even light is taken whole") {
    CHECK(checked(500, {}, [](double) { return 3.0; }) == 500);
    CHECK(checked(1, {}, [](double) { return 3.0; }) == 1);
    // Up and down by half at every look is no trend.
    CHECK(checked(256, {.least = 2, .growth = 2, .significance = 1},
                  [](double n) { return int(std::log2(n)) % 2 == 0 ? 2.0 : 3.0; }) == 256);
}

// Looks at 32, 64, 128, … of f = n^(−1/4): down to 0.84, 0.71, 0.59. The root of 32 is 5.7: by 0.29 of the first look's
// value, 1.6 deviations, at the third look and 2.3 at the fourth.
TEST_CASE("differential checking: a trend beyond chance is cut where it began") {
    const auto falling = [](double n) { return std::pow(n, -0.25); };
    CHECK(checked(1000, {.least = 32, .growth = 2, .run = 2, .significance = 1.5}, falling) == 32);
    CHECK(checked(256, {.least = 32, .growth = 2, .run = 2, .significance = 2}, falling) == 32);
    CHECK(checked(128, {.least = 32, .growth = 2, .run = 2, .significance = 2}, falling) == 128);
    CHECK(checked(1000, {.least = 32, .growth = 2, .run = 6, .significance = 1}, falling) == 1000); // too few looks
    const auto rising = [](double n) { return std::pow(n, 0.25); };
    CHECK(checked(1000, {.least = 32, .growth = 2, .run = 2, .significance = 1}, rising) == 32);
    // Even up to 256 photons, but for a hundredth up and down: those are kept.
    const auto edge = [](double n) { return n <= 256 ? 1 + 0.01 * (int(std::log2(n)) % 2 == 0) : 256 / n; };
    CHECK(checked(4096, {.least = 32, .growth = 2}, edge) == 256);
}

TEST_CASE("differential checking: photons in one place tell nothing") {
    CHECK(checked(200, {}, [](double n) { return n <= 100 ? std::numeric_limits<double>::infinity() : 1.0; }) == 200);
}

TEST_CASE("differential checking: says which option cannot be") {
    const auto complaint = [](const DifferentialChecking& checking) {
        return complaint_of([&] {
            detail::check(checking, "renderer");
            return 0;
        });
    };
    CHECK(complaint({}) == "none");
    CHECK(complaint({.least = 1}).starts_with("renderer: checking.least is 1"));
    CHECK(complaint({.growth = 0.5}).starts_with("renderer: checking.growth is 0.5"));
    CHECK(complaint({.run = 0}).starts_with("renderer: checking.run is 0"));
    CHECK(complaint({.significance = -1}).starts_with("renderer: checking.significance is -1"));
}
