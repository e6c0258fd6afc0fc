// SPDX-License-Identifier: MIT
#include "nephroid/estimate/splat_reach.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace nephroid;
using tests::Draws;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
struct Vertex {
    Vec<T> position, normal;
};

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

// Every vertex of every leaf is asked by itself. Many leaves must be told to be out of reach, or the test shows nothing.
TEST_CASE_TEMPLATE("splat reach: no leaf is left out that has a vertex in the splat and no check that one fails", T,
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
            const auto splat = make_splat(deposit, map, SplatPolicies<>{}).splat;
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

// Two walls of a corner: a photon on one has nothing to do with the other, and where it shines along a flat leaf no vertex
// of it is asked.
TEST_CASE("splat reach: a flat leaf that lies along the photon's normal is not met") {
    using V = glm::vec3;
    std::vector<Vertex<float>> wall;
    for (int i = 0; i < 256; ++i)
        wall.push_back({{0, float(i % 16) / 16, float(i / 16) / 16}, {1, 0, 0}});
    const EyePathMap<V> map(wall, &Vertex<float>::position, &Vertex<float>::normal);
    const Deposit<V, float> on_floor{{0.1f, 0.5f, 0}, {0, 0, 1}, {0, 0, -1}, 1, {V(1, 0, 0), V(0, 1, 0)}};
    const auto splat = make_splat(on_floor, map, SplatPolicies<>{}).splat;
    REQUIRE(splat);
    const detail::SplatReach<V, float> reach(*splat);
    for (std::uint32_t leaf = 0; leaf < map.tree().leaves().size(); ++leaf)
        CHECK(!reach(map.leaf(leaf)).meets);
}
