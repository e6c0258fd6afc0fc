// SPDX-License-Identifier: MIT
#include "nephroid/gather/footprint_map.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <stdexcept>

namespace nephroid::tests::footprint_map_test {

using nephroid::detail::FootprintMap;
using tests::Draws;

namespace {

template <class V>
struct Item {
    V centre;
    Box<scalar_t<V>> box;
};

/// Boxes from a millionth of the scene to all of it, flat ones and points among them, at random and in clusters.
template <class V>
std::vector<Item<V>> items(int count) {
    using T = scalar_t<V>;
    Draws draw(91);
    std::vector<Item<V>> all;
    for (int i = 0; i < count; ++i) {
        std::array<T, 3> low, high, centre;
        const double size = i % 7 == 0 ? 0 : std::pow(10.0, draw.in(-6, 0));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            centre[axis] = T(i % 5 == 0 ? 0.25 : draw.in(-1, 1));
            const double half = axis == 2 && i % 3 == 0 ? 0 : draw.in(0, size);
            low[axis] = centre[axis] - T(half);
            high[axis] = centre[axis] + T(half);
        }
        all.push_back({make_vector<V>(centre[0], centre[1], centre[2]), {low, high}});
    }
    return all;
}

template <class V>
FootprintMap<V> map_of(const std::vector<Item<V>>& all) {
    return FootprintMap<V>(
        all.size(), [&](std::size_t i) { return all[i].centre; }, [&](std::size_t i) { return all[i].box; });
}

template <class V>
void check(const std::vector<Item<V>>& all) {
    using T = scalar_t<V>;
    const auto map = map_of(all);
    std::vector<int> slots_of(all.size());
    for (std::size_t slot = 0; slot < map.slots(); ++slot)
        ++slots_of.at(map.index(slot));
    CHECK(std::all_of(slots_of.begin(), slots_of.end(), [](int n) { return n >= 1; }));

    Draws draw(92);
    for (int query = 0; query < 200; ++query) {
        std::array<T, 3> p;
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = T(query % 4 == 0 ? 0.25 : draw.in(-1.2, 1.2));
        std::vector<int> seen(all.size());
        map.visit_leaves(make_vector<V>(p[0], p[1], p[2]), [&](const TreeLeaf& leaf) {
            REQUIRE(leaf.first % FootprintMap<V>::lanes == 0);
            REQUIRE(leaf.size <= FootprintMap<V>::leaf_size);
            REQUIRE((leaf.first + leaf.size + FootprintMap<V>::lanes - 1) / FootprintMap<V>::lanes <=
                    map.slots() / FootprintMap<V>::lanes);
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                ++seen[map.index(slot)];
        });
        for (std::size_t i = 0; i < all.size(); ++i) {
            REQUIRE(seen[i] <= 1);
            if (all[i].box.overlaps({p, p}))
                REQUIRE(seen[i] == 1);
        }
    }
}

} // namespace

TEST_CASE_TEMPLATE("footprint map: a point meets every box that holds it and each at most once", T, float, double) {
    check(items<glm::vec<3, T>>(3000));
}

TEST_CASE_TEMPLATE("footprint map: takes any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() { check(items<V>(600)); });
}

TEST_CASE("footprint map: without boxes meets nothing and one box is met on its border") {
    using V = glm::vec3;
    const auto count = [](const FootprintMap<V>& map, const V& p) {
        std::size_t met = 0;
        map.visit_leaves(p, [&](const TreeLeaf& leaf) { met += leaf.size; });
        return met;
    };
    const auto nothing = map_of(std::vector<Item<V>>{});
    CHECK(nothing.empty());
    CHECK(count(nothing, {0, 0, 0}) == 0);
    const auto one = map_of(std::vector<Item<V>>{{{0, 0, 0}, {{-1, -1, 0}, {1, 1, 0}}}});
    CHECK(count(one, {1, -1, 0}) == 1);
    CHECK(count(one, {1, -1, 0.001f}) == 0);
    CHECK(count(one, {std::numeric_limits<float>::quiet_NaN(), 0, 0}) == 0);
}

// Ten thousand small boxes and one that covers all: only its own leaf is met everywhere.
TEST_CASE("footprint map: one large box does not make every leaf large") {
    using V = glm::vec3;
    Draws draw(93);
    std::vector<Item<V>> all{{{0, 0, 0}, {{-1, -1, 0}, {1, 1, 0}}}};
    for (int i = 0; i < 10000; ++i) {
        const float x = float(draw.in(-1, 1)), y = float(draw.in(-1, 1)), h = 0.01f;
        all.push_back({{x, y, 0}, {{x - h, y - h, 0}, {x + h, y + h, 0}}});
    }
    const auto map = map_of(all);
    std::size_t met = 0;
    for (int i = 0; i < 100; ++i)
        map.visit_leaves({float(draw.in(-1, 1)), float(draw.in(-1, 1)), 0},
                         [&](const TreeLeaf& leaf) { met += leaf.size; });
    CHECK(met < 100 * 300);
}

TEST_CASE("footprint map: says which box is not finite") {
    using V = glm::vec3;
    auto all = items<V>(50);
    const auto complaint = [&](const V& centre, float high) {
        auto bad = all;
        bad[13].centre = centre;
        bad[13].box.high[1] = high;
        try {
            (void)map_of(bad);
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string("none");
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    CHECK(complaint({0, 0, 0}, nan).find("box 13 ") != std::string::npos);
    CHECK(complaint({0, 0, 0}, infinity).find("box 13 ") != std::string::npos);
    CHECK(complaint({nan, 0, 0}, 1).find("finite") != std::string::npos);
    CHECK(complaint({0, 0, 0}, 1) == "none");
}

} // namespace nephroid::tests::footprint_map_test
