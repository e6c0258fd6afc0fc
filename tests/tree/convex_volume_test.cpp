// SPDX-License-Identifier: MIT
#include "nephroid/tree/convex_volume.hpp"

#include "nephroid/tree/point_tree.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephroid::tests::convex_volume_test {

using tests::Draws;

namespace {

static_assert(Volume<ConvexVolume<float, 5>, float> && Volume<ConvexVolume<double, 6>, double>);

using Wide3 = glm::dvec3; // where the oracles are worked out

double product(const Wide3& a, const Wide3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Points on the floor and the walls of a room, and some in the air.
template <class V>
std::vector<V> room() {
    using T = scalar_t<V>;
    Draws draw(71);
    std::vector<V> points;
    for (int i = 0; i < 20'000; ++i) {
        V p(T(draw.in(-1, 1)), T(draw.in(-1, 1)), T(draw.in(-1, 1)));
        if (i % 4 != 0)
            p[i % 3] = T(i % 2 == 0 ? -1 : 1);
        points.push_back(p);
    }
    return points;
}

/// How many points a volume holds by its definition, how many a walk finds, and how many it looks at.
struct Search {
    std::size_t held = 0, found = 0, tested = 0;
};

template <class V, class Q, class Holds>
Search search(const PointTree<V>& tree, const Q& volume, const Holds& holds) {
    Search result;
    const auto count = [&](const TreeLeaf& leaf, std::size_t& sum) {
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
            sum += holds(Wide3(tree.x()[slot], tree.y()[slot], tree.z()[slot]));
    };
    for (const TreeLeaf& leaf : tree.leaves())
        count(leaf, result.held);
    tree.visit_leaves(volume, [&](std::uint32_t leaf) {
        count(tree.leaves()[leaf], result.found);
        result.tested += tree.leaves()[leaf].size;
    });
    return result;
}

/// How many points a walk looks at.
template <class V, class Q>
std::size_t tested_by(const PointTree<V>& tree, const Q& volume) {
    std::size_t tested = 0;
    tree.visit_leaves(volume, [&](std::uint32_t leaf) { tested += tree.leaves()[leaf].size; });
    return tested;
}

template <class V>
V somewhere(Draws& draw, double size = 1) {
    using T = scalar_t<V>;
    const double x = draw.in(-size, size), y = draw.in(-size, size), z = draw.in(-size, size);
    return V(T(x), T(y), T(z));
}

} // namespace

TEST_CASE_TEMPLATE("convex volume: a frustum about a flight finds all points that brute force finds", T, float,
                   double) {
    using V = glm::vec<3, T>;
    const auto points = room<V>();
    const PointTree<V> tree(points.size(), [&](std::size_t i) { return points[i]; });
    Draws draw(72);
    std::size_t held = 0, by_planes = 0, by_box = 0;
    for (int round = 0; round < 400; ++round) {
        V from = somewhere<V>(draw), to = somewhere<V>(draw);
        if (round % 5 == 0) // along an axis
            to = from, to[round % 3] += T(draw.in(0.1, 1));
        if (round % 7 == 0) // at a point of the tree
            from = tree.relative(points[std::size_t(draw.in(0, 20'000))]);
        const T r0 = T(round % 4 == 0 ? 0.0 : draw.in(0, 0.1)), r1 = T(round % 3 == 0 ? 0.0 : draw.in(0, 0.1));
        // In a ball about a place of the flight: the nearest such place of a thin cone is found by steps.
        const Wide3 a(from), way = Wide3(to) - a;
        const double flight2 = product(way, way), largest = (std::max)(double(r0), double(r1));
        const auto holds = [&](const Wide3& p) {
            // Most points are far from the whole line, which takes one step to see; by a half more than is rounded off.
            const Wide3 across = p - a - (flight2 > 0 ? product(p - a, way) / flight2 : 0.0) * way;
            if (flight2 > 0 && product(across, across) > 1.5 * largest * largest + 1e-20)
                return false;
            for (int step = 0; step <= 64; ++step) {
                const double t = step / 64.0, r = (1 - t) * double(r0) + t * double(r1);
                const Wide3 d = p - a - t * way;
                if (product(d, d) <= r * r)
                    return true;
            }
            return false;
        };
        const auto volume = frustum_about(from, to, r0, r1);
        const Search found = search(tree, volume, holds);
        REQUIRE(found.found == found.held);
        held += found.held, by_planes += found.tested;
        by_box += tested_by(tree, volume.box);
    }
    CHECK(held > 3000);
    CHECK(2 * by_planes < by_box); // the planes leave out most of what a box about a slanted flight holds
}

TEST_CASE_TEMPLATE("convex volume: a thick triangle finds all points that brute force finds", T, float, double) {
    using V = glm::vec<3, T>;
    const auto points = room<V>();
    const PointTree<V> tree(points.size(), [&](std::size_t i) { return points[i]; });
    Draws draw(73);
    std::size_t held = 0, by_planes = 0, by_box = 0;
    for (int round = 0; round < 400; ++round) {
        const V a = round % 2 == 0 ? somewhere<V>(draw) : tree.relative(points[std::size_t(draw.in(0, 20'000))]);
        const V b = a + somewhere<V>(draw, 0.7);
        // Every third a sliver, down to a ten thousandth of its length.
        const V along = T(draw.in(-1, 1)) * (b - a);
        const V c =
            round % 3 == 0 ? a + along + somewhere<V>(draw, std::exp2(-draw.in(4, 13))) : a + somewhere<V>(draw, 0.7);
        const T thickness = T(round % 4 == 0 ? 0.0 : draw.in(0, 0.05));
        // By distances from the planes, with the corners' own normal in double.
        const Wide3 wa(a), wb(b), wc(c), e1 = wb - wa, e2 = wc - wa;
        Wide3 n(e1.y * e2.z - e1.z * e2.y, e1.z * e2.x - e1.x * e2.z, e1.x * e2.y - e1.y * e2.x);
        n /= std::sqrt(product(n, n));
        const auto left_of = [&](const Wide3& from, const Wide3& to, const Wide3& p) {
            const Wide3 e = to - from, d = p - from;
            return product(Wide3(e.y * d.z - e.z * d.y, e.z * d.x - e.x * d.z, e.x * d.y - e.y * d.x), n) >= 0;
        };
        const auto holds = [&](const Wide3& p) {
            return std::abs(product(p - wa, n)) <= double(thickness) && left_of(wa, wb, p) && left_of(wb, wc, p) &&
                   left_of(wc, wa, p);
        };
        const auto volume = thick_triangle(a, b, c, thickness);
        const Search found = search(tree, volume, holds);
        REQUIRE(found.found == found.held);
        held += found.held, by_planes += found.tested;
        by_box += tested_by(tree, volume.box);
    }
    CHECK(held > 1000);
    CHECK(2 * by_planes < by_box);
}

TEST_CASE("convex volume: a ball inside another and triangles without an area are bounded by their boxes") {
    using V = glm::vec3;
    const auto frustum = frustum_about(V(0, 0, 0), V(0.1f, 0, 0), 1.f, 0.2f);
    CHECK(frustum.overlaps({{0.9f, 0, 0}, {0.9f, 0, 0}}));
    CHECK(!frustum.overlaps({{1.1f, 0, 0}, {1.1f, 0, 0}}));
    const auto point = frustum_about(V(1, 2, 3), V(1, 2, 3), 0.f, 0.f);
    CHECK(point.overlaps({{1, 2, 3}, {1, 2, 3}}));
    CHECK(!point.overlaps({{1, 2, 3.001f}, {1, 2, 4}}));
    const auto line = thick_triangle(V(0, 0, 0), V(1, 1, 1), V(2, 2, 2), 0.f);
    CHECK(line.overlaps({{1.5f, 1.5f, 1.5f}, {1.5f, 1.5f, 1.5f}}));
    CHECK(!line.overlaps({{2.1f, 1.5f, 1.5f}, {2.2f, 1.5f, 1.5f}}));
}

TEST_CASE("convex volume: any half spaces of one's own bound it") {
    // The corner of a cube that x + y + z <= 1 cuts off.
    const ConvexVolume<double, 1> corner{{{0, 0, 0}, {1, 1, 1}}, {{{{1, 1, 1}, 1}}}};
    CHECK(corner.overlaps({{0.3, 0.3, 0.3}, {1, 1, 1}}));
    CHECK(!corner.overlaps({{0.34, 0.34, 0.34}, {1, 1, 1}}));
    CHECK(corner.overlaps({{0.25, 0.25, 0.5}, {0.25, 0.25, 0.5}})); // on the plane
    CHECK(!corner.overlaps({{-1, -1, -1}, {-0.1, 0, 0}}));          // beside the box
}

} // namespace nephroid::tests::convex_volume_test
