// SPDX-License-Identifier: MIT
#include "nephroid/tree/wide_tree.hpp"

#include "nephroid/tree/build_tree.hpp"
#include "nephroid/tree/nearest_leaf.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace nephroid::tests::wide_tree_test {

using tests::Draws;

namespace {

using Nodes = std::vector<TreeNode<double>>;

/// Leaves of one point each, so that a small cloud has a tree of many nodes.
Nodes tree_of(std::vector<std::array<double, 3>> points) {
    const detail::PointCloud<double> cloud{std::move(points)};
    return detail::TreeBuilder<double>(cloud, 1, 1).nodes;
}

/// Points spread evenly, and points that cluster about the origin over 300 orders of two: a deep tree.
Nodes spread(int count, bool clustered) {
    Draws draw(17);
    std::vector<std::array<double, 3>> points;
    for (int i = 0; i < count; ++i) {
        const double scale = clustered ? std::exp2(-draw.in(0, 300)) : 1;
        points.push_back({scale * draw.in(-1, 1), scale * draw.in(-1, 1), scale * draw.in(-1, 1)});
    }
    return tree_of(std::move(points));
}

Box<double> some_box(Draws& draw) {
    const double size = std::exp2(-draw.in(0, 12));
    Box<double> box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double middle = draw.in(-1, 1) * (draw.in(0, 1) < 0.5 ? size : 1);
        box.low[axis] = middle - size, box.high[axis] = middle + size;
    }
    return box;
}

double distance(const Box<double>& box, const std::array<double, 3>& p) {
    double d = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        d = (std::max)({d, box.low[axis] - p[axis], p[axis] - box.high[axis]});
    return d;
}

} // namespace

TEST_CASE("wide tree: visits the leaves that a box overlaps and in their order") {
    for (const bool clustered : {false, true})
        for (const int count : {1, 2, 7, 8, 9, 64, 2000}) {
            const Nodes nodes = spread(count, clustered);
            const detail::WideTree<double> wide{nodes};
            Draws draw(23);
            for (int i = 0; i < 100; ++i) {
                const Box<double> box = some_box(draw);
                std::vector<std::uint32_t> expected, found;
                for (const auto& node : nodes)
                    if (node.leaf != no_leaf && node.box.overlaps(box))
                        expected.push_back(node.leaf);
                const auto visit = [&](std::uint32_t leaf) { found.push_back(leaf); };
                detail::visit_overlapping<double>(wide.nodes(), nodes, box, visit);
                REQUIRE(found == expected);
                // Any other volume goes another way through the same nodes.
                found.clear();
                const auto enters = [&](std::uint32_t, const Box<double>& other) { return other.overlaps(box); };
                detail::visit_entered<double>(wide.nodes(), nodes, enters, visit);
                REQUIRE(found == expected);
            }
        }
}

TEST_CASE("wide tree: finds the nearest leaf") {
    for (const bool clustered : {false, true})
        for (const int count : {1, 2, 9, 2000}) {
            const Nodes nodes = spread(count, clustered);
            const detail::WideTree<double> wide{nodes};
            std::vector<Box<double>> leaves;
            for (const auto& node : nodes)
                if (node.leaf != no_leaf)
                    leaves.push_back(node.box);
            Draws draw(29);
            for (int i = 0; i < 100; ++i) {
                const std::array<double, 3> p = {draw.in(-2, 2), draw.in(-2, 2), draw.in(-2, 2)};
                double least = std::numeric_limits<double>::infinity();
                for (const auto& leaf : leaves)
                    least = (std::min)(least, distance(leaf, p));
                REQUIRE(distance(leaves[detail::nearest_leaf<double>(wide.nodes(), nodes, p)], p) == least);
            }
        }
}

TEST_CASE("wide tree: follows nodes that have moved") {
    Nodes nodes = spread(300, false);
    detail::WideTree<double> wide{nodes};
    for (auto& node : nodes)
        for (std::size_t axis = 0; axis < 3; ++axis)
            node.box.low[axis] += 10, node.box.high[axis] += 10;
    wide.refit(nodes);
    std::size_t found = 0;
    const auto count = [&](std::uint32_t) { ++found; };
    detail::visit_overlapping<double>(wide.nodes(), nodes, {{8, 8, 8}, {12, 12, 12}}, count);
    CHECK(found == 300);
}

TEST_CASE("wide tree: without nodes has no leaves") {
    const detail::WideTree<double> wide{Nodes{}};
    const auto visit = [](std::uint32_t) { FAIL("a leaf"); };
    detail::visit_overlapping<double>(wide.nodes(), {}, {{-1, -1, -1}, {1, 1, 1}}, visit);
}

// Halves of more than twelve leaves' points are parted in the middle, which leaves more than six leaves' points to be
// divided evenly among as few leaves as can hold them: at worst seven, six sevenths full.
TEST_CASE("tree builder: leaves hold most of what they can") {
    Draws draw(31);
    detail::PointCloud<float> cloud;
    for (int i = 0; i < 100'000; ++i)
        cloud.points.push_back({float(draw.in(0, 1)), float(draw.in(0, 1)), 0});
    const detail::TreeBuilder<float> built(cloud, 64, 16);
    const double mean = 100'000.0 / double(built.leaves.size());
    CHECK(mean > 64 * 0.85);
    CHECK(mean <= 64);
}

TEST_CASE("wide tree: a box without an end meets every leaf once") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Box<double> everything{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
    for (const bool clustered : {false, true})
        for (const int count : {1, 2, 7, 9, 300}) {
            const Nodes nodes = spread(count, clustered);
            const detail::WideTree<double> wide{nodes};
            std::vector<std::uint32_t> met;
            const auto visit = [&](std::uint32_t leaf) { met.push_back(leaf); };
            detail::visit_overlapping<double>(wide.nodes(), nodes, everything, visit);
            CHECK(met.size() == std::size_t(count));
            for (std::size_t i = 0; i < met.size(); ++i)
                CHECK(met[i] == i);
        }
}

} // namespace nephroid::tests::wide_tree_test
