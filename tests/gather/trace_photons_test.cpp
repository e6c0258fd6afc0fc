// SPDX-License-Identifier: MIT
#include "nephroid/gather/trace_photons.hpp"

#include "nephroid/splat/splat_caustics.hpp"
#include "nephroid/splat/splat_photons.hpp"

#include "nephroid/emission/light/point.hpp"
#include "nephroid/sequence/random.hpp"

#include "gather/stored_photons.hpp"
#include "support/brute_force.hpp"
#include "transport/tiny_scenes.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::trace_photons_test {

using tests::check_balance;
using tests::complaint_of;
using tests::Vec;
using tests::Vertex;

namespace {

/// Still water above a floor, some of which is missing, and a lamp over it.
template <class T>
tests::SheetScene<T> pond() {
    return {{{{0, 0, 1}, {0, 0, 1}, Event::refract, T(0.9), 1, T(1.33), T(3)},
             {{0, 0, 0}, {0, 0, 1}, Event::deposit, T(1), 1, 1, T(1.5)}}};
}

template <class T>
PointLight<Vec<T>, T> lamp() {
    return PointLight<Vec<T>, T>({.position = {0, 0, 2}, .intensity = T(3)});
}

template <class V, class F, std::size_t N>
bool same(const std::vector<Deposit<V, F, N>>& a, const std::vector<Deposit<V, F, N>>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
        return p.position == q.position && p.normal == q.normal && p.direction == q.direction && p.flux == q.flux &&
               p.d_position == q.d_position;
    });
}

} // namespace

TEST_CASE_TEMPLATE("trace photons: stores every photon that a walk deposits", T, float, double) {
    const auto scene = pond<T>();
    const auto light = lamp<T>();
    const PhotonPass pass{.first = 100, .count = 5000, .total = 8000, .smoothing = 6};
    const RandomSequence sequence(7);
    const auto traced = trace_photons(scene, light, pass, sequence);

    std::vector<Deposit<Vec<T>, T>> expected;
    Statistics account;
    for (std::uint64_t i = 100; i < 5100; ++i) {
        Sampler<RandomSequence> sampler(sequence, i);
        const auto photon = light.emit(sampler, Spread<T>{T(8000), T(6)});
        if (const auto deposit = walk(scene, photon, sampler, WalkLimits{}, account))
            expected.push_back(*deposit);
    }
    CHECK(same(traced.deposits, expected));
    CHECK(expected.size() > 200);
    check_balance(traced.statistics);
    CHECK(traced.statistics[Fate::splatted].photons == expected.size());
    CHECK(traced.statistics[Fate::escaped].photons == account[Fate::escaped].photons);
    CHECK(traced.statistics.rays == account.rays);
    CHECK(traced.statistics.specular_events == account.specular_events);
    CHECK(traced.statistics.emitted.photons == 5000);
}

// The sums adds up in photon order, so equal deposits give equal sums to the last bit.
TEST_CASE("trace photons: stores the photons that splatting splats") {
    using V = Vec<float>;
    std::vector<Vertex<V>> vertices;
    tests::add_lattice<float>(vertices, 40, 40, 0.1, {-1.95, -1.95, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    const PhotonPass pass{.count = 5000};
    const auto traced = trace_photons(pond<float>(), lamp<float>(), pass);
    const auto disks = Published{}.with_shape(FixedFootprint{0.2});
    auto sums = nephroid::sums<float>(map), stored = nephroid::sums<float>(map);
    const Statistics account = splat_caustics(pond<float>(), lamp<float>(), sums, pass, disks);
    const Statistics of_stored = splat(traced.deposits, stored, {}, disks);
    CHECK(of_stored[Fate::splatted].photons == account[Fate::splatted].photons);
    CHECK(of_stored[Fate::unseen].flux == account[Fate::unseen].flux);
    std::vector<float> one(vertices.size()), other(vertices.size());
    sums.for_each([&](std::size_t i, float e) { one[i] = e; });
    stored.for_each([&](std::size_t i, float e) { other[i] = e; });
    CHECK(one == other);
    CHECK(*std::max_element(one.begin(), one.end()) > 0);
    CHECK(traced.statistics[Fate::splatted].photons == account[Fate::splatted].photons + account[Fate::unseen].photons);
}

TEST_CASE_TEMPLATE("trace photons: without tangents they are the same but for the footprints", T, float, double) {
    const auto scene = pond<T>();
    const auto light = lamp<T>();
    const auto whole = trace_photons(scene, light, {.count = 3000});
    const auto bare = trace_photons(scene, WithoutTangents(light), {.count = 3000});
    static_assert(std::is_same_v<decltype(bare.deposits), std::vector<Deposit<Vec<T>, T, 0>>>);
    REQUIRE(bare.deposits.size() == whole.deposits.size());
    REQUIRE(whole.deposits.size() > 200);
    for (std::size_t i = 0; i < bare.deposits.size(); ++i) {
        REQUIRE(bare.deposits[i].position == whole.deposits[i].position);
        REQUIRE(bare.deposits[i].normal == whole.deposits[i].normal);
        REQUIRE(bare.deposits[i].direction == whole.deposits[i].direction);
        REQUIRE(bare.deposits[i].flux == whole.deposits[i].flux);
    }
    check_balance(bare.statistics);
}

TEST_CASE("splatting with a fixed footprint needs no tangents and gives the same sums without them") {
    using V = Vec<float>;
    std::vector<Vertex<V>> vertices;
    tests::add_lattice<float>(vertices, 40, 40, 0.1, {-1.95, -1.95, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    const auto disks = Published{}.with_shape(FixedFootprint{0.3});
    auto whole = nephroid::sums<float>(map), bare = nephroid::sums<float>(map);
    (void)splat_caustics(pond<float>(), lamp<float>(), whole, {.count = 3000}, disks);
    const Statistics account =
        splat_caustics(pond<float>(), WithoutTangents(lamp<float>()), bare, {.count = 3000}, disks);
    std::vector<float> one(vertices.size()), other(vertices.size());
    whole.for_each([&](std::size_t i, float e) { one[i] = e; });
    bare.for_each([&](std::size_t i, float e) { other[i] = e; });
    CHECK(one == other);
    CHECK(account[Fate::splatted].photons > 200);
    check_balance(account);
}

TEST_CASE("trace photons: several threads give the same photons in the same order") {
    const auto scene = pond<float>();
    const auto light = lamp<float>();
    const PhotonPass pass{.count = 70000}; // more than a batch
    const auto serial = trace_photons(scene, light, pass);
    ThreadExecutor executor(3);
    const auto threaded = trace_photons(scene, light, pass, HaltonSequence{}, executor);
    CHECK(same(serial.deposits, threaded.deposits));
    CHECK(serial.statistics.accounted_flux() == threaded.statistics.accounted_flux());
    // And in two passes.
    const auto first = trace_photons(scene, light, {.count = 30001, .total = 70000});
    const auto second = trace_photons(scene, light, {.first = 30001, .count = 39999, .total = 70000});
    auto both = first.deposits;
    both.insert(both.end(), second.deposits.begin(), second.deposits.end());
    CHECK(same(serial.deposits, both));
}

TEST_CASE("trace photons: progress stops the pass between batches") {
    std::vector<std::uint64_t> reports;
    const auto traced =
        trace_photons(pond<float>(), lamp<float>(), {.count = 200000, .progress = [&](std::uint64_t done) {
                                                         reports.push_back(done);
                                                         return false;
                                                     }});
    REQUIRE(reports.size() == 1);
    CHECK(reports[0] < 200000);
    CHECK(traced.statistics.emitted.photons == reports[0]);
}

TEST_CASE("trace photons: says which number cannot be") {
    const auto complaint = [](const PhotonPass& pass) {
        return complaint_of([&] { return trace_photons(pond<float>(), lamp<float>(), pass); });
    };
    CHECK(complaint({}).starts_with("nephroid::trace_photons: zero photons"));
    CHECK(complaint({.count = 10, .smoothing = 0}).starts_with("nephroid::trace_photons: smoothing is 0"));
    CHECK(complaint({.count = 10}) == "none");
}

} // namespace nephroid::tests::trace_photons_test
