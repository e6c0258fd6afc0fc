// SPDX-License-Identifier: MIT
#include "nephroid/tree/point_tree_view.hpp"

#include "nephroid/tree/point_tree.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <type_traits>
#include <memory>
#include <vector>

namespace nephroid::tests::point_tree_view_test {

namespace {

/// Everything that a device would be given, somewhere else.
template <class V>
struct Copied {
    using T = scalar_t<V>;
    using Arrays = typename PointTreeView<V>::Arrays;

    explicit Copied(const Arrays& a)
        : nodes(a.nodes.begin(), a.nodes.end()), wide(a.wide_nodes.begin(), a.wide_nodes.end()),
          leaves(a.leaves.begin(), a.leaves.end()), index(a.index.begin(), a.index.end()), origin(a.origin) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            coordinates[axis].assign(a.coordinates[axis], a.coordinates[axis] + a.index.size());
    }

    [[nodiscard]] PointTreeView<V> view() const {
        return PointTreeView<V>(Arrays{
            origin, nodes, wide, leaves, index, {coordinates[0].data(), coordinates[1].data(), coordinates[2].data()}});
    }

    std::vector<TreeNode<T>> nodes;
    std::vector<detail::WideNode<T>> wide;
    std::vector<TreeLeaf> leaves;
    std::vector<std::uint32_t> index;
    std::array<std::vector<T>, 3> coordinates;
    std::array<T, 3> origin;
};

} // namespace

TEST_CASE_TEMPLATE("point tree view: is trivially copyable for any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() { CHECK(std::is_trivially_copyable_v<PointTreeView<V>>); });
}

TEST_CASE_TEMPLATE("point tree view: over copied arrays finds what the tree finds after its owner is gone", T, float,
                   double) {
    using V = glm::vec<3, T>;
    tests::Draws draw(81);
    std::vector<V> points;
    for (int i = 0; i < 3000; ++i)
        points.push_back(tests::narrow<V>(draw.in_cube()));
    const auto tree = std::make_unique<PointTree<V>>(points.size(), [&](std::size_t i) { return points[i]; });
    const Copied<V> copied(tree->view().arrays());
    const PointTreeView<V> view = copied.view();
    CHECK(view.bounds().low == tree->bounds().low);
    CHECK(view.origin() == tree->origin());
    for (int round = 0; round < 50; ++round) {
        const V place = tests::narrow<V>(draw.in_cube());
        CHECK(view.relative(place) == tree->relative(place));
        CHECK(view.nearest_leaf(place) == tree->nearest_leaf(place));
        const Box<T> box{{place.x, place.y, place.z}, {place.x + T(0.2), place.y + T(0.2), place.z + T(0.2)}};
        std::vector<std::uint32_t> expected, found;
        tree->visit_leaves(box, [&](std::uint32_t leaf) { expected.push_back(leaf); });
        view.visit_leaves(box, [&](std::uint32_t leaf) { found.push_back(leaf); });
        CHECK(found == expected);
        // A device walks the binary nodes, which need no stack.
        found.clear();
        const auto visit = [&](std::uint32_t leaf) { found.push_back(leaf); };
        const auto enters = [&](std::uint32_t, const Box<T>& other) { return other.overlaps(box); };
        detail::walk_nodes(view.nodes(), 0, enters, visit);
        CHECK(found == expected);
        std::array<Neighbour<T>, 7> nearest, other;
        REQUIRE(view.nearest(place, nearest) == 7);
        REQUIRE(tree->nearest(place, other) == 7);
        for (std::size_t i = 0; i < 7; ++i)
            CHECK(nearest[i].slot == other[i].slot);
    }
}

} // namespace nephroid::tests::point_tree_view_test
