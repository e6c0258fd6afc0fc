// SPDX-License-Identifier: MIT
#include "nephroid/gather/coverage.hpp"

#include "nephroid/gather/fixed_range.hpp"
#include "nephroid/gather/nearest_photons.hpp"
#include "nephroid/relaxation/relax.hpp"

#include "gather/stored_photons.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace nephroid::tests::coverage_test {

using tests::map_of_stored;

namespace {
using V = glm::dvec3;
const V up{0, 0, 1};

[[nodiscard]] bool on_square(const V& p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1; }

/// Photons on a lattice of n by n cells: even light of irradiance 1 on the unit square.
[[nodiscard]] std::vector<tests::Stored<V>> lattice(int n) {
    std::vector<tests::Stored<V>> photons;
    for (int i = 0; i < n * n; ++i)
        photons.push_back(tests::on_floor<V>((i % n + 0.5) / n, (i / n + 0.5) / n, 1.0 / (n * n)));
    return photons;
}
} // namespace

// By symmetry a half at a straight border and a quarter at a corner. 96 points of equal area leave their weight in a
// quarter off by less than that of one of them in 24 or so; measured 0.01.
TEST_CASE("coverage: sampled shares are those of the geometry") {
    const auto check = [](const auto& kernel) {
        const SampledCoverage coverage(on_square, kernel);
        CHECK(coverage(V(0.5, 0.5, 0), up, 0.3) == 1);
        CHECK(coverage(V(0, 0.5, 0), up, 0.3) == doctest::Approx(0.5).epsilon(0.04));
        CHECK(coverage(V(1, 1, 0), up, 0.3) == doctest::Approx(0.25).epsilon(0.08));
        CHECK(coverage(V(-1, 0.5, 0), up, 0.3) == 0);
    };
    check(UniformKernel{});
    check(BiweightKernel{});
    check(ConeKernel{});
}

// Without coverage the border shows half of the light, and a corner a quarter.
TEST_CASE("coverage: at a border estimates divide by the share on the surface") {
    const auto photons = lattice(64);
    const auto map = map_of_stored(photons);
    const SampledCoverage coverage(on_square, BiweightKernel{});
    const FixedRange bare(map, {.range = 0.1});
    const FixedRange divided(map, {.range = 0.1}, BiweightKernel{}, coverage);
    for (const V& place : {V(0, 0.5, 0), V(0.03, 0.4, 0), V(0.5, 1, 0), V(0, 0, 0), V(1, 0.02, 0)}) {
        CHECK(divided(place, up) == doctest::Approx(1).epsilon(0.08));
        CHECK(bare(place, up) < 0.8);
    }
    CHECK(divided(V(0.5, 0.5, 0), up) == bare(V(0.5, 0.5, 0), up));
    const NearestPhotons nearest(map, {.count = 100});
    const NearestPhotons covered(map, {.count = 100}, BiweightKernel{}, coverage);
    for (const V& place : {V(0, 0.5, 0), V(0.03, 0.4, 0), V(0.5, 1, 0), V(0, 0, 0)})
        CHECK(covered(place, up) == doctest::Approx(1).epsilon(0.12)); // the k-th of a lattice comes in steps
    CHECK(nearest(V(0, 0.5, 0), up) < 0.7);
    CHECK(covered(V(0.5, 0.5, 0), up) == nearest(V(0.5, 0.5, 0), up));
}

// The irradiance is 1. Inside, 20 relaxed neighbours leave a noise of 0.05; at the border as many lie in up to twice
// the area, and only the photons' one side evens them out. Without coverage up to half of the light is missing there.
TEST_CASE("coverage: of a relaxed map the border is nearly as even as its middle") {
    auto photons = tests::random_photons<V>(3000, 137);
    const auto on_table = [](std::size_t, const V& p) {
        return V(std::clamp(p.x, 0.0, 1.0), std::clamp(p.y, 0.0, 1.0), 0);
    };
    using P = tests::Stored<V>;
    relax(photons, photon_access(&P::position, &P::normal, &P::flux), {.iterations = 30}, SerialExecutor{}, on_table);
    const auto map = map_of_stored(photons);
    const NearestPhotons bare(map, {.count = 20});
    const NearestPhotons covered(map, {.count = 20}, BiweightKernel{}, SampledCoverage{on_square, BiweightKernel{}});
    const auto rms = [](const auto& estimate, double from, double to) { // of places so far from a side
        double sum = 0;
        for (int i = 0; i < 1000; ++i)
            sum +=
                square(estimate(V(from + (to - from) * (i % 10 + 0.5) / 10, 0.1 + 0.8 * (i + 0.5) / 1000, 0), up) - 1);
        return std::sqrt(sum / 1000);
    };
    const double radius = std::sqrt(20 / (std::numbers::pi * 3000));
    CHECK(rms(bare, 0, radius) > 0.18);
    CHECK(rms(covered, 0, radius) < 0.12);
    CHECK(rms(covered, 0, radius) < 0.6 * rms(bare, 0, radius));
    CHECK(rms(covered, 0.4, 0.6) == rms(bare, 0.4, 0.6));
}

TEST_CASE("coverage: a share that cannot be is taken as one") {
    const auto photons = lattice(16);
    const auto map = map_of_stored(photons);
    const FixedRange bare(map, {.range = 0.1});
    for (const double share : {0.0, -1.0, 2.0, std::numeric_limits<double>::quiet_NaN()}) {
        const auto coverage = [share](const V&, const V&, double) { return share; };
        const FixedRange estimate(map, {.range = 0.1}, BiweightKernel{}, coverage);
        CHECK(estimate(V(0.5, 0.5, 0), up) == bare(V(0.5, 0.5, 0), up));
    }
    const auto half = [](const V&, const V&, double) { return 0.5; };
    CHECK(FixedRange(map, {.range = 0.1}, BiweightKernel{}, half)(V(0.5, 0.5, 0), up) == 2 * bare(V(0.5, 0.5, 0), up));
}

} // namespace nephroid::tests::coverage_test
