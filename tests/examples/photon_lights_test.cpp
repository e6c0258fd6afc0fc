// SPDX-License-Identifier: MIT
// What the lamps of a scene send towards specular objects that are far apart.
#include "common/photon_lights.hpp"

#include "examples/worlds.hpp"
#include "nephroid/pass/photons_to_emit.hpp"
#include "nephroid/sequence/halton.hpp"
#include "support/is_sanitized.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::examples::photon_lights_test {

using testing::globe;

namespace {

using V = Vec3<double>;
using Kind = typename Lamp<double, V>::Kind;

/// Balls of glass of radius 1, as spheres and as meshes in turn, 2 above a floor.
[[nodiscard]] Scene<double> balls(const std::vector<double>& places) {
    std::vector<Scene<double>::Part> parts;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const V centre(places[i], 0, 2);
        if (i % 2 == 0)
            parts.push_back({Sphere<double>(centre, 1), 0});
        else
            parts.push_back({TriangleMesh<double>(globe<double>(24, 0, centre)), 0});
    }
    parts.push_back({Floor<double>(0), 1});
    return Scene<double>(std::move(parts), {Material<V>::dielectric(1.5, false), Material<V>::diffuse(V(1))});
}

/// The flux of the photons that met glass, and their share of all.
struct Met {
    double flux, share;
};
[[nodiscard]] Met follow(const Scene<double>& scene, const SceneLights<double, V>& lights, std::uint64_t photons) {
    const HaltonSequence sequence(3);
    Statistics account;
    Met met{0, 0};
    for (std::uint64_t i = 0; i < photons; ++i) {
        Sampler sampler(sequence, i);
        const auto photon = lights.emit(sampler, Spread<double>{double(photons), 1});
        Statistics one;
        if (const auto deposit = walk(scene, photon, sampler, {}, one))
            one.end(Fate::splatted, flux_traits<V>::power(deposit->flux));
        if (one.specular_events > 0) {
            met.flux += one.emitted.flux;
            met.share += 1 / double(photons);
        }
        account += one;
    }
    CHECK(std::abs(account.emitted.flux - account.accounted_flux()) < 1e-9 * account.emitted.flux);
    return met;
}

/// Each kind of lamp, 8 above the floor.
[[nodiscard]] Lamps<double, V> lamp_of_kind(int kind, double along) {
    Lamps<double, V> lamps;
    const V position(along, 0.5, 8);
    if (kind == 0)
        lamps.lamps.push_back({.kind = Kind::point, .position = position, .intensity = V(1)});
    if (kind == 1)
        lamps.lamps.push_back({.kind = Kind::spot,
                               .position = position,
                               .direction = {0, 0, -1},
                               .intensity = V(1),
                               .cos_inner = 0.9,
                               .cos_outer = -0.9});
    if (kind == 2)
        lamps.lamps.push_back({.kind = Kind::directional, .direction = normalize(V(0.1, 0.2, -1)), .intensity = V(1)});
    if (kind == 3)
        lamps.areas.push_back({{{position, position + V(0, 0.5, 0), position + V(0.5, 0, 0)}}, V(1)});
    if (kind == 4)
        lamps.environments.push_back(
            std::make_shared<const Environment<double, V>>(Environment<double, V>::constant(V(1))));
    return lamps;
}

/// Numbers that are given.
struct Given {
    std::array<double, 2> numbers;
    std::size_t used = 0;
    template <class T>
    [[nodiscard]] T next() {
        return T(numbers.at(used++));
    }
};

/// Whether the line along the beam through a point passes a light's patch, by where its photons start.
[[nodiscard]] bool passes(const DirectionalLight<V, V>& light, const V& at) {
    const auto start = [&](double u, double v) {
        Given numbers{{u, v}};
        return light.emit(numbers, Spread<double>{1, 1}).position;
    };
    const auto across = [&](const V& v) { return V(v - dot(v, light.direction()) * light.direction()); };
    if (light.exact_domain().kinks[0] == Kinks::diagonals) { // a disk
        const V centre = start(0.5, 0.5);
        return length(across(at - centre)) <= length(start(1, 0.5) - centre);
    }
    const V corner = start(0, 0), u = start(1, 0) - corner, v = start(0, 1) - corner, away = at - corner;
    return dot(away, u) >= 0 && dot(away, u) <= dot(u, u) && dot(away, v) >= 0 && dot(away, v) <= dot(v, v);
}

} // namespace

// With one target for both, a share of 1/d² of the photons meets glass, of two balls d radii apart.
TEST_CASE("photon lights: two balls far apart cost no more photons than one") {
    for (const double distance : {10.0, 100.0, 1000.0})
        for (int kind = 0; kind < 5; ++kind) {
            CAPTURE(distance);
            CAPTURE(kind);
            const Scene<double> scene = balls({0, distance});
            const auto lights = photon_lights(lamp_of_kind(kind, 0.3), scene);
            CHECK(lights.lights().size() == 2);
            // A ball fills its cone or disk, but for facets; half of an environment is below the floor.
            CHECK(follow(scene, lights, 4000).share > (kind == 4 ? 0.45 : 0.9));
            const auto emitted = photons_to_emit(scene, lights, 20'000);
            CHECK(emitted > 0);
            CHECK(emitted < 200'000); // some of the light is refracted away from the floor
        }
}

// Targets are kept apart by their bounds, which the patches over the corners of balls' boxes reach out of.
TEST_CASE("photon lights: no line of a beam passes the patches of two lights, and one to a ball passes its own") {
    const HaltonSequence sequence(5);
    int several = 0;
    for (std::uint64_t n = 0; n < 200; ++n) {
        CAPTURE(n);
        Sampler draw(sequence, n);
        std::vector<Scene<double>::Part> parts;
        std::vector<std::pair<V, double>> places; // of balls
        for (int i = 0; i < 6; ++i) {
            const auto in = [&](double reach) { return reach * (2 * draw.next<double>() - 1); };
            const V centre(in(5), in(5), in(5));
            const double radius = 0.6 + in(0.4);
            places.emplace_back(centre, radius);
            parts.push_back({Sphere<double>(centre, radius), 0});
        }
        const Scene<double> scene(std::move(parts), {Material<V>::dielectric(1.5, false)});
        Lamps<double, V> lamps;
        const V direction =
            normalize(V(draw.next<double>() - 0.5, draw.next<double>() - 0.5, draw.next<double>() - 0.5));
        lamps.lamps.push_back({.kind = Kind::directional, .direction = direction, .intensity = V(1)});
        const auto lights = photon_lights(lamps, scene);
        several += lights.lights().size() > 1;
        const auto count_at = [&](const V& at) {
            int count = 0;
            for (const auto& light : lights.lights())
                count += passes(std::get<DirectionalLight<V, V>>(light), at);
            return count;
        };
        for (int i = 0; i < 1000; ++i) {
            const auto& [centre, radius] = places[std::size_t(i) % places.size()];
            const V away =
                normalize(V(draw.next<double>() - 0.5, draw.next<double>() - 0.5, draw.next<double>() - 0.5));
            CHECK(count_at(centre + (radius * (1 - 1e-9)) * away) == 1);
            CHECK(count_at(centre + (4 * draw.next<double>() * radius) * away) <= 1);
        }
    }
    CHECK(several > 50);
}

// Balls in a row that shade one another: from the side their targets overlap. The photons that meet glass carry
// as much flux as with one light, aimed at all, which cannot count anything twice.
TEST_CASE("photon lights: several targets bring as much light to the glass as one, from wherever it comes") {
    const Scene<double> scene = balls({-9, -4, 0, 1.5, 6});
    const auto all = bounding_sphere(scene.specular_points());
    for (const double along : {0.3, -20.0, 30.0})
        for (int kind = 0; kind < 5; ++kind) {
            CAPTURE(along);
            CAPTURE(kind);
            auto lamps = lamp_of_kind(kind, along);
            if (kind == 2)
                lamps.lamps[0].direction = normalize(V(along, 0.2, -1));
            constexpr std::uint64_t photons = tests::is_sanitized ? 4'000 : 40'000;
            const auto lights = photon_lights(lamps, scene);
            const double flux = follow(scene, lights, photons).flux;
            using One = SceneLights<double, V>;
            std::vector<One::AnyLight> one;
            if (kind == 0)
                one.push_back(PointLight<V, V>({lamps.lamps[0].position, V(1), all}));
            if (kind == 1)
                one.push_back(SpotLight<V, V>({lamps.lamps[0].position, {0, 0, -1}, 0.9, -0.9, V(1), all}));
            if (kind == 2)
                one.push_back(DirectionalLight<V, V>({lamps.lamps[0].direction, V(1), all}));
            if (kind == 3)
                one.push_back(MeshLight<V, V>({lamps.areas[0].triangles, V(1), all}));
            if (kind == 4)
                one.push_back(EnvironmentLight<double, V>(lamps.environments[0], all, all));
            const auto truth = follow(scene, One(one), 8 * photons);
            // Of random photons of one flux a share p arrives, off by sqrt((1 - p) / (p N)); falloff and cosines double
            // it at most. Five times that, for both: coarse. Light that is counted twice here and there is found
            // where single directions and lines are counted, above and in emission/separate_targets_test.cpp.
            const double noise = 2 / std::sqrt(truth.share * double(photons));
            CHECK(std::abs(flux / truth.flux - 1) < 5 * noise);
            CHECK(lights.power() < One(one).power());
        }
}

} // namespace nephroid::examples::photon_lights_test
