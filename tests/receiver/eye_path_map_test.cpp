// SPDX-License-Identifier: MIT
#include "nephroid/receiver/eye_path_map.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <deque>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests::eye_path_map_test {

namespace {

/// A renderer's own vertex.
template <class V>
struct Vertex {
    int pixel;
    V position;
    V shading_normal;
};

/// A square lattice of side 1/4 on z = 0, then one of side 1 on the wall x = 100, facing back.
template <class V>
std::vector<Vertex<V>> floor_and_wall() {
    using T = scalar_t<V>;
    std::vector<Vertex<V>> vertices;
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i)
            vertices.push_back({int(vertices.size()), make_vector<V>(T(i) / 4, T(j) / 4, 0), make_vector<V>(0, 0, 1)});
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i)
            vertices.push_back({int(vertices.size()), make_vector<V>(100, T(i), T(j)), make_vector<V>(-1, 0, 0)});
    return vertices;
}

template <class V>
void check_floor_and_wall(const EyePathMap<V>& map) {
    using T = scalar_t<V>;
    const auto vertices = floor_and_wall<V>();
    std::vector<int> seen(vertices.size());
    for (std::uint32_t number = 0; number < map.tree().leaves().size(); ++number) {
        const TreeLeaf leaf = map.tree().leaves()[number];
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
            const std::size_t index = map.tree().index(slot);
            ++seen.at(index);
            const bool on_floor = index < 1024;
            CHECK(map.normal_x()[slot] == (on_floor ? T(0) : T(-1)));
            CHECK(map.normal_y()[slot] == T(0));
            CHECK(map.normal_z()[slot] == (on_floor ? T(1) : T(0)));
            const auto& n = map.leaf(number).normals.axis;
            CHECK(n == std::array<T, 3>{map.normal_x()[slot], map.normal_y()[slot], map.normal_z()[slot]});
        }
        // 100 units apart: no leaf has vertices of both, so every one has a lattice of its own and one normal.
        CHECK(map.leaf(number).normals.spread == T(0));
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](int times) { return times == 1; }));
    CHECK(map.spacing_at(make_vector<V>(T(3), T(3), T(0.01))) == T(0.25));
    CHECK(map.spacing_at(make_vector<V>(T(-50), T(3), T(0))) == T(0.25));
    CHECK(map.spacing_at(make_vector<V>(T(99), T(16), T(16))) == T(1));
    // From (0, 0, 0) to (100, 31, 31).
    CHECK(std::abs(map.diagonal() - std::sqrt(T(10000 + 961 + 961))) <= 4 * std::numeric_limits<T>::epsilon() * 110);
}

template <class Make>
std::string complaint_of(const Make& make) {
    try {
        (void)make();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

} // namespace

TEST_CASE_TEMPLATE("eye path map: reads the user's vertices of any vector type", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const auto vertices = floor_and_wall<V>();
        check_floor_and_wall(EyePathMap<V>(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal));
    });
}

TEST_CASE("eye path map: the vector type is deduced and projections may be members or callables") {
    using V = glm::vec3;
    const auto vertices = floor_and_wall<V>();
    const EyePathMap by_member(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal);
    static_assert(std::is_same_v<decltype(by_member), const EyePathMap<V>>);
    check_floor_and_wall(by_member);

    const std::span<const Vertex<V>> view(vertices);
    const EyePathMap by_value(
        view, [](const Vertex<V>& v) { return v.position; },
        [](const Vertex<V>& v) -> const V& { return v.shading_normal; });
    static_assert(std::is_same_v<decltype(by_value), const EyePathMap<V>>);
    check_floor_and_wall(by_value);

    const std::deque<Vertex<V>> elsewhere(vertices.begin(), vertices.end());
    check_floor_and_wall(EyePathMap(elsewhere, &Vertex<V>::position, &Vertex<V>::shading_normal));

    // A range of indices, into arrays of the renderer's.
    std::vector<int> indices(vertices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
        indices[i] = int(i);
    check_floor_and_wall(EyePathMap(
        indices, [&](int i) { return vertices[std::size_t(i)].position; },
        [&](int i) { return vertices[std::size_t(i)].shading_normal; }));
}

TEST_CASE_TEMPLATE("eye path map: a map without vertices is valid", T, float, double) {
    using V = glm::vec<3, T>;
    const EyePathMap<V> map(std::vector<Vertex<V>>{}, &Vertex<V>::position, &Vertex<V>::shading_normal);
    CHECK(map.tree().empty());
    CHECK(map.diagonal() == 0);
    CHECK(map.spacing_at({1, 2, 3}) == 0);
}

TEST_CASE("eye path map: one vertex or coincident vertices have no spacing") {
    using V = glm::dvec3;
    for (const std::size_t count : {1u, 1000u}) {
        const std::vector<Vertex<V>> vertices(count, {0, {1, 2, 3}, {0, 1, 0}});
        const EyePathMap map(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal);
        CHECK(map.spacing_at({1, 2, 3}) == 0);
        CHECK(map.diagonal() == 0);
    }
}

// Where a hundred vertices lie in one place none of the nearest tells how far apart pixels are.
TEST_CASE("eye path map: a leaf of unknown spacing gets the median of the others") {
    using V = glm::dvec3;
    auto vertices = floor_and_wall<V>();
    vertices.resize(1024);
    vertices.insert(vertices.end(), 100, {0, {1e6, 0, 0}, {0, 0, 1}});
    const EyePathMap map(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal);
    CHECK(map.spacing_at({1e6, 0, 0}) == 0.25);
}

// It is a leaf of its own, and the spacing around it is its neighbours'.
TEST_CASE("eye path map: a lone vertex beside a lattice gets about the lattice's spacing") {
    using V = glm::dvec3;
    auto vertices = floor_and_wall<V>();
    vertices.resize(1024);
    vertices.push_back({0, {20, 0, 0}, {0, 0, 1}});
    const EyePathMap map(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal);
    CHECK(map.spacing_at({20, 0, 0}) >= 0.25);
    CHECK(map.spacing_at({20, 0, 0}) <= 0.75); // at a lattice's corner its neighbours lie on one side only
}

TEST_CASE("eye path map: far from the origin the spacing keeps its digits") {
    using V = glm::vec3;
    std::vector<Vertex<V>> vertices;
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i)
            vertices.push_back({0, {1e5f + float(i) / 64, -1e5f, 1e5f + float(j) / 64}, {0, 1, 0}});
    const EyePathMap map(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal);
    CHECK(map.spacing_at({1e5f, -1e5f, 1e5f}) == 1.0f / 64); // a multiple of a float's step there, 1/128
}

TEST_CASE("eye path map: the message names the vertex with an invalid position or normal") {
    using V = glm::vec3;
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const auto with = [&](const Vertex<V>& bad) {
        return complaint_of([&] {
            auto vertices = floor_and_wall<V>();
            vertices[1234] = bad;
            return EyePathMap(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal);
        });
    };
    for (const V& position : {V{nan, 0, 0}, V{0, infinity, 0}, V{0, 0, -infinity}}) {
        const std::string complaint = with({0, position, {0, 0, 1}});
        CHECK(complaint.starts_with("nephroid::EyePathMap: "));
        CHECK(complaint.find("1234") != std::string::npos);
        CHECK(complaint.find("finite") != std::string::npos);
    }
    for (const V& normal : {V{0, 0, 0}, V{0, 0, 2}, V{1, 1, 0}, V{nan, 0, 1}, V{0, 0, infinity}}) {
        const std::string complaint = with({0, {1, 2, 3}, normal});
        CHECK(complaint.starts_with("nephroid::EyePathMap: "));
        CHECK(complaint.find("vertex 1234 ") != std::string::npos);
        CHECK(complaint.find("unit length") != std::string::npos);
    }
    // A half-precision normal is unit enough.
    CHECK(with({0, {1, 2, 3}, {0, 0.6001f, 0.8002f}}) == "none");
}

// A room whose walls lie along the axes, the commonest scene there is: the points of a wall have no extent across it,
// and a tree that halves boxes without looking at the points in them cuts walls into rags. Leaves that reach around an
// edge mix two lattices: with 96 x 96 vertices a wall, fewer than a tenth.
TEST_CASE_TEMPLATE("eye path map: the spacing on the walls of a room is that of the lattice", T, float, double) {
    using V = glm::vec<3, T>;
    constexpr int n = 96;
    std::vector<Vertex<V>> vertices;
    for (int wall = 0; wall < 5; ++wall)
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const T a = (T(i) + T(0.5)) / n, b = (T(j) + T(0.5)) / n;
                const std::array<V, 5> at{V{a, b, 0}, {a, b, 1}, {0, a, b}, {1, a, b}, {a, 1, b}};
                const std::array<V, 5> normal{V{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}};
                vertices.push_back({wall, at[std::size_t(wall)], normal[std::size_t(wall)]});
            }
    const EyePathMap map(vertices, &Vertex<V>::position, &Vertex<V>::shading_normal);
    const auto leaves = std::uint32_t(map.tree().leaves().size());
    std::uint32_t off = 0;
    for (std::uint32_t leaf = 0; leaf < leaves; ++leaf)
        off += std::abs(double(map.leaf(leaf).spacing) * n - 1) > 0.02;
    CAPTURE(leaves);
    CHECK(off < leaves / 10);
}

// Whether a whole leaf faces a photon is told from these two.
TEST_CASE("eye path map: a leaf's cone contains all of its normals") {
    struct Vertex {
        glm::vec3 position, normal;
    };
    std::vector<Vertex> ball;
    for (int i = 0; i < 2000; ++i) {
        const float z = 1 - float(2 * i + 1) / 2000, turn = 2.399963f * float(i), radius = std::sqrt(1 - z * z);
        const glm::vec3 at(radius * std::cos(turn), radius * std::sin(turn), z);
        ball.push_back({at, at});
    }
    const EyePathMap<glm::vec3> map(ball, &Vertex::position, &Vertex::normal);
    for (std::uint32_t number = 0; number < map.tree().leaves().size(); ++number) {
        const auto& known = map.leaf(number);
        const TreeLeaf leaf = map.tree().leaves()[number];
        float largest = 0;
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
            largest = (std::max)(largest, std::hypot(map.normal_x()[slot] - known.normals.axis[0],
                                                     map.normal_y()[slot] - known.normals.axis[1],
                                                     map.normal_z()[slot] - known.normals.axis[2]));
        CHECK(largest <= known.normals.spread * (1 + 1e-6f));
        CHECK(known.normals.spread <
              2 * largest); // a leaf of 50 in 2000 is a twentieth of a ball: its bounds' corner is near
    }
}

// A vertex at one end of a leaf is asked about through the leaf's middle, which is rounded: by as much as a millionth
// of its distance from the origin, where the leaf itself may be smaller than that.
TEST_CASE_TEMPLATE("eye path map: no vertex lies outside its leaf even far from the origin", T, float, double) {
    using V = glm::vec<3, T>;
    struct Vertex {
        V position, normal;
    };
    tests::Draws draw(9);
    std::vector<Vertex> vertices;
    for (int cluster = 0; cluster < 100; ++cluster) {
        const tests::Space middle = tests::Wide(1000) * draw.in_cube();
        for (int i = 0; i < 40; ++i) {
            const double size = 64 * double(std::numeric_limits<T>::epsilon()) * 1000;
            vertices.push_back({tests::narrow<V>(middle + tests::Wide(size) * draw.in_cube()), {0, 0, 1}});
        }
    }
    const EyePathMap<V> map(vertices, &Vertex::position, &Vertex::normal);
    const PointTree<V>& tree = map.tree();
    int outside = 0;
    for (std::uint32_t number = 0; number < tree.leaves().size(); ++number) {
        const auto& leaf = map.leaf(number);
        const TreeLeaf range = tree.leaves()[number];
        for (std::size_t slot = range.first; slot < range.first + range.size; ++slot)
            outside += std::abs(tree.x()[slot] - leaf.middle[0]) > leaf.half[0] ||
                       std::abs(tree.y()[slot] - leaf.middle[1]) > leaf.half[1] ||
                       std::abs(tree.z()[slot] - leaf.middle[2]) > leaf.half[2];
    }
    CHECK(outside == 0);
}

} // namespace nephroid::tests::eye_path_map_test
