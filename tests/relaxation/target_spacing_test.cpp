// SPDX-License-Identifier: MIT
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/relaxation/target_spacing.hpp"

#include "relaxation/cloud.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::target_spacing_test {

using namespace nephroid::detail;

namespace {

template <class V>
using FloorCloud = PhotonCloud<V, scalar_t<V>>;

template <class P>
[[nodiscard]] auto cloud_of(const std::vector<P>& photons) {
    return FloorCloud<decltype(P::position)>(photons, access_to<P>(), 0.5, "test");
}

/// Slots by photon.
template <class Cloud>
[[nodiscard]] std::vector<std::size_t> slots_of(const Cloud& cloud, std::size_t photons) {
    std::vector<std::size_t> slots(photons);
    SerialExecutor executor;
    detail::for_each_slot(cloud.tree(), executor, [&](std::size_t slot) { slots[cloud.tree().index(slot)] = slot; });
    return slots;
}

/// Squared distances and indices of the nearest, a photon itself among them, from all distances.
[[nodiscard]] std::vector<std::pair<double, std::size_t>> disc(const std::vector<Stored>& photons, std::size_t photon,
                                                               std::size_t count) {
    std::vector<std::pair<double, std::size_t>> nearest;
    for (std::size_t i = 0; i < photons.size(); ++i)
        nearest.emplace_back(length2(glm::dvec3(photons[i].position - photons[photon].position)), i);
    std::sort(nearest.begin(), nearest.end());
    nearest.resize(count);
    return nearest;
}

/// Σ (1 − d²/R²)/R²
[[nodiscard]] double density(const std::vector<Stored>& photons, std::size_t photon, std::size_t count) {
    const auto nearest = disc(photons, photon, count);
    double sum = 0;
    for (const auto& [distance2, other] : nearest)
        sum += (1 - distance2 / nearest.back().first) / nearest.back().first;
    return sum;
}

/// The root of the density times how many times as many photons lie there as the pilot expects, where the excess is
/// more than two standard deviations of even light's, sqrt(0.2/K): less their square over it.
[[nodiscard]] double corrected_root_density(const std::vector<Stored>& photons, std::size_t photon, std::size_t count) {
    const auto nearest = disc(photons, photon, count);
    double sum = 0, expected = 0;
    for (const auto& [distance2, other] : nearest) {
        const double weight = 1 - distance2 / nearest.back().first;
        sum += weight;
        expected += weight * density(photons, photon, count) / density(photons, other, count);
    }
    const double excess = expected / sum - 1, deviation = std::sqrt(0.2 / double(nearest.size()));
    const double believed = std::abs(excess) > 2 * deviation ? excess - 4 * deviation * deviation / excess : 0;
    return std::sqrt(density(photons, photon, count) * (1 + believed));
}

/// Photons whose density rises by a factor of four, without a jump, from x = 0 to x = 1: (1 + 3x)/2.5.
[[nodiscard]] std::vector<Stored> slope(int count, std::uint32_t seed) {
    Draws draw(seed);
    std::vector<Stored> photons;
    while (int(photons.size()) < count) {
        const double x = draw.in(0, 1), y = draw.in(0, 1);
        if (draw.in(0, 4) < 1 + 3 * x)
            photons.push_back(floor_photon(x, y, int(photons.size())));
    }
    return photons;
}

/// Photons as dense as 1 + 0.8 cos(4πx).
[[nodiscard]] std::vector<Stored> ripples(int count, std::uint32_t seed) {
    Draws draw(seed);
    std::vector<Stored> photons;
    while (int(photons.size()) < count) {
        const double x = draw.in(0, 1), y = draw.in(0, 1);
        if (draw.in(0, 1.8) < 1 + 0.8 * std::cos(4 * std::numbers::pi * x))
            photons.push_back(floor_photon(x, y, int(photons.size())));
    }
    return photons;
}

/// 2 Σ cos(4πx)/n: the factor 0.8 of `ripples`, as it is now.
[[nodiscard]] double contrast(const std::vector<Stored>& photons) {
    double sum = 0;
    for (const Stored& photon : photons)
        sum += 2 * std::cos(4 * std::numbers::pi * photon.position.x);
    return sum / double(photons.size());
}

} // namespace

TEST_CASE("target spacing: distances are measured by the roots of the corrected pilot densities") {
    const auto photons = slope(600, 31);
    const auto cloud = cloud_of(photons);
    SerialExecutor executor;
    const TargetSpacing<FloorCloud<glm::dvec3>> target(cloud, {40, false, true}, {}, executor);
    const auto slots = slots_of(cloud, photons.size());
    double worst = 0;
    for (std::size_t i = 0; i < 100; ++i) {
        const double expected = corrected_root_density(photons, i + 100, 40) / corrected_root_density(photons, i, 40);
        worst = std::max(worst, std::abs(target.factor(slots[i], slots[i + 100]) / expected - 1));
    }
    CHECK(worst < 1e-11); // distances of a tenth from coordinates up to one, squared and over each other
}

TEST_CASE("target spacing: near a feature and in places that tell no density it leaves distances alone") {
    const auto photons = slope(600, 32);
    const auto cloud = cloud_of(photons);
    SerialExecutor executor;
    const auto slots = slots_of(cloud, photons.size());
    std::vector<PhotonConstraint<glm::dvec3>> constraints(cloud.tree().slots(), {{0, 1, 0}, 0});
    for (std::size_t i = 0; i < photons.size(); ++i)
        if (std::abs(photons[i].position.x - 0.5) < 0.05)
            constraints[slots[i]].weight = 1;
    const TargetSpacing<FloorCloud<glm::dvec3>> target(cloud, {60, false, true}, constraints, executor);
    const TargetSpacing<FloorCloud<glm::dvec3>> everywhere(cloud, {60, false, true}, {}, executor);
    std::size_t left_alone = 0, as_if_nothing_were = 0;
    for (std::size_t i = 0; i + 1 < photons.size(); ++i) {
        const double x = photons[i].position.x;
        const double factor = target.factor(slots[i], slots[i + 1]);
        if (std::abs(x - 0.5) < 0.03) {
            CHECK(factor == 1);
            ++left_alone;
        }
        for (std::size_t j = 0; x > 0.9 && j < i; ++j)
            if (photons[j].position.x > 0.9) {
                CHECK(target.factor(slots[i], slots[j]) == everywhere.factor(slots[i], slots[j]));
                ++as_if_nothing_were;
            }
    }
    CHECK(left_alone > 20);
    CHECK(as_if_nothing_were > 100);

    for (const auto& few : {std::vector<Stored>(300, floor_photon(1, 2)), random_floor(15, 33)}) {
        const auto small = cloud_of(few);
        const TargetSpacing<FloorCloud<glm::dvec3>> none(small, {60, false, true}, {}, executor);
        const auto of_few = slots_of(small, few.size());
        CHECK(none.factor(of_few[0], of_few[1]) == 1);
    }
}

TEST_CASE("target spacing: of the other side of a thin wall nothing is seen") {
    auto photons = slope(600, 34);
    const auto alone = photons;
    for (const Stored& photon : random_floor(3000, 35)) {
        photons.push_back(photon);
        photons.back().position.z = -1e-6, photons.back().normal = {0, 0, -1};
    }
    SerialExecutor executor;
    const auto cloud = cloud_of(photons), cloud_alone = cloud_of(alone);
    const auto slots = slots_of(cloud, photons.size()), slots_alone = slots_of(cloud_alone, alone.size());
    const TargetSpacing<FloorCloud<glm::dvec3>> target(cloud, {40, false, true}, {}, executor),
        expected(cloud_alone, {40, false, true}, {}, executor);
    for (std::size_t i = 0; i < 100; ++i)
        CHECK(target.factor(slots[i], slots[i + 100]) ==
              doctest::Approx(expected.factor(slots_alone[i], slots_alone[i + 100])).epsilon(1e-9));
}

// 3000 photons are 0.018 apart, and 150 of them lie within 0.13 of each other, ripples 0.5 apart.
TEST_CASE("target spacing: ripples of density stay as they are and without a target they level out") {
    const auto start = ripples(3000, 36);
    RelaxationOptions options = RelaxationOptions::keeping_density();
    options.constrain = false;
    options.pilot_neighbours = 150;
    auto kept = start, levelled = start;
    relax(kept, access_to<Stored>(), options, SerialExecutor{});
    options.pilot_neighbours = 0;
    relax(levelled, access_to<Stored>(), options, SerialExecutor{});
    const double before = contrast(start), after = contrast(kept), level = contrast(levelled);
    CHECK(level < before - 0.2);                    // diffusion over some spacings
    CHECK(before - after < 0.6 * (before - level)); // and without, but for what the pilot's disc does not see
}

TEST_CASE("target spacing: a map that keeps its density is the same bit for bit for any number of threads") {
    const auto start = slope(1500, 37);
    auto serial = start;
    RelaxationOptions options = RelaxationOptions::keeping_density();
    options.iterations = 8;
    relax(serial, access_to<Stored>(), options, SerialExecutor{});
    CHECK_FALSE(same_positions(serial, start));
    for (const unsigned count : {2u, 5u}) {
        ThreadExecutor threads(count);
        auto parallel = start;
        relax(parallel, access_to<Stored>(), options, threads);
        CHECK(same_positions(parallel, serial));
    }
}

TEST_CASE_TEMPLATE("target spacing: photons few or in one place or on a line are no trouble", T, float, double) {
    using V = glm::vec<3, T>;
    RelaxationOptions options = RelaxationOptions::keeping_density();
    const auto run = [&](std::vector<StoredPhoton<V>> photons) {
        const auto report = relax(photons, access_to<StoredPhoton<V>>(), options, SerialExecutor{});
        CHECK(report.photons == photons.size());
        for (const auto& photon : photons) {
            CHECK(all_finite(photon.position));
            CHECK(photon.flux == 1);
        }
        return photons;
    };
    CHECK(run({}).empty());
    for (const int count : {1, 2, 13, 14, 27, 40})
        run(random_floor<V>(count, std::uint32_t(90 + count)));

    const std::vector<StoredPhoton<V>> together(1000, floor_photon<V>(0.25, 0.75));
    CHECK(same_positions(run(together), together));

    Draws draw(38);
    std::vector<StoredPhoton<V>> line, clusters;
    for (int i = 0; i < 300; ++i)
        line.push_back(floor_photon<V>(draw.in(0, 1), 0));
    run(line);
    for (int i = 0; i < 600; ++i) // in pairs, and 200 in one place, whose density has no bound
        clusters.push_back(i % 3 == 0 ? floor_photon<V>(0.5, 0.5)
                                      : floor_photon<V>(0.01 * (i / 6), 0.5 + 0.2 * (i % 2)));
    run(clusters);
    options.constrain = false;
    run(clusters);
}

TEST_CASE("target spacing: flux is exchanged with the nearest as without it") {
    auto photons = slope(800, 39);
    double before = 0, after = 0, spread = 0;
    for (Stored& photon : photons)
        before += photon.flux = photon.number % 2;
    RelaxationOptions options = RelaxationOptions::keeping_density();
    options.flux_diffusion = FluxDiffusion::conserving;
    options.constrain = false;
    relax(photons, access_to<Stored>(), options, SerialExecutor{});
    for (const Stored& photon : photons)
        after += photon.flux, spread += std::pow(photon.flux - 0.5, 2) / 800;
    CHECK(std::abs(after - before) <= 800 * 13 * 20 * 1.2e-16);
    CHECK(spread < 0.02); // from 0.25
}

} // namespace nephroid::tests::target_spacing_test
