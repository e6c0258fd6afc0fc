// SPDX-License-Identifier: MIT
#include "common/eye_paths.hpp"

#include "examples/worlds.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace nephroid::examples::eye_paths_test {

using namespace nephroid::examples::testing;
using nephroid::SerialExecutor;
using nephroid::ThreadExecutor;

namespace {

template <class T>
using Colors = Material<Vec3<T>>;

/// One ray straight down.
template <class T>
Camera<T> plumb_line() {
    return Camera<T>::orthographic({{T(0.1), T(0.2), 10}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, T(0.01), 1, 1);
}

template <class T>
T sum_of_weights(const EyePaths<T, Vec3<T>>& eye) {
    T sum = 0;
    for (const auto& vertex : eye.vertices)
        sum += vertex.weight.x;
    return sum;
}

} // namespace

TEST_CASE_TEMPLATE("eye paths: each sample of a diffuse floor is a vertex of its share", T, float, double) {
    const Vec3<T> albedo(T(0.2), T(0.5), T(0.8));
    const Scene<T> scene({{Floor<T>(0), 0}}, {Colors<T>::diffuse(albedo)});
    const auto camera = Camera<T>::orthographic({{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, T(1), 8, 6);
    const auto eye = trace_eye_paths(scene, camera, {.samples = 4}, SerialExecutor{});
    REQUIRE(eye.vertices.size() == 8 * 6 * 4);
    CHECK(eye.rays == 8 * 6 * 4);
    CHECK(eye.emitted.size() == 8 * 6);
    for (std::size_t i = 0; i < eye.vertices.size(); ++i) {
        const auto& vertex = eye.vertices[i];
        CHECK(vertex.pixel == i / 4);
        CHECK(vertex.position.z == 0);
        CHECK(vertex.normal == Vec3<T>(0, 0, 1));
        // Pixels are a third wide, and row 0 is the lowest y.
        CHECK(std::floor((vertex.position.x + T(8) / 6) * 3) == vertex.pixel % 8);
        CHECK(std::floor((vertex.position.y + 1) * 3) == vertex.pixel / 8);
        for (int band = 0; band < 3; ++band)
            CHECK(std::abs(vertex.weight[band] - albedo[band] / T(4 * std::numbers::pi)) <
                  2 * std::numeric_limits<T>::epsilon());
    }
}

// Pixels are a third wide and have 2 x 2 samples: sixths of the floor, seen from straight above. Positions are of the
// order of 2, and rounded.
TEST_CASE_TEMPLATE("eye paths: what the camera sees directly has its sample's part of the pixel", T, float, double) {
    const Scene<T> scene({{Floor<T>(0), 0}}, {Colors<T>::diffuse(Vec3<T>(T(0.5)))});
    const auto camera = Camera<T>::orthographic({{0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, T(1), 8, 6);
    const auto eye = trace_eye_paths(scene, camera, {.samples = 4}, SerialExecutor{});
    const T tolerance = 16 * std::numeric_limits<T>::epsilon();
    for (const auto& vertex : eye.vertices) {
        CHECK(nephroid::length(Vec3<T>(vertex.footprint.u - Vec3<T>(T(1) / 6, 0, 0))) <= tolerance);
        CHECK(nephroid::length(Vec3<T>(vertex.footprint.v - Vec3<T>(0, T(1) / 6, 0))) <= tolerance);
    }
}

TEST_CASE_TEMPLATE("eye paths: a floor seen from below has its normal below", T, float, double) {
    const Scene<T> scene({{Floor<T>(0), 0}}, {Colors<T>::diffuse(Vec3<T>(1))});
    const auto camera = Camera<T>::orthographic({{0, 0, -2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, T(1), 1, 1);
    const auto eye = trace_eye_paths(scene, camera, {}, SerialExecutor{});
    REQUIRE(eye.vertices.size() == 1);
    CHECK(eye.vertices[0].normal == Vec3<T>(0, 0, -1));
    CHECK(eye.vertices[0].shading_normal == Vec3<T>(0, 0, -1));
}

// Through a slab of reflectance R on each side and transmittance τ across, with j pairs of reflections inside:
// (1 − R)² τ (R τ)^(2j). Paths lighter than the least weight are left out.
TEST_CASE_TEMPLATE("eye paths: behind a slab of glass the weights are the slab's series", T, float, double) {
    Colors<T> glass = Colors<T>::dielectric(1.5);
    glass.absorption = Vec3<T>(T(0.5));
    const Scene<T> scene({{TriangleMesh<T>(sheet<T>(5, 3, true, 1)), 0},
                          {TriangleMesh<T>(sheet<T>(5, 2, false, 1)), 0},
                          {Floor<T>(0), 0}},
                         {Colors<T>::diffuse(Vec3<T>(1)), glass});
    const auto eye = trace_eye_paths(scene, plumb_line<T>(), {.least_weight = 1e-5}, SerialExecutor{});
    const T reflected = T(0.04), passed = std::exp(T(-0.5));
    REQUIRE(eye.vertices.size() >= 2);
    for (std::size_t j = 0; j < 2; ++j) {
        const T expected = (1 - reflected) * (1 - reflected) * passed * std::pow(reflected * passed, T(2 * j));
        T nearest = 1;
        for (const auto& vertex : eye.vertices)
            nearest = std::min(nearest, std::abs(vertex.weight.x * T(std::numbers::pi) - expected));
        // Rays start off a surface by its position error, of a few hundred roundings: the way inside is shorter by
        // that.
        CHECK(nearest < 1000 * std::numeric_limits<T>::epsilon());
    }
    // Index and distance cancel on the way through: the vertices lie straight below.
    for (const auto& vertex : eye.vertices)
        CHECK(std::abs(vertex.position.x - T(0.1)) < 16 * std::numeric_limits<T>::epsilon());
}

// Under water radiance is higher by n²: a floor seen through the surface is darker by as much.
TEST_CASE_TEMPLATE("eye paths: into water the weight falls with the square of the index", T, float, double) {
    const Scene<T> scene({{TriangleMesh<T>(sheet<T>(5, 1, true, 1)), 0}, {Floor<T>(0), 0}},
                         {Colors<T>::diffuse(Vec3<T>(1)), Colors<T>::dielectric(1.25)});
    const auto eye = trace_eye_paths(scene, plumb_line<T>(), {}, SerialExecutor{});
    const T reflected = T((0.25 / 2.25) * (0.25 / 2.25));
    REQUIRE(eye.vertices.size() == 1);
    CHECK(std::abs(eye.vertices[0].weight.x * T(std::numbers::pi) - (1 - reflected) / T(1.5625)) <
          16 * std::numeric_limits<T>::epsilon());
}

// The first leg too runs through water: exp(-0.5 d) of the floor's light arrives over the distance d.
TEST_CASE_TEMPLATE("eye paths: a camera under water sees through water from its first leg on", T, float, double) {
    Colors<T> water = Colors<T>::dielectric(1.33);
    water.absorption = Vec3<T>(T(0.5));
    const auto weight_from = [&](T height, const MeshData<T>& surface) {
        const Scene<T> scene({{TriangleMesh<T>(surface), 0}, {Floor<T>(0), 0}},
                             {Colors<T>::diffuse(Vec3<T>(1)), water});
        const auto camera =
            Camera<T>::orthographic({{T(0.1), T(0.2), height}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, T(0.01), 1, 1);
        return T(std::numbers::pi) * sum_of_weights(trace_eye_paths(scene, camera, {}, SerialExecutor{}));
    };
    // The faces of the globe are flat: up to 1 - cos(pi / 32) below its radius, so 0.8 is inside.
    MeshData<T> drop = globe<T>(32);
    drop.materials.assign(drop.triangles.size(), 1);
    for (const T height : {T(0.25), T(0.8)}) {
        const T expected = std::exp(T(-0.5) * height), rounding = 64 * std::numeric_limits<T>::epsilon();
        CHECK(std::abs(weight_from(height, sheet<T>(5, 1, true, 1)) - expected) < rounding);
        CHECK(std::abs(weight_from(height, drop) - expected) < rounding);
    }
    // From above it loses what is reflected, and n squared, and light along the water alone.
    const T passed = T((1 - (0.33 / 2.33) * (0.33 / 2.33)) / (1.33 * 1.33)) * std::exp(T(-0.5));
    CHECK(std::abs(weight_from(T(3), sheet<T>(5, 1, true, 1)) - passed) < 1000 * std::numeric_limits<T>::epsilon());
}

// Along its axis light meets a globe at its poles, where 64 triangles have a common vertex. There it passes as through
// a slab: (1 - R)^2 (1 + R^2 + ...) = (1 - R) / (1 + R). The globe may stand on the floor.
TEST_CASE_TEMPLATE("eye paths: a ray through a vertex of many triangles passes all of them", T, float, double) {
    constexpr double reflected = 0.04, expected = (1 - reflected) / (1 + reflected);
    for (const T height : {T(2), T(1)}) {
        MeshData<T> ball = globe<T>(32, 0, Vec3<T>(0, 0, height));
        ball.materials.assign(ball.triangles.size(), 1);
        const Scene<T> scene({{TriangleMesh<T>(ball), 0}, {Floor<T>(0), 0}},
                             {Colors<T>::diffuse(Vec3<T>(1)), Colors<T>::dielectric(1.5)});
        const auto camera = Camera<T>::orthographic({{0, 0, 10}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, T(0.01), 1, 1);
        const auto eye = trace_eye_paths(scene, camera, {.max_depth = 64, .least_weight = 1e-18}, SerialExecutor{});
        CAPTURE(height);
        CHECK(std::abs(std::numbers::pi * double(sum_of_weights(eye)) - expected) <
              64 * double(std::numeric_limits<T>::epsilon())); // a few roundings for each of some ten surfaces
    }
}

TEST_CASE_TEMPLATE("eye paths: mirrors and metals reflect to what is behind the camera", T, float, double) {
    const Vec3<T> color(T(0.3), T(0.6), T(0.9));
    const Scene<T> mirror({{TriangleMesh<T>(sheet<T>(5, 0, true, 1)), 0}, {Floor<T>(20), 0}},
                          {Colors<T>::diffuse(Vec3<T>(1)), Colors<T>::mirror(color)});
    const auto eye = trace_eye_paths(mirror, plumb_line<T>(), {}, SerialExecutor{});
    REQUIRE(eye.vertices.size() == 1);
    CHECK(eye.vertices[0].position.z == 20);
    CHECK(eye.vertices[0].normal == Vec3<T>(0, 0, -1));
    CHECK(eye.vertices[0].footprint.u == Vec3<T>(0)); // not known
    CHECK(std::abs(eye.vertices[0].weight.y * T(std::numbers::pi) - color.y) < 4 * std::numeric_limits<T>::epsilon());
    CHECK(trace_eye_paths(mirror, plumb_line<T>(), {.max_depth = 0}, SerialExecutor{}).vertices.empty());

    const Scene<T> hall({{TriangleMesh<T>(sheet<T>(5, 0, true, 0)), 0}, {TriangleMesh<T>(sheet<T>(5, 20, true, 0)), 0}},
                        {Colors<T>::mirror(Vec3<T>(1))});
    CHECK(trace_eye_paths(hall, plumb_line<T>(), {.max_depth = 16}, SerialExecutor{}).rays == 17);
}

TEST_CASE_TEMPLATE("eye paths: an emitter is seen on its bright side and through glass", T, float, double) {
    const Vec3<T> radiance(1, 2, 3);
    for (const bool faces_camera : {true, false})
        for (const bool both_sides : {true, false}) {
            const Scene<T> scene({{TriangleMesh<T>(sheet<T>(5, 1, faces_camera, 0)), 0}},
                                 {Colors<T>::emitter(radiance, both_sides)});
            const auto eye = trace_eye_paths(scene, plumb_line<T>(), {.samples = 4}, SerialExecutor{});
            CHECK(eye.vertices.empty());
            CHECK(nephroid::length(Vec3<T>(eye.emitted[0] - (faces_camera || both_sides ? radiance : Vec3<T>(0)))) <
                  8 * std::numeric_limits<T>::epsilon());
        }
    const Scene<T> behind_glass({{Sphere<T>({T(0.1), T(0.2), 3}, 1), 1}, {TriangleMesh<T>(sheet<T>(5, 1, true, 0)), 0}},
                                {Colors<T>::emitter(radiance), Colors<T>::dielectric(1.5)});
    const auto eye = trace_eye_paths(behind_glass, plumb_line<T>(), {.least_weight = 1e-4}, SerialExecutor{});
    // The first path is 0.96²; 0.96² 0.04² is reflected twice inside: below the sum, above it the whole series.
    CHECK(eye.emitted[0].x > T(0.9216));
    CHECK(eye.emitted[0].x < T(0.9232));
}

TEST_CASE("eye paths: they are the same for any number of threads") {
    const Scene<float> scene({{Floor<float>(0), 0}, {Sphere<float>({0, 0, 1}, 1), 1}, {Sphere<float>({2, 0, 1}, 1), 2}},
                             {Colors<float>::diffuse(Vec3<float>(0.5f)), Colors<float>::dielectric(1.5),
                              Colors<float>::mirror(Vec3<float>(0.9f))});
    const auto camera = Camera<float>::perspective({{0, -6, 2}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, 0.8f, 61, 47);
    const auto one = trace_eye_paths(scene, camera, {.samples = 3}, SerialExecutor{});
    CHECK(one.vertices.size() > 61 * 47);
    for (const unsigned threads : {2u, 7u}) {
        const auto many = trace_eye_paths(scene, camera, {.samples = 3}, ThreadExecutor(threads));
        REQUIRE(many.vertices.size() == one.vertices.size());
        CHECK(many.rays == one.rays);
        CHECK(many.emitted == one.emitted);
        std::size_t different = 0;
        for (std::size_t i = 0; i < one.vertices.size(); ++i)
            different += many.vertices[i].position != one.vertices[i].position ||
                         many.vertices[i].weight != one.vertices[i].weight ||
                         many.vertices[i].pixel != one.vertices[i].pixel;
        CHECK(different == 0);
    }
}

// A white furnace seen through glass: all radiance comes back, but for the paths that are cut off.
TEST_CASE_TEMPLATE("eye paths: glass between white walls keeps nearly all weight", T, float, double) {
    const Scene<T> scene({{Floor<T>(0), 0}, {Floor<T>(20), 0}, {Sphere<T>({0, 0, 5}, 1), 1}},
                         {Colors<T>::diffuse(Vec3<T>(1)), Colors<T>::dielectric(1.5)});
    for (const T x : {T(0.1), T(0.5), T(0.9), T(0.99)}) {
        const auto camera = Camera<T>::orthographic({{x, 0, 10}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}}, T(0.001), 1, 1);
        const auto eye = trace_eye_paths(scene, camera, {.max_depth = 64, .least_weight = 1e-5}, SerialExecutor{});
        const T weight = sum_of_weights(eye) * T(std::numbers::pi);
        CHECK(weight <= 1 + 64 * std::numeric_limits<T>::epsilon());
        CHECK(weight > 1 - T(1e-3));
    }
}

} // namespace nephroid::examples::eye_paths_test
