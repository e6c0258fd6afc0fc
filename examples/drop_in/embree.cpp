// SPDX-License-Identifier: MIT
/// @file  Caustics in a renderer on Embree 3 or 4: a glass ball as a triangle mesh with interpolated normals, or as
///        user geometry (`embree picture.pfm user`).
#include "embree_rays.hpp"
#include "picture.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

/// The renderer as it was before.
namespace renderer {

/// As in Embree's own examples: one register.
struct alignas(16) Vec3fa {
    float x, y, z, w = 0;
    friend Vec3fa operator+(const Vec3fa& a, const Vec3fa& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vec3fa operator-(const Vec3fa& a, const Vec3fa& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vec3fa operator-(const Vec3fa& a) { return {-a.x, -a.y, -a.z}; }
    friend Vec3fa operator*(float s, const Vec3fa& a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline float dot(const Vec3fa& a, const Vec3fa& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3fa normalize(const Vec3fa& a) { return 1 / std::sqrt(dot(a, a)) * a; }

struct Mesh {
    std::vector<Vec3fa> positions, normals; ///< normals only of smooth meshes
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Ball {
    Vec3fa center;
    float radius;
};

/// What Embree's geometry number g is: a mesh, or else a ball; glass, or else diffuse.
struct Object {
    Mesh mesh;
    Ball ball{{0, 0, 0}, 0};
    float refractive_index = 0; ///< 0 is diffuse
};

class Scene {
public:
    Scene() : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    }
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;
    ~Scene() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    void add_mesh(const Mesh& mesh, float refractive_index) {
        attach(triangle_geometry(device_, mesh.positions, mesh.triangles), {mesh, {{0, 0, 0}, 0}, refractive_index});
    }

    /// The ball is not copied.
    void add_ball(Ball& ball, float refractive_index) {
        const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, 1);
        rtcSetGeometryUserData(geometry, &ball);
        rtcSetGeometryBoundsFunction(geometry, bound_ball, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect_ball);
        attach(geometry, {{}, ball, refractive_index});
    }

    void commit() { rtcCommitScene(scene_); }

    [[nodiscard]] const Object& object(unsigned geometry) const { return objects_[geometry]; }

    /// The hit's geomID is RTC_INVALID_GEOMETRY_ID where there is none.
    [[nodiscard]] RTCRayHit trace(const Vec3fa& o, const Vec3fa& d, float t_min, float t_max) const {
        return nearest_hit(scene_, o, d, t_min, t_max);
    }

private:
    void attach(RTCGeometry geometry, Object object) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry); // numbers them from 0
        rtcReleaseGeometry(geometry);
        objects_.push_back(std::move(object));
    }

    static void bound_ball(const RTCBoundsFunctionArguments* args) {
        const Ball& b = *static_cast<const Ball*>(args->geometryUserPtr);
        const float r = 1.0001f * b.radius;
        args->bounds_o->lower_x = b.center.x - r, args->bounds_o->upper_x = b.center.x + r;
        args->bounds_o->lower_y = b.center.y - r, args->bounds_o->upper_y = b.center.y + r;
        args->bounds_o->lower_z = b.center.z - r, args->bounds_o->upper_z = b.center.z + r;
    }

    static void intersect_ball(const RTCIntersectFunctionNArguments* args) {
        if (args->valid[0] == 0) // rays come one at a time here
            return;
        const Ball& b = *static_cast<const Ball*>(args->geometryUserPtr);
        auto& [ray, hit] = *reinterpret_cast<RTCRayHit*>(args->rayhit);
        const Vec3fa o = Vec3fa{ray.org_x, ray.org_y, ray.org_z} - b.center, d{ray.dir_x, ray.dir_y, ray.dir_z};
        const float middle = -dot(o, d);
        const Vec3fa closest = o + middle * d;
        const float half_chord2 = b.radius * b.radius - dot(closest, closest);
        if (half_chord2 < 0)
            return;
        for (const float t : {middle - std::sqrt(half_chord2), middle + std::sqrt(half_chord2)})
            if (t > ray.tnear && t < ray.tfar) {
                const Vec3fa n = o + t * d;
                ray.tfar = t;
                hit.Ng_x = n.x, hit.Ng_y = n.y, hit.Ng_z = n.z;
                hit.geomID = args->geomID;
                hit.primID = args->primID;
                return;
            }
    }

    RTCDevice device_;
    RTCScene scene_;
    std::vector<Object> objects_;
};

/// A ball of longitudes × latitudes quadrilaterals, in triangles that wind to the outside; its normals are the ball's.
Mesh ball_mesh(const Ball& ball, unsigned longitudes, unsigned latitudes) {
    Mesh mesh;
    const double pi = std::numbers::pi;
    for (unsigned j = 0; j <= latitudes; ++j)
        for (unsigned i = 0; i <= longitudes; ++i) {
            const double theta = pi * j / latitudes, phi = 2 * pi * i / longitudes;
            const Vec3fa n{float(std::sin(theta) * std::cos(phi)), float(std::sin(theta) * std::sin(phi)),
                           float(std::cos(theta))};
            mesh.normals.push_back(n);
            mesh.positions.push_back(ball.center + ball.radius * n);
        }
    for (std::uint32_t j = 0; j < latitudes; ++j)
        for (std::uint32_t i = 0; i < longitudes; ++i) {
            const std::uint32_t a = j * (longitudes + 1) + i, below = a + longitudes + 1;
            if (j > 0)
                mesh.triangles.push_back({a, below, a + 1});
            if (j + 1 < latitudes)
                mesh.triangles.push_back({a + 1, below, below + 1});
        }
    return mesh;
}

/// Where a pixel's ray has ended on a diffuse surface.
struct Seen {
    Vec3fa position, normal;
    std::size_t pixel;
};

/// An orthographic camera that looks down at [-1/2, 1/2]²; here it sees the floor through the ball.
std::vector<Seen> trace_camera(std::size_t size) {
    std::vector<Seen> seen;
    const auto at = [size](std::size_t i) { return (float(i) + 0.5f) / float(size) - 0.5f; };
    for (std::size_t pixel = 0; pixel < size * size; ++pixel)
        seen.push_back({{at(pixel % size), at(pixel / size), 0}, {0, 0, 1}, pixel});
    return seen;
}

} // namespace renderer

// adapter begins
#include <nephroid/nephroid.hpp>

using renderer::Vec3fa;

// How nephroid reads and makes the renderer's vector; it then uses the operators that the vector has.
template <>
struct nephroid::vector_traits<Vec3fa> {
    using scalar = float;
    static Vec3fa make(float x, float y, float z) { return {x, y, z}; }
    static float x(const Vec3fa& v) { return v.x; }
    static float y(const Vec3fa& v) { return v.y; }
    static float z(const Vec3fa& v) { return v.z; }
};

// The renderer's scene as one that photons walk through.
struct CausticScene {
    // A hit says how its normal changes: not at all, as vertex normals are interpolated, or as a surface of its own
    // does.
    using Curvature = nephroid::AnyCurvature<nephroid::Flat, nephroid::InterpolatedCurvature<Vec3fa>,
                                             nephroid::ShapeOperator<Vec3fa>>;
    using Hit = nephroid::SurfaceHit<Vec3fa, Curvature>;
    using Scattering = nephroid::Scattering<float, float>;
    const renderer::Scene& scene;

    std::optional<Hit> intersect(const Vec3fa& o, const Vec3fa& d, float t_min, float t_max) const {
        const auto [ray, hit] = scene.trace(o, d, t_min, t_max);
        if (hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return std::nullopt;
        const Vec3fa n = normalize(Vec3fa{hit.Ng_x, hit.Ng_y, hit.Ng_z}); // Embree's is of any length
        const renderer::Object& object = scene.object(hit.geomID);
        if (object.mesh.triangles.empty()) { // user geometry: the ball, whose normal turns by 1/radius
            const Vec3fa at = object.ball.center + object.ball.radius * n; // closer to the ball than o + t d
            const float error = nephroid::rounding_error(object.ball.center, object.ball.radius, at);
            return Hit{ray.tfar, at, n, n, nephroid::sphere_curvature<Vec3fa>(object.ball.radius), error, hit.geomID};
        }
        const auto [i0, i1, i2] = object.mesh.triangles[hit.primID];
        const auto& p = object.mesh.positions;
        const Vec3fa at = p[i0] + (hit.u * (p[i1] - p[i0]) + hit.v * (p[i2] - p[i0])); // closer than o + t d, again
        const float error = nephroid::rounding_error(p[i0], 0, at); // so that the next ray does not hit this triangle
        if (object.mesh.normals.empty())
            return Hit{ray.tfar, at, n, n, nephroid::Flat{}, error, hit.geomID};
        const Vec3fa &n0 = object.mesh.normals[i0], &n1 = object.mesh.normals[i1], &n2 = object.mesh.normals[i2];
        const Vec3fa shading = normalize(n0 + (hit.u * (n1 - n0) + hit.v * (n2 - n0)));
        const auto curvature = nephroid::interpolated_normals(p[i0], p[i1], p[i2], n0, n1, n2, hit.u, hit.v);
        return Hit{ray.tfar, at, n, shading, curvature, error, hit.geomID};
    }

    Scattering scatter(const Hit& hit, const Vec3fa& direction, auto& /*random numbers*/) const {
        const float index = scene.object(unsigned(hit.surface)).refractive_index;
        if (index == 0)
            return Scattering::deposit(); // diffuse: the photon is splatted
        const bool entering = dot(direction, hit.geometric_normal) < 0;
        return Scattering::refract(1, entering ? 1 / index : index); // the whole flux; n before over n behind
    }
};

// Adds the caustics' irradiance to each pixel's.
void add_caustics(const renderer::Scene& scene, const std::vector<renderer::Seen>& seen, std::vector<float>& film) {
    const nephroid::EyePathMap map(seen, &renderer::Seen::position, &renderer::Seen::normal);
    auto sums = nephroid::sums<float>(map);
    const nephroid::BoundingSphere<Vec3fa> glass{{0, 0, 1.25f}, 1}; // what the sun is aimed at
    const nephroid::DirectionalLight<Vec3fa, float> sun({.direction = {0, 0, -1}, .irradiance = 1, .patch = glass});
    nephroid::ThreadExecutor threads; // Embree's scenes may be asked by many at a time
    for (const std::string& sentence : nephroid::diagnose(
             nephroid::caustics(CausticScene{scene}, sun, sums, {.count = 50'000, .smoothing = 5}, threads)))
        std::cerr << sentence << '\n';
    sums.for_each([&](std::size_t i, float irradiance) { film[seen[i].pixel] += irradiance; });
}
// adapter ends

int main(int argc, char** argv) {
    renderer::Scene scene;
    renderer::Ball ball{{0, 0, 1.25f}, 1};
    scene.add_mesh({{{-9, -9, 0}, {9, -9, 0}, {-9, 9, 0}, {9, 9, 0}}, {}, {{{0, 1, 2}}, {{2, 1, 3}}}}, 0);
    if (argc > 2 && argv[2] == std::string("user"))
        scene.add_ball(ball, 1.5f);
    else
        scene.add_mesh(ball_mesh(ball, 1024, 512), 1.5f);
    scene.commit();

    constexpr std::size_t size = 256;
    std::vector<float> film(size * size);
    add_caustics(scene, renderer::trace_camera(size), film);
    return write_pfm(argc > 1 ? argv[1] : "embree.pfm", size, 1, film) ? 0 : 1;
}
