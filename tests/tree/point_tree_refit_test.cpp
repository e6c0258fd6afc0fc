// SPDX-License-Identifier: MIT
#include "nephroid/tree/point_tree.hpp"

#include "support/space.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cstring>

namespace nephroid::tests::point_tree_refit_test {

using tests::Draws;

namespace {

using V = glm::dvec3;

/// The tree's points, moved: by slot, relative to its origin.
std::array<std::vector<double>, 3> moved(const PointTree<V>& tree, double by, std::uint32_t seed) {
    Draws draw(seed);
    std::array<std::vector<double>, 3> result;
    const double* const coordinates[3] = {tree.x(), tree.y(), tree.z()};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t slot = 0; slot < tree.slots(); ++slot)
            result[axis].push_back(coordinates[axis][slot] + draw.in(-by, by));
    return result;
}

PointTree<V> random_tree(int count) {
    Draws draw(3);
    std::vector<V> points;
    for (int i = 0; i < count; ++i) {
        const double x = draw.in(-1, 1), y = draw.in(-1, 1);
        points.emplace_back(x, y, draw.in(-1, 1));
    }
    return PointTree<V>(points.size(), [&](std::size_t i) { return points[i]; });
}

} // namespace

TEST_CASE("point tree refit: the nearest are found however far the points moved") {
    SerialExecutor serial;
    for (const double by : {0.01, 0.3, 5.0}) {
        auto tree = random_tree(1500);
        auto next = moved(tree, by, 4);
        const auto wanted = next;
        tree.refit(next, serial);
        for (const TreeLeaf& leaf : tree.leaves()) {
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                CHECK(tree.x()[slot] == wanted[0][slot]);
            for (std::size_t slot = leaf.first + leaf.size; slot % PointTree<V>::lanes != 0; ++slot)
                CHECK(tree.y()[slot] == tree.y()[leaf.first + leaf.size - 1]); // repeats the last
        }
        Draws draw(5);
        for (int query = 0; query < 50; ++query) {
            const V place(draw.in(-2, 2), draw.in(-2, 2), draw.in(-2, 2));
            std::array<Neighbour<double>, 5> found;
            REQUIRE(tree.nearest(place, found) == 5);
            std::vector<double> all;
            for (const TreeLeaf& leaf : tree.leaves())
                for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
                    const V point(tree.x()[slot], tree.y()[slot], tree.z()[slot]);
                    all.push_back(length2(V(point - place)));
                }
            std::sort(all.begin(), all.end());
            std::sort(found.begin(), found.end(),
                      [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
            for (std::size_t k = 0; k < 5; ++k)
                CHECK(found[k].distance2 == doctest::Approx(all[k]).epsilon(1e-14));
        }
    }
}

TEST_CASE("point tree refit: boxes are tight and the same for any number of threads") {
    auto serial_tree = random_tree(3000), parallel_tree = random_tree(3000);
    SerialExecutor serial;
    ThreadExecutor threads(3);
    auto a = moved(serial_tree, 0.5, 6), b = a;
    serial_tree.refit(a, serial);
    parallel_tree.refit(b, threads);
    const auto nodes = serial_tree.nodes();
    CHECK(std::memcmp(nodes.data(), parallel_tree.nodes().data(), nodes.size() * sizeof nodes[0]) == 0);
    for (const auto& node : nodes) {
        if (node.leaf == no_leaf)
            continue;
        const TreeLeaf leaf = serial_tree.leaves()[node.leaf];
        const auto [low, high] =
            std::minmax_element(serial_tree.x() + leaf.first, serial_tree.x() + leaf.first + leaf.size);
        CHECK(node.box.low[0] == *low);
        CHECK(node.box.high[0] == *high);
    }
    CHECK(serial_tree.bounds().low == nodes[0].box.low);
    PointTree<V> nothing(0, [](std::size_t) { return V(0); });
    std::array<std::vector<double>, 3> none;
    nothing.refit(none, serial);
    CHECK(nothing.empty());
}

} // namespace nephroid::tests::point_tree_refit_test
