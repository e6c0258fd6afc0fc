// SPDX-License-Identifier: MIT
#include "common/bvh.hpp"

#include "examples/worlds.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

namespace nephroid::examples::bvh_test {

using namespace nephroid::examples::testing;

namespace {

template <class T>
std::vector<Box<T>> random_boxes(std::size_t count, Numbers& numbers) {
    std::vector<Box<T>> boxes(count);
    for (Box<T>& box : boxes) {
        const Vec3<T> corner = numbers.point<T>(-1, 1);
        box.add(corner);
        box.add(corner + numbers.point<T>(0, 0.1));
    }
    return boxes;
}

template <class T>
std::vector<std::uint32_t> primitives_in(const Bvh<T>& bvh) {
    std::vector<std::uint32_t> all;
    for (std::size_t leaf = 0; leaf < bvh.leaf_count(); ++leaf)
        all.insert(all.end(), bvh.leaf(leaf).begin(), bvh.leaf(leaf).end());
    std::sort(all.begin(), all.end());
    return all;
}

/// The slab test in long double.
template <class T>
bool meets(const Ray<T>& ray, const Box<T>& box) {
    Real from = Real(ray.t_min), to = Real(ray.t_max);
    for (int axis = 0; axis < 3; ++axis) {
        const Real o = Real(ray.origin[axis]), d = Real(ray.direction[axis]);
        const Real low = Real(box.min[axis]), high = Real(box.max[axis]);
        if (d == 0) {
            if (o < low || o > high)
                return false;
            continue;
        }
        from = std::max(from, std::min((low - o) / d, (high - o) / d));
        to = std::min(to, std::max((low - o) / d, (high - o) / d));
    }
    return from <= to;
}

} // namespace

TEST_CASE_TEMPLATE("bvh: an empty one is visited nowhere", T, float, double) {
    const Bvh<T> none, empty{std::vector<Box<T>>{}};
    for (const Bvh<T>* bvh : {&none, &empty}) {
        CHECK(bvh->leaf_count() == 0);
        CHECK(bvh->bounds().is_empty());
        bvh->traverse({{0, 0, 0}, {0, 0, 1}}, [](std::uint32_t, T t_max) {
            FAIL("visited");
            return t_max;
        });
    }
}

TEST_CASE_TEMPLATE("bvh: each primitive lies in one leaf and no leaf has more than allowed", T, float, double) {
    Numbers numbers(1);
    for (const std::size_t count : {1u, 2u, 4u, 5u, 17u, 1000u})
        for (const std::size_t leaf_size : {1u, 3u, 4u}) {
            const Bvh<T> bvh(random_boxes<T>(count, numbers), leaf_size);
            const auto found = primitives_in(bvh);
            REQUIRE(found.size() == count);
            for (std::size_t i = 0; i < count; ++i)
                CHECK(found[i] == i);
            for (std::size_t leaf = 0; leaf < bvh.leaf_count(); ++leaf) {
                CHECK(bvh.leaf(leaf).size() >= 1);
                CHECK(bvh.leaf(leaf).size() <= leaf_size);
            }
        }
}

TEST_CASE_TEMPLATE("bvh: coincident and nested primitives are split all the same", T, float, double) {
    std::vector<Box<T>> boxes(1000, Box<T>{{1, 2, 3}, {1, 2, 3}}); // points
    CHECK(primitives_in(Bvh<T>(boxes)).size() == 1000);
    for (std::size_t i = 0; i < boxes.size(); ++i) // about one centre
        boxes[i] = {Vec3<T>(-T(i + 1)), Vec3<T>(T(i + 1))};
    CHECK(primitives_in(Bvh<T>(boxes)).size() == 1000);
    // Sizes that halve are the heuristic's worst case: each split takes a few off, so that the depth has to be bounded.
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const T x = std::ldexp(T(1), -int(i % (sizeof(T) == sizeof(float) ? 120 : 1000)));
        boxes[i] = {{x, 0, 0}, {x, x, x}};
    }
    const Bvh<T> deep(boxes, 1);
    CHECK(primitives_in(deep).size() == 1000);
    std::size_t visited = 0;
    deep.traverse({{-1, 0, 0}, {1, 0, 0}}, [&](std::uint32_t, T t_max) {
        ++visited;
        return t_max;
    });
    CHECK(visited == 1000);
}

TEST_CASE_TEMPLATE("bvh: bounds that are empty or not finite are refused", T, float, double) {
    const T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    const Box<T> good{{0, 0, 0}, {1, 1, 1}};
    for (const Box<T>& bad : {Box<T>{}, Box<T>{{0, nan, 0}, {1, 1, 1}}, Box<T>{{0, 0, 0}, {1, infinity, 1}}})
        CHECK_THROWS_AS(Bvh<T>(std::vector<Box<T>>{good, bad}), std::invalid_argument);
}

TEST_CASE_TEMPLATE("bvh: an empty box adds nothing to another", T, float, double) {
    Box<T> box{{1, 2, 3}, {4, 5, 6}};
    box.add(Box<T>{});
    CHECK(box.min == Vec3<T>(1, 2, 3));
    CHECK(box.max == Vec3<T>(4, 5, 6));
    Box<T> none;
    none.add(Box<T>{});
    CHECK(none.is_empty());
}

// Few primitives leave most bins empty. A grid's best split is always between two columns or rows: a ray through a cell
// meets its leaf, and no other.
TEST_CASE_TEMPLATE("bvh: over the cells of a grid leaves do not overlap", T, float, double) {
    std::vector<Box<T>> cells;
    for (int i = 0; i < 60 * 60; ++i) {
        const Vec3<T> corner(T(i % 60), T(i / 60), 0);
        cells.push_back({corner, corner + T(1)});
    }
    const Bvh<T> bvh(cells);
    for (std::size_t i = 0; i < cells.size(); i += 7) {
        int visits = 0;
        bvh.traverse({cells[i].min + Vec3<T>(T(0.5), T(0.5), -1), {0, 0, 1}}, [&](std::uint32_t, T t_max) {
            ++visits;
            return t_max;
        });
        REQUIRE(visits == 1);
    }
}

// Rays through corners and along faces are where rounding decides; the oracle has 11 bits more than double.
TEST_CASE_TEMPLATE("bvh: no box that a ray meets is missed", T, float, double) {
    Numbers numbers(2);
    const auto boxes = random_boxes<T>(300, numbers);
    const Bvh<T> bvh(boxes, 1);
    for (int i = 0; i < 3000; ++i) {
        const Box<T>& aim = boxes[std::size_t(i) % boxes.size()];
        Ray<T> ray{numbers.point<T>(-2, 2), numbers.direction<T>()};
        if (i % 3 == 1)
            ray.direction = aim.corner(i % 8) - ray.origin;
        if (i % 3 == 2) { // along an edge
            ray.direction = Vec3<T>(0);
            ray.direction[i % 2] = i % 4 < 2 ? T(1) : T(-1);
            ray.origin = aim.corner(i % 8) - T(3) * ray.direction;
        }
        std::vector<bool> visited(boxes.size());
        bvh.traverse(ray, [&](std::uint32_t leaf, T t_max) {
            visited[bvh.leaf(leaf).front()] = true;
            return t_max;
        });
        for (std::size_t b = 0; b < boxes.size(); ++b)
            if (meets(ray, boxes[b]))
                CHECK(visited[b]);
    }
}

TEST_CASE_TEMPLATE("bvh: over a user's own primitives the nearest hit is that of a search through all", T, float,
                   double) {
    Numbers numbers(3);
    const auto boxes = random_boxes<T>(500, numbers);
    const Bvh<T> bvh(boxes);
    // The primitives are the boxes' centres, hit by a ray that passes within 0.1.
    const auto distance_to = [&](const Ray<T>& ray, std::size_t i) {
        const Vec3<T> to = T(0.5) * (boxes[i].min + boxes[i].max) - ray.origin;
        const T along = nephroid::dot(to, ray.direction);
        const Vec3<T> off = to - along * ray.direction;
        return nephroid::length2(off) < T(0.01) && along > T(0) ? along : std::numeric_limits<T>::infinity();
    };
    std::vector<Box<T>> reached;
    for (const Box<T>& box : boxes) {
        const Vec3<T> centre = T(0.5) * (box.min + box.max);
        reached.push_back({centre - Vec3<T>(T(0.101)), centre + Vec3<T>(T(0.101))});
    }
    const Bvh<T> over_spheres(reached);
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const Ray<T> ray{numbers.point<T>(-2, 2), numbers.direction<T>()};
        T expected = std::numeric_limits<T>::infinity(), found = expected;
        for (std::size_t p = 0; p < boxes.size(); ++p)
            expected = std::min(expected, distance_to(ray, p));
        over_spheres.traverse(ray, [&](std::uint32_t leaf, T) {
            for (const std::uint32_t p : over_spheres.leaf(leaf))
                found = std::min(found, distance_to(ray, p));
            return found;
        });
        CHECK(found == expected);
        hits += found < std::numeric_limits<T>::infinity();
    }
    CHECK(hits > 50);
}

TEST_CASE("bvh: a ray whose direction is no number meets nothing") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const Bvh<float> bvh(std::vector<Box<float>>(100, Box<float>{{-1, -1, 1}, {1, 1, 2}}), 1);
    bvh.traverse({{0, 0, 0}, {nan, nan, nan}}, [](std::uint32_t, float t_max) {
        FAIL("visited");
        return t_max;
    });
}

TEST_CASE("bvh: a visitor ends the search by a distance below the ray's first") {
    Numbers numbers(4);
    const Bvh<float> bvh(std::vector<Box<float>>(100, Box<float>{{-1, -1, 1}, {1, 1, 2}}), 1);
    int visits = 0;
    bvh.traverse({{0, 0, 0}, {0, 0, 1}}, [&](std::uint32_t, float) {
        ++visits;
        return -1.0f;
    });
    CHECK(visits == 1);
}

} // namespace nephroid::examples::bvh_test
