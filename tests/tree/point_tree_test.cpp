// SPDX-License-Identifier: MIT
#include "nephroid/tree/point_tree.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace nephroid::tests::point_tree_test {

using tests::Draws;

namespace {

template <class V>
using Cloud = std::vector<V>;

template <class V>
V point(double x, double y, double z) {
    using T = scalar_t<V>;
    return make_vector<V>(T(x), T(y), T(z));
}

template <class V>
Cloud<V> random_cloud(int count, double size, double offset = 0) {
    Draws draw(31);
    Cloud<V> cloud;
    for (int i = 0; i < count; ++i)
        cloud.push_back(point<V>(offset + draw.in(0, size), offset + draw.in(0, size), offset + draw.in(0, size)));
    return cloud;
}

/// Every awkward cloud by name.
template <class V, class F>
void for_each_cloud(const F& test) {
    const auto run = [&](const char* name, const Cloud<V>& cloud) {
        INFO("cloud: ", name);
        test(cloud);
    };
    run("empty", {});
    run("one point", {point<V>(1, 2, 3)});
    run("two points", {point<V>(1, 2, 3), point<V>(-1, 2, 3)});
    run("as many as a leaf holds", random_cloud<V>(64, 1));
    run("one more than a leaf holds", random_cloud<V>(65, 1));
    run("1000 coincident points", Cloud<V>(1000, point<V>(0.1, -7, 1e-3)));
    run("a random cloud", random_cloud<V>(3000, 2));
    run("far from the origin", random_cloud<V>(1000, 1, 1e5));

    Cloud<V> collinear, duplicated, lattice, exponential, two_scales;
    for (int i = 0; i < 700; ++i)
        collinear.push_back(point<V>(0.3 * i, -0.1 * i, 0));
    run("collinear", collinear);
    for (const V& p : random_cloud<V>(300, 1))
        duplicated.insert(duplicated.end(), 3, p);
    run("every point three times", duplicated);
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j)
            lattice.push_back(point<V>(i, j, 0));
    run("a lattice", lattice);
    // Each split at a middle cuts off a few points: about as deep a tree as there can be.
    for (int i = 0; i < 400; ++i)
        exponential.push_back(point<V>(std::ldexp(1, -i / 4), std::ldexp(1 + i % 4, -i / 4), -std::ldexp(1, -i / 4)));
    run("exponentially clustered", exponential);
    for (const double scale : {1.0, 1e-3, 1e-6, 1e-9, 1e-12})
        for (const V& p : random_cloud<V>(150, scale))
            two_scales.push_back(p);
    run("clusters within clusters", two_scales);
    const double huge = 0.9 * double(std::numeric_limits<scalar_t<V>>::max());
    run("from one end of the number line to the other",
        {point<V>(-huge, 0, 0), point<V>(huge, 0, 1), point<V>(0, huge, 0)});
}

template <class V>
PointTree<V> tree_of(const Cloud<V>& cloud) {
    return PointTree<V>(cloud.size(), [&](std::size_t i) { return cloud[i]; });
}

template <class V>
std::array<scalar_t<V>, 3> coordinates(const V& v) {
    using t = vector_traits<V>;
    return {t::x(v), t::y(v), t::z(v)};
}

template <class T>
bool contains(const Box<T>& box, const std::array<T, 3>& p) {
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
        inside = inside && box.low[axis] <= p[axis] && p[axis] <= box.high[axis];
    return inside;
}

template <class V>
std::array<scalar_t<V>, 3> at_slot(const PointTree<V>& tree, std::size_t slot) {
    return {tree.x()[slot], tree.y()[slot], tree.z()[slot]};
}

/// The boxes of the leaves, in order.
template <class V>
std::vector<Box<scalar_t<V>>> leaf_boxes(const PointTree<V>& tree) {
    std::vector<Box<scalar_t<V>>> boxes;
    for (const auto& node : tree.nodes())
        if (node.leaf != no_leaf) {
            CHECK(node.leaf == boxes.size());
            boxes.push_back(node.box);
        }
    CHECK(boxes.size() == tree.leaves().size());
    return boxes;
}

} // namespace

TEST_CASE_TEMPLATE("point tree: holds every point exactly once and repeats only to fill up a leaf", T, float, double) {
    using V = glm::vec<3, T>;
    for_each_cloud<V>([](const Cloud<V>& cloud) {
        const PointTree<V> tree = tree_of(cloud);
        CHECK(tree.empty() == cloud.empty());
        std::vector<int> seen(cloud.size());
        std::size_t next = 0;
        for (const TreeLeaf& leaf : tree.leaves()) {
            REQUIRE(leaf.first == next);
            REQUIRE(leaf.first % PointTree<V>::lanes == 0);
            REQUIRE(leaf.size >= 1);
            REQUIRE(leaf.size <= PointTree<V>::leaf_size);
            next += (leaf.size + PointTree<V>::lanes - 1) / PointTree<V>::lanes * PointTree<V>::lanes;
            REQUIRE(next <= tree.slots());
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
                ++seen.at(tree.index(slot));
                const V relative = tree.relative(cloud[tree.index(slot)]);
                REQUIRE(at_slot(tree, slot) == coordinates(relative)); // the same subtraction
            }
            for (std::size_t slot = leaf.first + leaf.size; slot < next; ++slot) {
                REQUIRE(tree.index(slot) == tree.index(leaf.first + leaf.size - 1));
                REQUIRE(at_slot(tree, slot) == at_slot(tree, leaf.first + leaf.size - 1));
            }
        }
        CHECK(next == tree.slots());
        CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
    });
}

TEST_CASE_TEMPLATE("point tree: every node's box is tight about the points below it", T, float, double) {
    using V = glm::vec<3, T>;
    for_each_cloud<V>([](const Cloud<V>& cloud) {
        const PointTree<V> tree = tree_of(cloud);
        const auto nodes = tree.nodes();
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            REQUIRE(nodes[i].skip > i);
            REQUIRE(nodes[i].skip <= nodes.size());
            constexpr T infinity = std::numeric_limits<T>::infinity();
            Box<T> tight{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
            for (std::size_t k = i; k < nodes[i].skip; ++k) {
                if (nodes[k].leaf == no_leaf)
                    continue;
                const TreeLeaf leaf = tree.leaves()[nodes[k].leaf];
                for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        tight.low[axis] = (std::min)(tight.low[axis], at_slot(tree, slot)[axis]);
                        tight.high[axis] = (std::max)(tight.high[axis], at_slot(tree, slot)[axis]);
                    }
            }
            REQUIRE(nodes[i].box.low == tight.low);
            REQUIRE(nodes[i].box.high == tight.high);
        }
        if (!cloud.empty()) {
            CHECK(tree.bounds().low == nodes[0].box.low);
            CHECK(tree.bounds().high == nodes[0].box.high);
            CHECK(all_finite(tree.origin()));
        } else {
            CHECK(tree.bounds().low[0] > tree.bounds().high[0]);
        }
    });
}

TEST_CASE_TEMPLATE("point tree: a box meets exactly the leaves that brute force finds", T, float, double) {
    using V = glm::vec<3, T>;
    for_each_cloud<V>([](const Cloud<V>& cloud) {
        const PointTree<V> tree = tree_of(cloud);
        const auto boxes = leaf_boxes(tree);
        Draws draw(32);
        for (int query = 0; query < 200; ++query) {
            Box<T> box{{-1, -1, -1}, {1, 1, 1}};
            if (!cloud.empty()) {
                // About a point, by sizes from none to all.
                const std::size_t about = std::size_t(draw.in(0, double(cloud.size())));
                const auto centre = coordinates(tree.relative(cloud[about]));
                const auto& bounds = tree.bounds();
                const T part = query % 8 == 0 ? T(0) : T(std::pow(2.0, draw.in(-24, 1)));
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    const T half = part * (T(0.5) * bounds.high[axis] - T(0.5) * bounds.low[axis]);
                    box.low[axis] = centre[axis] - half;
                    box.high[axis] = centre[axis] + half;
                }
            }
            std::vector<std::uint32_t> visited, expected;
            tree.visit_leaves(box, [&](std::uint32_t leaf) { visited.push_back(leaf); });
            std::size_t inside = 0, found = 0;
            for (std::uint32_t leaf = 0; leaf < boxes.size(); ++leaf) {
                bool overlaps = true;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    overlaps =
                        overlaps && boxes[leaf].low[axis] <= box.high[axis] && box.low[axis] <= boxes[leaf].high[axis];
                if (overlaps)
                    expected.push_back(leaf);
            }
            REQUIRE(visited == expected); // in leaf order, each once
            for (const V& p : cloud)
                inside += contains(box, coordinates(tree.relative(p)));
            for (const std::uint32_t leaf : visited)
                for (std::size_t i = 0; i < tree.leaves()[leaf].size; ++i)
                    found += contains(box, at_slot(tree, tree.leaves()[leaf].first + i));
            REQUIRE(found == inside);
        }
    });
}

TEST_CASE_TEMPLATE("point tree: the nearest leaf is the one that brute force finds", T, float, double) {
    using V = glm::vec<3, T>;
    for_each_cloud<V>([](const Cloud<V>& cloud) {
        if (cloud.empty())
            return;
        const PointTree<V> tree = tree_of(cloud);
        const auto boxes = leaf_boxes(tree);
        const auto distance = [&](std::uint32_t leaf, const V& p) {
            T worst(0);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const T x = coordinates(p)[axis];
                const T outside = x < boxes[leaf].low[axis]    ? boxes[leaf].low[axis] - x
                                  : x > boxes[leaf].high[axis] ? x - boxes[leaf].high[axis]
                                                               : T(0);
                worst = (std::max)(worst, outside);
            }
            return worst;
        };
        Draws draw(33);
        for (int query = 0; query < 200; ++query) {
            V p = tree.relative(cloud[std::size_t(draw.in(0, double(cloud.size())))]);
            if (query % 4 != 0) {
                const T part = T(std::pow(2.0, draw.in(-20, 2)));
                const auto extent = [&](std::size_t axis) {
                    return part * (T(0.5) * tree.bounds().high[axis] - T(0.5) * tree.bounds().low[axis]) * T(0.1);
                };
                p = p + make_vector<V>(extent(0), -extent(1), extent(2));
            }
            T least = std::numeric_limits<T>::infinity();
            for (std::uint32_t leaf = 0; leaf < boxes.size(); ++leaf)
                least = (std::min)(least, distance(leaf, p));
            REQUIRE(tree.nearest_leaf(p) < boxes.size());
            REQUIRE(distance(tree.nearest_leaf(p), p) == least);
        }
    });
}

TEST_CASE("point tree: no point is nearest to a place that is no number") {
    std::vector<glm::vec3> cloud;
    for (int i = 0; i < 200; ++i)
        cloud.push_back({float(i), 0, 0});
    const PointTree<glm::vec3> tree(cloud.size(), [&](std::size_t i) { return cloud[i]; });
    std::vector<Neighbour<float>> found(300); // more than there are: all would do, were the place not looked at
    CHECK(tree.nearest({0, std::nanf(""), 0}, found) == 0);
}

// Distances agree to four roundings: the compiler may fuse a product and a sum in one place and not in the other.
TEST_CASE_TEMPLATE("point tree: the nearest points are those that brute force finds", T, float, double) {
    using V = glm::vec<3, T>;
    for_each_cloud<V>([](const Cloud<V>& cloud) {
        const PointTree<V> tree = tree_of(cloud);
        Draws draw(34);
        for (int query = 0; query < 40; ++query) {
            V place{0, 0, 0};
            if (!cloud.empty()) {
                const V corner{tree.bounds().high[0], tree.bounds().low[1], tree.bounds().high[2]};
                place = tree.relative(cloud[std::size_t(draw.in(0, double(cloud.size())))]) +
                        T(query % 4) * T(0.3) * corner;
            }
            std::vector<T> all;
            for (const V& p : cloud)
                all.push_back(length2(V(tree.relative(p) - place)));
            std::sort(all.begin(), all.end());
            for (const std::size_t wanted : {0u, 1u, 9u, 100u}) {
                std::vector<Neighbour<T>> found(wanted);
                const std::size_t count = tree.nearest(place, found);
                REQUIRE(count == (std::min)(wanted, cloud.size()));
                found.resize(count);
                std::sort(found.begin(), found.end(),
                          [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
                std::vector<std::uint32_t> indices;
                for (std::size_t i = 0; i < count; ++i) {
                    const std::uint32_t slot = found[i].slot;
                    const V d = V{tree.x()[slot], tree.y()[slot], tree.z()[slot]} - place;
                    const auto same = [](T a, T b) {
                        return a == b || std::abs(a - b) <= 4 * std::numeric_limits<T>::epsilon() * b;
                    };
                    REQUIRE(same(found[i].distance2, length2(d)));
                    REQUIRE(same(found[i].distance2, all[i]));
                    indices.push_back(tree.index(slot));
                }
                std::sort(indices.begin(), indices.end());
                REQUIRE(std::adjacent_find(indices.begin(), indices.end()) == indices.end()); // no point twice
            }
        }
    });
}

// 1e5 units out a float resolves 1/128; its differences to an origin amid the points are exact (Sterbenz).
TEST_CASE("point tree: far from the origin no digit of the given positions is lost") {
    const auto cloud = random_cloud<glm::vec3>(500, 1, 1e5);
    const PointTree<glm::vec3> tree = tree_of(cloud);
    for (std::size_t slot = 0; slot < tree.slots(); ++slot) {
        const double exact = double(cloud[tree.index(slot)].x) - double(tree.origin().x);
        REQUIRE(double(tree.x()[slot]) == exact);
    }
    // About the median: of 500 points in a unit interval it lies within 0.2 of the middle, by nine standard deviations.
    CHECK(tree.bounds().high[0] <= 0.71f);
    CHECK(tree.bounds().low[0] >= -0.71f);
}

TEST_CASE("point tree: says which point is not finite") {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (const glm::vec3& bad : {glm::vec3{nan, 0, 0}, {0, infinity, 0}, {0, 0, -infinity}}) {
        auto cloud = random_cloud<glm::vec3>(20, 1);
        cloud[13] = bad;
        try {
            (void)PointTree<glm::vec3>(
                cloud.size(), [&](std::size_t i) { return cloud[i]; }, "renderer::Map");
            FAIL("took it");
        } catch (const std::invalid_argument& error) {
            const std::string message = error.what();
            CHECK(message.starts_with("renderer::Map: "));
            CHECK(message.find("point 13 ") != std::string::npos);
        }
    }
}

TEST_CASE_TEMPLATE("point tree: takes any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const auto cloud = random_cloud<V>(300, 1);
        const PointTree<V> tree = tree_of(cloud);
        std::vector<int> seen(cloud.size());
        for (const TreeLeaf& leaf : tree.leaves())
            for (std::size_t i = 0; i < leaf.size; ++i)
                ++seen[tree.index(leaf.first + i)];
        CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
        CHECK(tree.nearest_leaf(tree.relative(cloud[7])) < tree.leaves().size());
    });
}

TEST_CASE_TEMPLATE("point tree: the nearest points within a limit and of those accepted are counted", T, float,
                   double) {
    using V = glm::vec<3, T>;
    const auto cloud = random_cloud<V>(2000, 1);
    const PointTree<V> tree = tree_of(cloud);
    Draws draw(35);
    for (int query = 0; query < 60; ++query) {
        const V place = tree.relative(point<V>(draw.in(-0.2, 1.2), draw.in(-0.2, 1.2), draw.in(-0.2, 1.2)));
        const T limit2 = T(query % 3 == 0 ? 1e-4 : query % 3 == 1 ? 0.02 : 10);
        const auto accepts = [&](std::size_t slot) { return tree.index(slot) % 3 == 0; };
        std::vector<T> all;
        for (std::size_t i = 0; i < cloud.size(); i += 3)
            if (const T d2 = length2(V(tree.relative(cloud[i]) - place)); d2 < limit2)
                all.push_back(d2);
        std::sort(all.begin(), all.end());
        for (const std::size_t wanted : {1u, 10u, 200u, 1000u}) {
            std::vector<Neighbour<T>> found(wanted);
            const std::size_t count = tree.nearest(place, found, limit2, accepts);
            REQUIRE(count == (std::min)(wanted, all.size()));
            found.resize(count);
            std::sort(found.begin(), found.end(),
                      [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
            for (std::size_t i = 0; i < count; ++i) {
                REQUIRE(accepts(found[i].slot));
                REQUIRE(std::abs(found[i].distance2 - all[i]) <= 4 * std::numeric_limits<T>::epsilon() * all[i]);
            }
        }
    }
}

// Heaps of a leaf's points, each half as far from the next one: more levels than wait for their turn at a time.
TEST_CASE("point tree: the nearest points are found in a tree hundreds of levels deep") {
    using V = glm::dvec3;
    Cloud<V> cloud;
    for (int level = 0; level < 400; ++level)
        for (int i = 0; i < 40; ++i)
            for (const double side : {-1.0, 1.0}) // so that the origin is 0
                cloud.push_back({std::ldexp(side * (1 + i / 64.0), -level), 0, 0});
    const PointTree<V> tree = tree_of(cloud);
    std::vector<std::uint32_t> ends; // of the subtrees that a node lies in
    std::size_t depth = 0;
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
        while (!ends.empty() && ends.back() <= i)
            ends.pop_back();
        ends.push_back(tree.nodes()[i].skip);
        depth = (std::max)(depth, ends.size());
    }
    REQUIRE(depth > 200);
    for (const double x : {1.0, 1e-3, 1e-20, 1e-60, 0.0}) {
        const V place = tree.relative({x, 0, 0});
        std::vector<Neighbour<double>> found(50);
        REQUIRE(tree.nearest(place, found) == 50);
        std::vector<double> all;
        for (const V& p : cloud)
            all.push_back(square(tree.relative(p).x - place.x));
        std::sort(all.begin(), all.end());
        std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
        for (std::size_t i = 0; i < 50; ++i)
            REQUIRE(found[i].distance2 == doctest::Approx(all[i]).epsilon(1e-14));
    }
}

} // namespace nephroid::tests::point_tree_test
