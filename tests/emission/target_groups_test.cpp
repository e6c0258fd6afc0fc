// SPDX-License-Identifier: MIT
#include "nephroid/emission/target_groups.hpp"

#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::target_groups_test {

namespace {

template <class T>
using Spheres = std::vector<BoundingSphere<glm::vec<3, T>>>;

/// Each object is in one group, and in its bounds, to the rounding of coordinates.
template <class T>
void check_groups(const Spheres<T>& objects, const std::vector<TargetGroup<glm::vec<3, T>>>& groups) {
    std::vector<int> counted(objects.size());
    for (const auto& group : groups)
        for (const std::size_t i : group.objects) {
            ++counted[i];
            const T reach = length(glm::vec<3, T>(objects[i].centre - group.bounds.centre)) + objects[i].radius;
            CHECK(reach <= group.bounds.radius);
        }
    CHECK(std::all_of(counted.begin(), counted.end(), [](int n) { return n == 1; }));
}

template <class T>
[[nodiscard]] T area_of(const std::vector<TargetGroup<glm::vec<3, T>>>& groups) {
    T sum = 0;
    for (const auto& group : groups)
        sum += group.bounds.radius * group.bounds.radius;
    return sum;
}

} // namespace

TEST_CASE_TEMPLATE("target groups: two balls far apart are two targets, each as wide as its ball", T, float, double) {
    for (const T distance : {T(10), T(100), T(1000)}) {
        const Spheres<T> balls{{{0, 0, 0}, 1}, {{0, distance, 0}, T(0.5)}};
        const auto groups = group_targets(balls);
        check_groups(balls, groups);
        REQUIRE(groups.size() == 2);
        CHECK(area_of<T>(groups) == doctest::Approx(1.25).epsilon(1e-5));
    }
}

TEST_CASE("target groups: what touches or is close together is one target") {
    Spheres<double> chain;
    for (int i = 0; i < 50; ++i)
        chain.push_back({{i, 0.1 * i, 0}, 0.6});
    CHECK(group_targets(chain).size() == 1);
    CHECK(group_targets(Spheres<double>{{{0, 0, 0}, 1}, {{2.1, 0, 0}, 1}}).size() == 2); // half of the area
    CHECK(group_targets(Spheres<double>{{{0, 0, 0}, 1}, {{0.5, 0, 0}, 0.1}}).size() == 1);
    CHECK(group_targets(Spheres<double>{{{0, 0, 0}, 0}}).size() == 1);
}

// A tray of 4 x 4 beads at distances of ten radii: no single cut of it pays, but all together do.
TEST_CASE("target groups: beads in rows are a target each") {
    Spheres<double> beads;
    for (int i = 0; i < 16; ++i)
        beads.push_back({{10 * (i % 4), 0, 10 * (i / 4)}, 1});
    const auto groups = group_targets(beads);
    check_groups(beads, groups);
    CHECK(groups.size() == 16);
    CHECK(area_of<double>(groups) == doctest::Approx(16).epsilon(1e-12));
}

TEST_CASE_TEMPLATE("target groups: however objects lie, all are in a group and the groups are no larger than one", T,
                   float, double) {
    const RandomSequence random(11);
    for (std::uint32_t scene = 0; scene < 40; ++scene) {
        Spheres<T> objects;
        const std::uint64_t count = 1 + scene * scene % 97;
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto at = [&](std::uint32_t d) { return random.sample<T>(1000 * scene + i, d); };
            const T cluster = std::floor(at(4) * 5);
            objects.push_back({glm::vec<3, T>(at(0), at(1), at(2)) * T(3) +
                                   cluster * T(scene) * glm::vec<3, T>(T(1), T(-0.5), T(0.2)),
                               T(0.3) * at(3)});
        }
        const auto groups = group_targets(objects);
        check_groups(objects, groups);
        CHECK(groups.size() <= 64);
        std::vector<std::size_t> all(objects.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i] = i;
        const T whole = detail::sphere_around(objects, all).radius;
        CHECK(area_of<T>(groups) <= whole * whole);
    }
}

TEST_CASE("target groups: no objects and bounds that cannot be are refused") {
    using V = glm::dvec3;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK_THROWS_AS((void)group_targets(std::vector<BoundingSphere<V>>{}), std::invalid_argument);
    CHECK_THROWS_AS((void)group_targets(std::vector<BoundingSphere<V>>{{{0, nan, 0}, 1}}), std::invalid_argument);
    CHECK_THROWS_AS((void)group_targets(std::vector<BoundingSphere<V>>{{{0, 0, 0}, -1}}), std::invalid_argument);
    CHECK_THROWS_AS((void)group_targets(std::vector<BoundingSphere<V>>{{{0, 0, 0}, nan}}), std::invalid_argument);
}

} // namespace nephroid::tests::target_groups_test
