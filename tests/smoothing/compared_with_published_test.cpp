// SPDX-License-Identifier: MIT
#include "nephroid/caustics.hpp"

#include "support/is_sanitized.hpp"
#include "support/vertex.hpp"

#include "nephroid/emission/light/disk.hpp"
#include "nephroid/emission/light_set.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace nephroid::tests::compared_with_published_test {

namespace {

using V = glm::dvec3;
using detail::QuarterPictures;
using detail::validated_error_of_pass;
using Hit = SurfaceHit<V, ShapeOperator<V>>;

/// A mirror at z = 0 that sends light up to a screen at z = 1, which light from above passes. The mirror's normals are
/// those of waves along x and y: smooth, or constant over facets.
struct RippledMirror {
    static constexpr double slope = 0.05, wave = 8; // steepest; radians for each unit of length
    double facets = 0;                              ///< for each unit of length; 0: smooth

    [[nodiscard]] V normal_at(double x, double y) const { // of a smooth mirror, or in the middle of the facet
        if (facets > 0) {
            x = (std::floor(x * facets) + 0.5) / facets;
            y = (std::floor(y * facets) + 0.5) / facets;
        }
        return normalize(V(-slope * std::sin(wave * x), -slope * std::sin(wave * y), 1));
    }
    [[nodiscard]] std::optional<Hit> intersect(const V& origin, const V& direction, double t_min, double t_max) const {
        const double z = direction.z < 0 ? 0 : 1, t = (z - origin.z) / direction.z;
        if (!(t > t_min && t < t_max))
            return std::nullopt;
        const V position = origin + t * direction;
        Hit hit{};
        hit.distance = t;
        hit.position = position;
        hit.geometric_normal = V(0, 0, z == 0 ? 1 : -1);
        hit.shading_normal = z == 0 ? normal_at(position.x, position.y) : hit.geometric_normal;
        hit.position_error = 1e-12;
        hit.surface = std::size_t(z);
        if (z == 0 && facets == 0) { // of m = (a, b, 1): dn = (dm − n (n · dm))/|m|
            const V n = hit.shading_normal;
            const double scale = slope * wave * n.z; // n.z is 1/|m|
            const auto column = [&](const V& dm) { return V(scale * (dm - dot(n, dm) * n)); };
            hit.curvature.column_x = column(V(-std::cos(wave * position.x), 0, 0));
            hit.curvature.column_y = column(V(0, -std::cos(wave * position.y), 0));
        }
        return hit;
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const Hit& hit, const V&, Sampler&) const {
        return hit.surface == 0 ? Scattering<double, double>::reflect(1) : Scattering<double, double>::deposit();
    }
};

/// The part of the photons that are splatted as published, by default, under a small lamp with area.
template <class Sequence>
[[nodiscard]] double published_share(double facets, const Sequence& sequence, double radius = 0.02,
                                     std::uint64_t photons = 20'000, const SecondOrder& order = {}) {
    std::vector<Vertex<V>> screen;
    constexpr int size = 48;
    for (int i = 0; i < size * size; ++i)
        screen.push_back({V((i % size + 0.5) / size, (i / size + 0.5) / size, 1), V(0, 0, -1)});
    const EyePathMap<V> map(screen, &Vertex<V>::position, &Vertex<V>::normal);
    auto sums = nephroid::sums<double>(map);
    const DiskLight<V, double> lamp({.centre = V(0.5, 0.5, 5),
                                     .normal = V(0, 0, -1),
                                     .radius = radius,
                                     .radiance = 1,
                                     .target = BoundingSphere<V>{V(0.5, 0.5, 0), 0.5}});
    const Statistics account =
        nephroid::caustics(RippledMirror{facets}, lamp, sums, {.count = photons}, sequence, Default{.order = order});
    REQUIRE(account[Fate::splatted].photons > photons / 4);
    return double(account.splatted_as_published) / double(account.caustic_photons());
}
} // namespace

TEST_CASE("compared with published: under a lamp with area flat facets are splatted as published, and waves not") {
    const auto check = [](const auto& sequence) {
        CHECK(published_share(8, sequence) > 0.999);
        CHECK(published_share(0, sequence) < 0.05); // photons without enough neighbours
    };
    check(HaltonSequence());
    if (is_sanitized) // which makes minutes of what follows
        return;
    check(RandomSequence(1));
    SecondOrder unchecked;
    unchecked.largest_miss = std::numeric_limits<double>::infinity();
    CHECK(published_share(8, HaltonSequence(), 0.02, 20'000, unchecked) < 0.05);
}

// The pilot has a quarter of the photons here.
TEST_CASE("compared with published: small facets are seen in large passes of stratified photons" *
          doctest::skip(is_sanitized)) {
    for (const std::uint64_t seed : {0u, 1u})
        CHECK(published_share(64, HaltonSequence(seed), 0.1, 262'144) > 0.999);
}

// Only the lamp that needs it: with one of them over facets and another over waves each has its own footprints.
TEST_CASE("compared with published: each lamp of a set is judged by itself" * doctest::skip(is_sanitized)) {
    struct TwoMirrors : RippledMirror { // facets on one side, waves on the other
        [[nodiscard]] std::optional<Hit> intersect(const V& origin, const V& direction, double t_min,
                                                   double t_max) const {
            const double x = origin.x + direction.x * origin.z / std::abs(direction.z);
            return RippledMirror{direction.z < 0 && x > 5 ? 8.0 : 0.0}.intersect(origin, direction, t_min, t_max);
        }
    };
    std::vector<Vertex<V>> screen;
    constexpr int size = 48;
    for (const double x : {0.0, 10.0})
        for (int i = 0; i < size * size; ++i)
            screen.push_back({V(x + (i % size + 0.5) / size, (i / size + 0.5) / size, 1), V(0, 0, -1)});
    const EyePathMap<V> map(screen, &Vertex<V>::position, &Vertex<V>::normal);
    auto sums = nephroid::sums<double>(map);
    using Lamp = DiskLight<V, double>;
    const auto over = [](double x) {
        return Lamp({.centre = V(x, 0.5, 5),
                     .normal = V(0, 0, -1),
                     .radius = 0.02,
                     .radiance = 1,
                     .target = BoundingSphere<V>{V(x, 0.5, 0), 0.5}});
    };
    const LightSet<Lamp> lamps({over(0.5), over(10.5)});
    const Statistics account = nephroid::caustics(TwoMirrors{}, lamps, sums, {.count = 40'000});
    const double share = double(account.splatted_as_published) / double(account.caustic_photons());
    CHECK(share > 0.45);
    CHECK(share < 0.55);
}

// Pictures of quarters are truth + bias + noise v. From a share of the photons the pass would have an error of
// bias² + v share/4 for each vertex. With 250,000 vertices of truth below 1 the noise of the mean is some 2e-3 √v.
TEST_CASE("compared with published: the error of a pass is that of more photons with the same footprints") {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    constexpr std::size_t count = 250'000;
    const auto error_of = [&](double bias, double variance, double share) {
        QuarterPictures pictures, sharp;
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t i = 0; i < count; ++i) {
                const double truth = double(i) / count;
                pictures[k].push_back(truth + bias + std::sqrt(variance) * normal(random));
                sharp[k].push_back(truth + 0.2 * normal(random));
            }
        return validated_error_of_pass(pictures, sharp, share) / count;
    };
    const double none = error_of(0, 0, 1);
    CHECK(std::abs(error_of(0.1, 0, 0.3) - none - 0.01) < 4e-3);
    CHECK(std::abs(error_of(0, 0.4, 1) - none - 0.1) < 4e-3);
    CHECK(std::abs(error_of(0, 0.4, 0.25) - none - 0.025) < 4e-3);
}

} // namespace nephroid::tests::compared_with_published_test
