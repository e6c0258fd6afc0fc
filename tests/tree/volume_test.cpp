// SPDX-License-Identifier: MIT
#include "nephroid/tree/volume.hpp"

#include "nephroid/tree/point_tree.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::volume_test {

namespace {

using V = glm::dvec3;

/// A renderer's own volume.
struct Ball {
    V centre;
    double radius;

    [[nodiscard]] bool overlaps(const Box<double>& box) const {
        double distance2 = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = std::size_t(axis);
            distance2 += square((std::max)({0.0, box.low[i] - centre[axis], centre[axis] - box.high[i]}));
        }
        return distance2 <= square(radius);
    }
};

/// A box by another name, which goes the way of any volume.
struct Wrapped {
    Box<double> box;
    [[nodiscard]] bool overlaps(const Box<double>& other) const { return box.overlaps(other); }
};

static_assert(Volume<Ball, double> && Volume<Box<float>, float> && Volume<Wrapped, double>);
static_assert(!Volume<int, double> && !Volume<Ball, float>);
static_assert(!FacingVolume<Ball, double> && FacingVolume<Facing<double, Ball>, double>);

std::vector<V> some_points(int count) {
    tests::Draws draw(61);
    std::vector<V> points;
    for (int i = 0; i < count; ++i)
        points.push_back(tests::narrow<V>(draw.in_cube()));
    return points;
}

} // namespace

TEST_CASE("volume: a box and the same box as any volume meet the same leaves in the same order") {
    const auto points = some_points(20'000);
    const PointTree<V> tree(points.size(), [&](std::size_t i) { return points[i]; });
    tests::Draws draw(62);
    std::size_t met = 0;
    for (int round = 0; round < 200; ++round) {
        const V centre = tree.relative(points[std::size_t(draw.in(0, 20'000))]);
        const double half = std::exp2(draw.in(-8, 0));
        const Box<double> box{{centre.x - half, centre.y - half, centre.z - half},
                              {centre.x + half, centre.y + half, centre.z + half}};
        std::vector<std::uint32_t> as_box, as_volume;
        tree.visit_leaves(box, [&](std::uint32_t leaf) { as_box.push_back(leaf); });
        tree.visit_leaves(Wrapped{box}, [&](std::uint32_t leaf) { as_volume.push_back(leaf); });
        REQUIRE(as_box == as_volume);
        met += as_box.size();
    }
    CHECK(met > 200);
}

TEST_CASE("volume: a volume of the renderer's own finds the points that brute force finds") {
    const auto points = some_points(20'000);
    const PointTree<V> tree(points.size(), [&](std::size_t i) { return points[i]; });
    tests::Draws draw(63);
    for (int round = 0; round < 50; ++round) {
        const Ball ball{tree.relative(points[std::size_t(draw.in(0, 20'000))]), std::exp2(draw.in(-6, -1))};
        const auto is_inside = [&](const V& p) { return length2(V(p - ball.centre)) <= square(ball.radius); };
        std::size_t expected = 0, found = 0, tested = 0;
        for (const V& p : points)
            expected += is_inside(tree.relative(p));
        tree.visit_leaves(ball, [&](std::uint32_t number) {
            const TreeLeaf leaf = tree.leaves()[number];
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                found += is_inside({tree.x()[slot], tree.y()[slot], tree.z()[slot]});
            tested += leaf.size;
        });
        CHECK(found == expected);
        CHECK(tested < points.size());
    }
}

// A tree alone knows no normals.
TEST_CASE("volume: one that asks for normals gets all leaves of a tree without any") {
    const auto points = some_points(2000);
    const PointTree<V> tree(points.size(), [&](std::size_t i) { return points[i]; });
    const Box<double> everything{{-2, -2, -2}, {2, 2, 2}};
    std::size_t leaves = 0;
    tree.visit_leaves(Facing{everything, std::array{0.0, 0.0, 1.0}}, [&](std::uint32_t) { ++leaves; });
    CHECK(leaves == tree.leaves().size());
}

} // namespace nephroid::tests::volume_test
