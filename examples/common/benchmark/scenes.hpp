// SPDX-License-Identifier: MIT
/// @file  The scene of the benchmarks: a wavy sheet of water as a mesh, traced by the examples' own tree or by Embree.
#pragma once

#include "common/benchmark/points.hpp"
#include "common/scene.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/vector/in_place.hpp"

#if defined(NEPHROID_EXAMPLES_HAS_EMBREE)
#include "drop_in/embree_rays.hpp"
#endif

#include <cmath>
#include <memory>
#include <numbers>

namespace nephroid::examples::benchmarks {

/// 2 side² triangles with smooth normals over the unit square and a little beyond, crests at z = 1.02.
[[nodiscard]] inline MeshData<float> wavy_sheet(std::size_t side) {
    MeshData<float> data;
    const double amplitude = 0.02, tau = 2 * std::numbers::pi;
    for (std::size_t i = 0; i < (side + 1) * (side + 1); ++i) {
        const double x = 1.1 * double(i % (side + 1)) / double(side) - 0.05;
        const double y = 1.1 * double(i / (side + 1)) / double(side) - 0.05;
        const double phase = tau * (2 * x + y), other = tau * (x - 3 * y), slope = amplitude / 2 * tau;
        const Vec normal(-slope * (2 * std::cos(phase) + std::cos(other)),
                         -slope * (std::cos(phase) - 3 * std::cos(other)), 1);
        data.positions.push_back(Vec(x, y, 1 + amplitude / 2 * (std::sin(phase) + std::sin(other))));
        data.normals.push_back(normalize(normal));
    }
    for (std::size_t row = 0; row < side; ++row)
        for (std::size_t column = 0; column < side; ++column) {
            const auto a = std::uint32_t(row * (side + 1) + column), b = std::uint32_t(a + side + 1);
            data.triangles.push_back({a, a + 1, b});
            data.triangles.push_back({a + 1, b + 1, b});
        }
    data.materials.assign(data.triangles.size(), 1);
    return data;
}

/// Water over a floor.
[[nodiscard]] inline Scene<float, float> water_scene(MeshData<float> sheet) {
    return Scene<float, float>({{Floor<float>(0), 0}, {TriangleMesh<float>(std::move(sheet)), 1}},
                               {Material<float>::diffuse(1), Material<float>::dielectric(1.33, false)});
}

/// From above, straight down, onto the unit square.
[[nodiscard]] inline DirectionalLight<Vec, float> sun() {
    return DirectionalLight<Vec, float>(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = Parallelogram<Vec>{{0, 0, 1.25f}, {1, 0, 0}, {0, 1, 0}}});
}

#if defined(NEPHROID_EXAMPLES_HAS_EMBREE)
/// A mesh in Embree.
class EmbreeMesh {
public:
    explicit EmbreeMesh(const MeshData<float>& data) : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
        const RTCGeometry geometry = triangle_geometry(device_, data.positions, data.triangles);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(scene_);
    }
    EmbreeMesh(const EmbreeMesh&) = delete;
    EmbreeMesh& operator=(const EmbreeMesh&) = delete;
    ~EmbreeMesh() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }

    /// @param coherent  whether to tell Embree that successive rays are close together
    [[nodiscard]] std::optional<Candidate<float>> nearest(const Ray<float>& ray, bool coherent = false) const {
        const RTCRayHit r = nearest_hit(scene_, ray.origin, ray.direction, ray.t_min, ray.t_max, coherent);
        if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID)
            return std::nullopt;
        return Candidate<float>{r.ray.tfar, r.hit.u, r.hit.v, r.hit.primID};
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

/// The water scene over Embree: the same hits and the same surfaces, found by Embree's rays.
class EmbreeWater {
public:
    using vector = Vec;
    using flux_type = float;

    /// @param scene  made by `water_scene`; must outlive this object
    explicit EmbreeWater(const Scene<float, float>& scene)
        : scene_(&scene), mesh_(std::get<TriangleMesh<float>>(scene.parts()[1].shape)), embree_(mesh_.data()),
          floor_(0) {}

    [[nodiscard]] std::optional<Hit<float>> intersect(const Vec& origin, const Vec& direction, float t_min,
                                                      float t_max) const {
        const Ray<float> ray{origin, direction, t_min, t_max};
        if (const auto water = embree_.nearest(ray)) // nothing lies above it
            return std::optional<Hit<float>>(std::in_place, InPlace{[&] { return mesh_.hit(ray, *water); }});
        if (const auto ground = floor_.nearest(ray, wide_t<float>(t_max)))
            return std::optional<Hit<float>>(std::in_place, InPlace{[&] { return floor_.hit(ray, *ground); }});
        return std::nullopt;
    }

    template <class Sampler>
    [[nodiscard]] Bounce<float, float> scatter(const Hit<float>& hit, const Vec& direction, Sampler& sampler) const {
        return scene_->scatter(hit, direction, sampler);
    }

private:
    const Scene<float, float>* scene_;
    const TriangleMesh<float>& mesh_;
    EmbreeMesh embree_;
    Floor<float> floor_;
};
#endif

} // namespace nephroid::examples::benchmarks
