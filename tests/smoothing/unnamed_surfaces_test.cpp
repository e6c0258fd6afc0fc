// SPDX-License-Identifier: MIT
// Hits that do not say which surface they are of, or say no more than its material.
#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/standard_lights.hpp"
#include "transport/tiny_scenes.hpp"
#include "support/vertex.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace nephroid::tests::unnamed_surfaces_test {

using tests::Sheet;
using tests::SheetScene;

namespace {

using V = tests::Vec<double>;

/// As SheetScene has it, without `surface`.
struct UnnamedHit {
    double distance;
    V position, geometric_normal;
    Flat curvature;
    double position_error;
    std::size_t sheet;
};

struct UnnamedScene {
    SheetScene<double> scene;

    [[nodiscard]] std::optional<UnnamedHit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        const auto hit = scene.intersect(o, d, t_min, t_max);
        if (!hit)
            return std::nullopt;
        return UnnamedHit{hit->distance, hit->position, hit->geometric_normal, {}, hit->position_error, hit->surface};
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const UnnamedHit& hit, const V& d, Sampler& sampler) const {
        return scene.scatter({hit.distance, hit.position, hit.geometric_normal, hit.geometric_normal, {}, 0, hit.sheet},
                             d, sampler);
    }
};

/// As SheetScene has it, with the material for `surface`: one for all mirrors, one for all that is diffuse.
struct MaterialHit : SurfaceHit<V, Flat> {
    std::size_t sheet;
};

struct MaterialScene {
    SheetScene<double> scene;

    [[nodiscard]] std::optional<MaterialHit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        const auto hit = scene.intersect(o, d, t_min, t_max);
        if (!hit)
            return std::nullopt;
        MaterialHit result{*hit, hit->surface};
        result.surface = scene.sheets[hit->surface].event == Event::deposit;
        return result;
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const MaterialHit& hit, const V& d, Sampler& sampler) const {
        SurfaceHit<V, Flat> named = hit;
        named.surface = hit.sheet;
        return scene.scatter(named, d, sampler);
    }
};

using Vertex = tests::Vertex<V>;

/// The irradiance of vertices, of a lamp of unit intensity at (0, 0, 1) below a mirror at height 4.
template <class Scene>
[[nodiscard]] std::vector<double> lit(const Scene& scene, const std::vector<Vertex>& vertices) {
    const PointLight<V, double> lamp(
        {.position = {0, 0, 1}, .intensity = 1, .target = BoundingSphere<V>{{0, 0, 4}, 1.2}});
    const EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
    auto sums = nephroid::sums<double>(map);
    tests::check_balance(caustics(scene, lamp, sums, {.count = 20'000}));
    std::vector<double> irradiance(vertices.size());
    sums.for_each([&](std::size_t vertex, double e) { irradiance[vertex] += e; });
    return irradiance;
}

/// Of a lamp of unit intensity at this height above the place's middle.
[[nodiscard]] double exact(const V& at, double height) {
    return (height - at.z) / std::pow(square(height - at.z) + at.x * at.x + at.y * at.y, 1.5);
}

[[nodiscard]] std::vector<Vertex> square_at(double height, double half_side) {
    constexpr int n = 48;
    std::vector<Vertex> vertices;
    for (int i = 0; i < n * n; ++i)
        vertices.push_back(
            {{((i % n + 0.5) * 2 / n - 1) * half_side, ((i / n + 0.5) * 2 / n - 1) * half_side, height}, {0, 0, 1}});
    return vertices;
}

/// How far the irradiance of unnamed surfaces is from that of named ones at most, as a part of the largest.
[[nodiscard]] double difference(const std::vector<double>& a, const std::vector<double>& b) {
    double most = 0, largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        most = (std::max)(most, std::abs(a[i] - b[i]));
        largest = (std::max)(largest, b[i]);
    }
    return most / largest;
}

} // namespace

// The lamp's image is at height 7. The light that the footprints carry into the shadow is 1.2% of that beside it, with
// names and without; without names it was 12% before neighbours were told apart.
TEST_CASE("unnamed surfaces: the floor below a table is as dark as where surfaces have names") {
    constexpr double image = 7, table_height = 0.5, table_radius = 0.5;
    constexpr double shadow_radius = table_radius * image / (image - table_height);
    const SheetScene<double> named{{{{0, 0, 4}, {0, 0, -1}, Event::reflect},
                                    {{0, 0, 0}, {0, 0, 1}, Event::deposit},
                                    {{0, 0, table_height}, {0, 0, 1}, Event::deposit, 1, 1, 1, table_radius}}};
    std::vector<Vertex> vertices = square_at(0, 1.5);
    for (const Vertex& vertex : square_at(table_height, 0.6))
        vertices.push_back(vertex);
    const auto with_names = lit(named, vertices);
    const auto check = [&](const std::vector<double>& irradiance) {
        double dark = 0, dark_count = 0, squares = 0, lit_count = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            const V& at = vertices[i].position;
            const double r = std::hypot(at.x, at.y);
            if (at.z == 0 && r < shadow_radius - 0.08) {
                dark += irradiance[i] / exact(at, image);
                ++dark_count;
            } else if (at.z == 0 && r > shadow_radius + 0.08 && r < 1.4) {
                squares += square(irradiance[i] / exact(at, image) - 1);
                ++lit_count;
            }
        }
        CHECK(dark / dark_count <= 0.02);
        CHECK(std::sqrt(squares / lit_count) <= 0.05);
        CHECK(difference(irradiance, with_names) <= 1e-6); // a few photons at the edge may be told apart otherwise
    };
    check(with_names);
    check(lit(UnnamedScene{named}, vertices));
    check(lit(MaterialScene{named}, vertices));
}

TEST_CASE("unnamed surfaces: two mirrors, one before the other, are not taken for one") {
    const SheetScene<double> named{{{{0, 0, 4}, {0, 0, -1}, Event::reflect},
                                    {{0, 0, 3}, {0, 0, -1}, Event::reflect, 1, 1, 1, 0.2},
                                    {{0, 0, 0}, {0, 0, 1}, Event::deposit}}};
    const std::vector<Vertex> vertices = square_at(0, 1.5);
    const auto with_names = lit(named, vertices);
    CHECK(difference(lit(UnnamedScene{named}, vertices), with_names) <= 1e-6);
    CHECK(difference(lit(MaterialScene{named}, vertices), with_names) <= 1e-6);
}

} // namespace nephroid::tests::unnamed_surfaces_test
