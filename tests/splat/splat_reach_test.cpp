// SPDX-License-Identifier: MIT
#include "nephroid/splat/splat_reach.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"
#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace nephroid::tests::splat_reach_test {

using tests::Draws;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
using Vertex = tests::Vertex<Vec<T>>;

template <class T>
Vec<T> unit(Draws& draw) {
    return tests::narrow<Vec<T>>(draw.direction());
}

/// Bumps of a thousand vertices; flat ones as well, where all normals are the same.
template <class T>
std::vector<Vertex<T>> bumps(Draws& draw, double height) {
    std::vector<Vertex<T>> vertices;
    for (int i = 0; i < 1000; ++i) {
        const double x = draw.in(-1, 1), y = draw.in(-1, 1);
        const Vec<T> normal(T(-3 * height * std::cos(3 * x)), 0, 1);
        vertices.push_back({{T(x), T(y), T(height * std::sin(3 * x))}, normalize(normal)});
    }
    return vertices;
}

} // namespace

// Every vertex of every leaf is asked by itself. Many leaves must be told to be out of reach, or the test shows
// nothing.
TEST_CASE_TEMPLATE("splat reach: no leaf with a vertex in the splat is skipped nor a check that a vertex fails", T,
                   float, double) {
    Draws draw(1);
    int wrong = 0, left_out = 0, unchecked = 0;
    for (const double height : {0.0, 0.05, 1.0}) {
        const auto vertices = bumps<T>(draw, height);
        const EyePathMap<Vec<T>> map(vertices, &Vertex<T>::position, &Vertex<T>::normal);
        for (int i = 0; i < 200; ++i) {
            const auto& at = vertices[std::size_t(draw.in(0, 1000))];
            const Vec<T> n = i % 3 == 0 ? unit<T>(draw) : at.normal, u = normalize(cross(n, unit<T>(draw))),
                         v = cross(n, u);
            const T major = T(draw.in(0.02, 1)), minor = T(draw.in(0.01, 1)) * major;
            const Deposit<Vec<T>, T> deposit{at.position, n, -n, 1, {T(2) * major * u, T(2) * minor * (v + u)}};
            const auto splat = make_splat(deposit, map, Published{}).splat;
            REQUIRE(splat);
            const detail::SplatReach<Vec<T>, T> reach(*splat);
            const PointTree<Vec<T>>& tree = map.tree();
            for (std::uint32_t leaf = 0; leaf < tree.leaves().size(); ++leaf) {
                const detail::LeafMeeting meeting = reach(map.leaf(leaf));
                left_out += !meeting.meets;
                unchecked += meeting.meets && !meeting.checks_height && !meeting.checks_normals;
                const TreeLeaf range = tree.leaves()[leaf];
                for (std::size_t slot = range.first; slot < range.first + range.size; ++slot) {
                    const Vec<T> d = Vec<T>(tree.x()[slot], tree.y()[slot], tree.z()[slot]) - splat->centre;
                    const Vec<T> normal(map.normal_x()[slot], map.normal_y()[slot], map.normal_z()[slot]);
                    const bool inside = square(dot(splat->row_a, d)) + square(dot(splat->row_b, d)) < T(1);
                    const bool low = std::abs(dot(splat->row_n, d))<T(1), faces = dot(normal, splat->normal)> T(0);
                    wrong += meeting.meets ? (!meeting.checks_height && !low) || (!meeting.checks_normals && !faces)
                                           : inside && faces;
                }
            }
        }
    }
    CHECK(wrong == 0);
    CHECK(left_out > 1000);
    CHECK(unchecked > 100);
}

// A needle's rows are as long as its width is small, so that at a vertex far along it terms of 3000 cancel to the 1
// that is compared: they round by a thousandth, elsewhere in a leaf otherwise than at its vertices. Each leaf here is
// two vertices at the needle's border, a few roundings apart, and by what is computed for themselves some are just
// inside.
TEST_CASE_TEMPLATE("splat reach: rounding along a needle skips no vertex", T, float, double) {
    using V = Vec<T>;
    constexpr double epsilon = double(std::numeric_limits<T>::epsilon());
    Draws draw(2);
    int wrong = 0, inside = 0, low = 0;
    for (int i = 0; i < 20000; ++i) {
        const tests::Space along = draw.direction(), across = draw.direction().across(along).unit();
        const tests::Space centre = tests::Wide(10) * draw.in_cube();
        const V row = tests::narrow<V>(tests::Wide(1e3) * across), normal = tests::narrow<V>(along.cross(across));
        const Splat<V, T> splat{.centre = tests::narrow<V>(centre),
                                .row_a = row,
                                .row_b = tests::narrow<V>(tests::Wide(1e-12) * along),
                                .row_n = row,
                                .normal = normal,
                                .direction = -normal,
                                .peak = 1,
                                .box = {}};
        const auto at_border = [&] {
            const double beside = 1e-3 * (1 + draw.in(-1e4, 1e4) * epsilon);
            return tests::narrow<V>(centre + tests::Wide(3) * along + tests::Wide(beside) * across +
                                    tests::Wide(4 * epsilon) * draw.in_cube());
        };
        const std::array<V, 2> vertices{at_border(), at_border()};
        EyePathLeaf<T> leaf{};
        for (int axis = 0; axis < 3; ++axis) { // as the map does
            const auto [least, most] = std::minmax(vertices[0][axis], vertices[1][axis]);
            leaf.middle[std::size_t(axis)] = T(0.5) * least + T(0.5) * most;
            leaf.half[std::size_t(axis)] =
                std::max(most - leaf.middle[std::size_t(axis)], leaf.middle[std::size_t(axis)] - least);
            leaf.normals.axis[std::size_t(axis)] = normal[axis];
        }
        const detail::LeafMeeting meeting = detail::SplatReach<V, T>(splat)(leaf);
        for (const V& vertex : vertices) {
            const V d = vertex - splat.centre;
            const bool is_inside = square(dot(splat.row_a, d)) + square(dot(splat.row_b, d)) < T(1);
            const bool is_low = std::abs(dot(splat.row_n, d)) < T(1);
            wrong += (is_inside && !meeting.meets) || (!is_low && !meeting.checks_height);
            inside += is_inside, low += is_low;
        }
    }
    CHECK(wrong == 0);
    for (const int some : {inside, low}) {
        CHECK(some > 10000);
        CHECK(some < 30000);
    }
}

// A photon within a leaf, whose far end is one height away but for a few roundings: no terms cancel, and what is left
// is the rounding of the leaf's own half.
TEST_CASE_TEMPLATE("splat reach: rounding at the end of a leaf around the photon skips no vertex", T, float, double) {
    using V = Vec<T>;
    constexpr double epsilon = double(std::numeric_limits<T>::epsilon());
    Draws draw(4);
    int wrong = 0, low = 0;
    for (int i = 0; i < 20000; ++i) {
        const double scale = draw.in(0.5, 2), at = draw.in(-1, 1);
        const V centre(0, 0, T(at)), flat(T(1e-3), T(1e-3), 0), normal(0, 0, 1);
        const T high = T(at + (1 + draw.in(-4, 4) * epsilon) / scale), deep = T(at - draw.in(0, 1) / scale);
        const Splat<V, T> splat{.centre = centre,
                                .row_a = flat,
                                .row_b = flat,
                                .row_n = T(scale) * normal,
                                .normal = normal,
                                .direction = -normal,
                                .peak = 1,
                                .box = {}};
        EyePathLeaf<T> leaf{}; // as the map does
        leaf.middle[2] = T(0.5) * deep + T(0.5) * high;
        leaf.half[2] = std::max(high - leaf.middle[2], leaf.middle[2] - deep);
        leaf.normals.axis[2] = T(1);
        const bool is_low = std::abs(dot(splat.row_n, V(0, 0, high) - centre)) < T(1);
        wrong += !is_low && !detail::SplatReach<V, T>(splat)(leaf).checks_height;
        low += is_low;
    }
    CHECK(wrong == 0);
    CHECK(low > 5000);
    CHECK(low < 15000);
}

// Normals that differ by little, all but across the photon's: the ones that face it do so by a rounding.
TEST_CASE_TEMPLATE("splat reach: rounding of normals perpendicular to the photon skips no vertex", T, float, double) {
    using V = Vec<T>;
    constexpr double epsilon = double(std::numeric_limits<T>::epsilon());
    Draws draw(3);
    int wrong = 0, facing = 0;
    for (int i = 0; i < 20000; ++i) {
        const tests::Space n = draw.direction(), axis = draw.direction().across(n).unit();
        const auto nearly = [&](double by) {
            return tests::narrow<V>((n + tests::Wide(by * epsilon) * draw.in_cube()).unit());
        };
        const double spread = i % 2 == 0 ? 4 : 1000;
        const std::array<Vertex<T>, 2> vertices{Vertex<T>{V(0), nearly(spread)}, {V(0), nearly(spread)}};
        const EyePathMap<V> map(vertices, &Vertex<T>::position, &Vertex<T>::normal);
        const V normal = tests::narrow<V>((axis + tests::Wide(draw.in(-1, 1) * spread * epsilon) * n).unit());
        const V row = tests::narrow<V>(n); // the vertices are its centre
        const Splat<V, T> splat{.centre = V(0),
                                .row_a = row,
                                .row_b = row,
                                .row_n = row,
                                .normal = normal,
                                .direction = -normal,
                                .peak = 1,
                                .box = {}};
        const detail::LeafMeeting meeting = detail::SplatReach<V, T>(splat)(map.leaf(0));
        for (std::size_t slot = 0; slot < 2; ++slot) {
            const bool faces = dot(V(map.normal_x()[slot], map.normal_y()[slot], map.normal_z()[slot]), normal) > T(0);
            wrong += faces ? !meeting.meets : meeting.meets && !meeting.checks_normals;
            facing += faces;
        }
    }
    CHECK(wrong == 0);
    CHECK(facing > 10000);
    CHECK(facing < 30000);
}

// Two walls of a corner: a photon on one has nothing to do with the other, and where it shines along a flat leaf no
// vertex of it is asked.
TEST_CASE("splat reach: a flat leaf along the photon's normal does not overlap") {
    using V = glm::vec3;
    std::vector<Vertex<float>> wall;
    for (int i = 0; i < 256; ++i)
        wall.push_back({{0, float(i % 16) / 16, float(i / 16) / 16}, {1, 0, 0}});
    const EyePathMap<V> map(wall, &Vertex<float>::position, &Vertex<float>::normal);
    const Deposit<V, float> on_floor{{0.1f, 0.5f, 0}, {0, 0, 1}, {0, 0, -1}, 1, {V(1, 0, 0), V(0, 1, 0)}};
    const auto splat = make_splat(on_floor, map, Published{}).splat;
    REQUIRE(splat);
    const detail::SplatReach<V, float> reach(*splat);
    for (std::uint32_t leaf = 0; leaf < map.tree().leaves().size(); ++leaf)
        CHECK(!reach(map.leaf(leaf)).meets);
}

} // namespace nephroid::tests::splat_reach_test
