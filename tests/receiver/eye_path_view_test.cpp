// SPDX-License-Identifier: MIT
#include "nephroid/receiver/eye_path_view.hpp"

#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/tree/convex_volume.hpp"

#include "support/foreign_vectors.hpp"
#include "support/is_sanitized.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace nephroid::tests::eye_path_view_test {

namespace {

template <class V>
struct Vertex {
    V position, normal;
    PixelFootprint<V> footprint;
};

/// On a ball, with footprints that are tangent to it and of any shape.
template <class V>
std::vector<Vertex<V>> ball(int count) {
    tests::Draws draw(95);
    std::vector<Vertex<V>> vertices;
    for (int i = 0; i < count; ++i) {
        const tests::Space n = draw.direction();
        const V normal = tests::narrow<V>(n);
        const tests::Wide size(0.2 * draw.in(0.01, 1));
        const PixelFootprint<V> footprint{tests::narrow<V>(size * draw.direction().across(n)),
                                          tests::narrow<V>(size * draw.direction().across(n))};
        vertices.push_back({normal, normal, footprint});
    }
    return vertices;
}

template <class V>
EyePathMap<V> map_of(const std::vector<Vertex<V>>& vertices) {
    return EyePathMap<V>(vertices, &Vertex<V>::position, &Vertex<V>::normal, &Vertex<V>::footprint);
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

TEST_CASE_TEMPLATE("eye path view: views are trivially copyable for any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() { CHECK(std::is_trivially_copyable_v<EyePathView<V>>); });
}

TEST_CASE_TEMPLATE("eye path view: every node bounds the normals and the footprints below it", T, float, double) {
    using V = glm::vec<3, T>;
    const auto vertices = ball<V>(3000);
    const EyePathMap<V> map = map_of(vertices);
    const auto view = map.view();
    const auto& tree = view.tree();
    const T slack = 1 + 8 * std::numeric_limits<T>::epsilon();
    for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
        const EyePathNode<T>& node = view.node(i);
        T furthest(0);
        for (std::uint32_t k = i; k < tree.nodes()[i].skip; ++k) {
            if (tree.nodes()[k].leaf == no_leaf)
                continue;
            const TreeLeaf leaf = tree.leaves()[tree.nodes()[k].leaf];
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
                const auto& vertex = vertices[tree.index(slot)];
                const V axis(node.normals.axis[0], node.normals.axis[1], node.normals.axis[2]);
                furthest = (std::max)(furthest, length(V(vertex.normal - axis)));
                for (int a = 0; a < 3; ++a)
                    REQUIRE(std::abs(vertex.footprint.u[a]) + std::abs(vertex.footprint.v[a]) <=
                            2 * node.reach[std::size_t(a)]);
            }
        }
        REQUIRE(furthest <= node.normals.spread * slack);
        REQUIRE(node.normals.spread <= std::sqrt(T(3)) * furthest * slack + slack - 1); // a box's corner at most
    }
}

TEST_CASE_TEMPLATE("eye path view: a facing volume finds the same vertices as brute force", T, float, double) {
    using V = glm::vec<3, T>;
    const auto vertices = ball<V>(20'000);
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    tests::Draws draw(96);
    std::size_t met = 0, met_without = 0;
    for (int round = 0; round < 60; ++round) {
        const V d = tests::narrow<V>(draw.direction());
        const V a = map.tree().relative(tests::narrow<V>(tests::Wide(1.5) * draw.direction()));
        const V b = map.tree().relative(tests::narrow<V>(tests::Wide(1.5) * draw.direction()));
        const auto frustum = frustum_about(a, b, T(0.1), T(0.2));
        const auto count = [&](const auto& volume, std::size_t& leaves) {
            std::size_t found = 0;
            map.visit_leaves(volume, [&](std::uint32_t number) {
                const TreeLeaf leaf = map.tree().leaves()[number];
                for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
                    const V p(map.tree().x()[slot], map.tree().y()[slot], map.tree().z()[slot]);
                    found += frustum.overlaps({{p.x, p.y, p.z}, {p.x, p.y, p.z}}) &&
                             dot(vertices[map.tree().index(slot)].normal, d) > T(0);
                }
                ++leaves;
            });
            return found;
        };
        const std::size_t expected = count(frustum, met_without);
        CHECK(count(Facing{frustum, std::array<T, 3>{d.x, d.y, d.z}}, met) == expected);
    }
    CHECK(10 * met < 8 * met_without); // on a ball nearly half of the leaves face away
}

// A footprint meets a box if one of many places of it lies in there: what a walk must not miss.
TEST_CASE_TEMPLATE("eye path view: finds the leaves with pixel footprints that overlap a volume", T, float, double) {
    using V = glm::vec<3, T>;
    const auto vertices = ball<V>(3000);
    const EyePathMap<V> with = map_of(vertices);
    const EyePathMap<V> without(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    tests::Draws draw(97);
    constexpr std::size_t rounds = tests::is_sanitized ? 10 : 100;
    for (const EyePathMap<V>* const map : {&with, &without}) {
        std::size_t met = 0, needed = 0;
        for (std::size_t round = 0; round < rounds; ++round) {
            const V middle = map->tree().relative(tests::narrow<V>(draw.direction()));
            const T half = T(draw.in(0.001, 0.1));
            const Box<T> box{{middle.x - half, middle.y - half, middle.z - half},
                             {middle.x + half, middle.y + half, middle.z + half}};
            std::vector<bool> visited(map->tree().leaves().size());
            map->visit_footprints(box, [&](std::uint32_t leaf) { visited[leaf] = true, ++met; });
            for (std::uint32_t number = 0; number < visited.size(); ++number) {
                const TreeLeaf leaf = map->tree().leaves()[number];
                bool meets = false;
                for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
                    PixelFootprint<V> f = vertices[map->tree().index(slot)].footprint;
                    if (map == &without) {
                        const Frame<V> frame = frame_about(vertices[map->tree().index(slot)].normal);
                        f = {map->leaf(number).spacing * frame.u, map->leaf(number).spacing * frame.v};
                    }
                    const V at(map->tree().x()[slot], map->tree().y()[slot], map->tree().z()[slot]);
                    for (int i = 0; i <= 8; ++i)
                        for (int j = 0; j <= 8; ++j) {
                            const V p = at + T(0.1249 * (i - 4)) * f.u + T(0.1249 * (j - 4)) * f.v;
                            meets = meets || box.overlaps({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
                        }
                }
                REQUIRE((visited[number] || !meets));
                needed += meets;
            }
        }
        CHECK(needed > rounds);
        CHECK(met < 4 * needed); // boxes about boxes, but not all of them
    }
}

TEST_CASE("eye path view: footprints come from a projection or a range or are squares of the spacing") {
    using V = glm::vec3;
    std::vector<Vertex<V>> vertices;
    std::vector<PixelFootprint<V>> beside;
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 16; ++i) {
            // Every other one does not know.
            const float known = i % 2 == 0 ? 1.f : 0.f;
            vertices.push_back(
                {{float(i) / 4, float(j) / 4, 0}, {0, 0, 1}, {known * V(0.5f, 0, 0), known * V(0, 2, 0)}});
            beside.push_back(vertices.back().footprint);
        }
    const EyePathMap by_projection = map_of(vertices);
    const EyePathMap by_range(vertices, &Vertex<V>::position, &Vertex<V>::normal, beside);
    const EyePathMap by_spacing(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    CHECK(by_projection.has_footprints());
    CHECK(!by_spacing.has_footprints());
    const auto& tree = by_range.tree();
    for (std::uint32_t number = 0; number < tree.leaves().size(); ++number)
        for (std::size_t slot = tree.leaves()[number].first;
             slot < (number + 1 < tree.leaves().size() ? tree.leaves()[number + 1].first : tree.slots());
             ++slot) { // those that repeat the last one, too
            const bool is_known = tree.index(slot) % 2 == 0;
            for (const auto* const map : {&by_projection, &by_range}) {
                const auto rows = map->footprint(number, slot);
                CHECK(rows.u == (is_known ? V(2, 0, 0) : V(4, 0, 0)));
                CHECK(rows.v == (is_known ? V(0, 0.5f, 0) : V(0, 4, 0)));
                CHECK(rows.inverse_area == (is_known ? 1.f : 16.f));
            }
            CHECK(by_spacing.footprint(number, slot).u == V(4, 0, 0));
            CHECK(by_spacing.footprint(number, slot).inverse_area == 16);
        }
}

TEST_CASE("eye path view: footprints are empty if there is no spacing") {
    using V = glm::dvec3;
    const std::vector<Vertex<V>> one(1, {{1, 2, 3}, {0, 0, 1}, {{0, 0, 0}, {0, 0, 0}}});
    CHECK(map_of(one).footprint(0, 0).inverse_area == 0);
    const EyePathMap without(one, &Vertex<V>::position, &Vertex<V>::normal);
    CHECK(without.footprint(0, 0).inverse_area == 0);
    CHECK(map_of(std::vector<Vertex<V>>{}).has_footprints() == false);
}

TEST_CASE("eye path map: the message names the vertex with an invalid footprint") {
    using V = glm::vec3;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const auto& bad : {PixelFootprint<V>{{1, 0, 0}, {2, 0, 0}},
                            {{1, 0, 0}, {0, 0, 0}},
                            {{nan, 0, 0}, {0, 1, 0}},
                            {{1, 0, 0}, {0, std::numeric_limits<float>::infinity(), 0}},
                            {{1e-30f, 0, 0}, {0, 1e-30f, 0}}}) {
        auto vertices = ball<V>(100);
        vertices[17].footprint = bad;
        const std::string complaint = complaint_of([&] { return map_of(vertices); });
        CAPTURE(complaint);
        CHECK(complaint.starts_with("nephroid::EyePathMap: vertex 17 "));
        CHECK(complaint.find("span an area") != std::string::npos);
    }
    const auto vertices = ball<V>(100);
    const std::vector<PixelFootprint<V>> few(99, vertices[0].footprint);
    CHECK(complaint_of([&] {
              return EyePathMap(vertices, &Vertex<V>::position, &Vertex<V>::normal, few);
          }).find("99 pixel footprints for 100 vertices") != std::string::npos);
}

} // namespace nephroid::tests::eye_path_view_test
