// SPDX-License-Identifier: MIT
// Closed forms: in an integrating sphere each bounce is uniform; in a furnace, whose walls all emit the flux M per area
// and reflect the share ρ, the irradiance is M / (1 - ρ) everywhere, whatever stands in it; M of it is first light.
#include "common/path_tracer/bounced_paths.hpp"

#include "common/rooms/mesh_faces.hpp"
#include "examples/room_points.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

namespace nephroid::examples::bounced_paths_test {

using namespace nephroid::examples::testing;

namespace {

constexpr double pi_ = std::numbers::pi;

/// Walls that emit M = 1/2 and reflect 1/2.
template <class T>
Material<T> warm() {
    Material<T> material = Material<T>::diffuse(T(0.5));
    material.emission = T(0.5 / pi_);
    return material;
}

template <class T>
Scene<T, T> furnace(MeshData<T> inside, std::vector<typename Scene<T, T>::Part> more = {},
                    const Material<T>& material = warm<T>()) {
    add_room(inside, Box<T>{Vec3<T>(0), Vec3<T>(1)}, RoomMaterials::all(0));
    more.push_back({TriangleMesh<T>(std::move(inside)), 0});
    return Scene<T, T>(std::move(more), {warm<T>(), material});
}

/// Four standard errors, which one seed in 16,000 misses, and the rounding of T: paths multiply some hundred times.
template <class T>
void check(const Estimate& found, double expected, double most_error) {
    CAPTURE(found.mean);
    CAPTURE(found.error);
    CAPTURE(expected);
    CHECK(std::abs(found.mean - expected) < 4 * found.error + 1000 * std::numeric_limits<T>::epsilon() * expected);
    CHECK(found.error < most_error * expected);
}

} // namespace

// E = Φ ρ / ((1 - ρ) 4π R²) after all bounces, and Φ (ρ + … + ρⁿ) / (4π R²) after n. A path's number of
// bounces is geometric with the mean 4 and the variance 20: of 4,000 paths the mean is good to 2%. The lamp's nearness
// adds some.
TEST_CASE_TEMPLATE("bounced paths: in an integrating sphere each bounce of a lamp's light is uniform", T, float,
                   double) {
    const Scene<T, T> scene({{Sphere<T>(Vec3<T>(0), 1), 0}}, {Material<T>::diffuse(T(0.8))});
    Lamps<T, T> lamps;
    lamps.lamps.push_back({.position = {T(0.3), T(0.2), T(-0.4)}, .intensity = T(1 / (4 * pi_))});
    for (const Vec3<T>& up : {Vec3<T>(0, 0, 1), Vec3<T>(T(0.6), T(-0.8), 0)}) {
        const auto vertex = on_wall<T, T>(up, -up);
        check<T>(estimate(BouncedPaths<T, T>(scene, lamps), vertex, 4000, indirect_part), 1 / pi_, 0.04);
        const Vec3<double> to_lamp = Vec3<double>(lamps.lamps[0].position) - Vec3<double>(up);
        const double nearby = -dot(Vec3<double>(up), to_lamp) / (4 * pi_ * std::pow(length(to_lamp), 3));
        CHECK(estimate(BouncedPaths<T, T>(scene, lamps, 0), vertex, 100, indirect_part).mean == 0);
        for (const unsigned bounces : {1u, 3u}) {
            const BouncedPaths<T, T> paths(scene, lamps, bounces);
            double expected = 0;
            for (unsigned i = 1; i <= bounces; ++i)
                expected += std::pow(0.8, i) / (4 * pi_);
            check<T>(estimate(paths, vertex, 2000, indirect_part), expected, 0.06);
            const Estimate direct = estimate(paths, vertex, 2, direct_part); // there is but one way
            CHECK(std::abs(direct.mean - nearby) < 100 * std::numeric_limits<T>::epsilon() * nearby);
        }
    }
}

// Indirect light too is M ρ / (1 - ρ) = 1/2. Near an edge a ray to a random point of the walls has no variance that
// is finite without the balance heuristic.
TEST_CASE_TEMPLATE("bounced paths: a furnace has the same light everywhere, at edges and in corners too", T, float,
                   double) {
    const Scene<T, T> scene = furnace<T>({});
    const Lamps<T, T> lamps{{}, area_lamps(scene)};
    const BouncedPaths<T, T> paths(scene, lamps);
    for (const T x : {T(0.5), T(0.03), T(1e-4)})
        for (const T z : {T(0.4), T(1e-4)}) {
            const auto vertex = on_wall<T, T>({x, 0, z}, {0, 1, 0});
            check<T>(estimate(paths, vertex, 2000, direct_part), 0.5, 0.02);
            check<T>(estimate(paths, vertex, 2000, indirect_part), 0.5, 0.06);
        }
}

TEST_CASE("bounced paths: a block on a furnace's floor changes nothing: contacts, convex edges, what it hides") {
    MeshData<double> block;
    add_block(block, Box<double>{{0.3, 0, 0.3}, {0.6, 0.4, 0.6}}, 0, false);
    const Scene<double, double> scene = furnace<double>(std::move(block));
    const Lamps<double, double> lamps{{}, area_lamps(scene)};
    const BouncedPaths<double, double> paths(scene, lamps);
    const std::pair<Vec3<double>, Vec3<double>> places[] = {{{0.6001, 0, 0.45}, {0, 1, 0}},     // where it stands
                                                            {{0.6, 1e-4, 0.45}, {1, 0, 0}},     // its foot
                                                            {{0.5999, 0.4, 0.5999}, {0, 1, 0}}, // its corner
                                                            {{0.9, 0, 0.45}, {0, 1, 0}}};
    for (const auto& [position, normal] : places) {
        const auto vertex = on_wall<double, double>(position, normal);
        check<double>(estimate(paths, vertex, 2000, direct_part), 0.5, 0.02);
        check<double>(estimate(paths, vertex, 2000, indirect_part), 0.5, 0.06);
    }
}

// What absorbs nothing leaves a furnace's light as it is. Direct and caustic light are the first light, M: a path that
// were in both, or in neither, or had the wrong solid angle behind glass, would change it.
TEST_CASE_TEMPLATE("bounced paths: mirrors and glass in a furnace change no sum of its light", T, float, double) {
    const Vec3<T> centre(T(0.5), T(0.4), T(0.5));
    for (const Material<T>& material :
         {Material<T>::mirror(1), Material<T>::dielectric(1.5), Material<T>::window(1.5)}) {
        const Scene<T, T> scene = furnace<T>({}, {{Sphere<T>(centre, T(0.3)), 1}}, material);
        const Lamps<T, T> lamps{{}, area_lamps(scene)};
        const BouncedPaths<T, T> paths(scene, lamps);
        const auto vertex = on_wall<T, T>({T(0.4), 0, T(0.45)}, {0, 1, 0});
        check<T>(estimate(paths, vertex, 1500, first_light), 0.5, 0.03);
        check<T>(estimate(paths, vertex, 1500, indirect_part), 0.5, 0.06);
        const auto caustic = [](const auto& layers) { return layers.caustic; };
        CHECK(estimate(paths, vertex, 1500, caustic).mean > 0.1); // the ball is most of what this place sees
    }
}

namespace {
/// A floor under water of the given height, as far as can be seen.
Scene<double, double> pool(double height, double albedo, Material<double> water) {
    const double far = 1e4; // at 2e-5 above the horizon
    MeshData<double> mesh;
    add_face<double>(mesh, {-far, height, -far}, {-far, height, far}, {far, height, far}, {far, height, -far}, 1);
    add_face<double>(mesh, {-far, 0, -far}, {-far, 0, far}, {far, 0, far}, {far, 0, -far}, 0);
    return Scene<double, double>({{TriangleMesh<double>(std::move(mesh)), 0}},
                                 {Material<double>::diffuse(albedo), std::move(water)});
}

Lamps<double, double> white_sky() {
    Lamps<double, double> lamps;
    lamps.environments.push_back(
        std::make_shared<const Environment<double, double>>(Environment<double, double>::constant(1)));
    return lamps;
}
} // namespace

// Under h of water that absorbs a per length, and does not bend light, a black floor gets
// 2π ∫ cos exp(-a h / cos) sin dθ from a sky of radiance 1. All of it came through the surface, so none is direct.
TEST_CASE("bounced paths: light is absorbed on its way through water") {
    const double absorption = 3, height = 0.2;
    Material<double> water = Material<double>::dielectric(1);
    water.absorption = absorption;
    const Scene<double, double> scene = pool(height, 0, water);
    const Lamps<double, double> lamps = white_sky();
    double expected = 0; // by midpoints in cos²
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i)
        expected += pi_ * std::exp(-absorption * height / std::sqrt((i + 0.5) / n)) / n;
    const BouncedPaths<double, double> paths(scene, lamps);
    const auto vertex = on_wall<double, double>({0, 0, 0}, {0, 1, 0});
    check<double>(estimate(paths, vertex, 4000, all_light), expected, 0.02);
    CHECK(estimate(paths, vertex, 400, direct_part).mean == 0);
}

// Where nothing absorbs, the radiance in a medium of index n is n² times that around it.
TEST_CASE("bounced paths: a white pool under a constant sky has the sky's radiance times the square of the index") {
    const Scene<double, double> scene = pool(0.3, 1, Material<double>::dielectric(1.33));
    const Lamps<double, double> lamps = white_sky();
    const BouncedPaths<double, double> paths(scene, lamps);
    const auto vertex = on_wall<double, double>({0, 0, 0}, {0, 1, 0});
    check<double>(estimate(paths, vertex, 4000, all_light), pi_ * square(1.33), 0.02);
}

// Radiance 1 from all around, and a floor that reflects it all: π everywhere, also below a ball of glass.
TEST_CASE("bounced paths: a white floor under a constant sky is as bright as the sky, with glass on it or without") {
    const Scene<double, double> scene(
        {{Quad<double>({-500, 0, 500}, {1000, 0, 0}, {0, 0, -1000}), 0}, {Sphere<double>({0, 1, 0}, 1), 1}},
        {Material<double>::diffuse(1), Material<double>::dielectric(1.5)});
    const Lamps<double, double> lamps = white_sky();
    const BouncedPaths<double, double> paths(scene, lamps);
    for (const double x : {0.01, 0.5, 1.5, 4.0})
        check<double>(estimate(paths, on_wall<double, double>({x, 0, 0}, {0, 1, 0}), 3000, all_light), pi_, 0.03);
}

TEST_CASE("bounced paths: what they cannot do is refused") {
    const auto message_of = [](const Material<double>& material, bool has_lamp) -> std::string {
        const Scene<double, double> scene({{Sphere<double>({0, 0, 0}, 1), 0}}, {material});
        Lamps<double, double> lamps;
        if (has_lamp)
            lamps.lamps.push_back({.position = {0, 0, 3}, .intensity = 1});
        try {
            const BouncedPaths<double, double> paths(scene, lamps);
            return "accepted";
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
    };
    Material<double> partly = Material<double>::dielectric(1.5);
    CHECK(message_of(partly, false) == "accepted");
    CHECK(message_of(Material<double>::diffuse(0.5), true) == "accepted");
    CHECK(message_of(partly, true).find("no area") != std::string::npos);
    partly.transmission = 0.5;
    CHECK(message_of(partly, false).find("partly opaque") != std::string::npos);
}

} // namespace nephroid::examples::bounced_paths_test
