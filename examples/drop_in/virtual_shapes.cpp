// SPDX-License-Identifier: MIT
/// @file  Caustics in a renderer with virtual shapes and materials, whose hits hold a distance, a normal and a material
///        and know nothing of curvature.
#include "picture.hpp"

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

/// The renderer as it was before.
namespace renderer {

struct Vec {
    float x, y, z;
    Vec operator+(Vec v) const { return {x + v.x, y + v.y, z + v.z}; }
    Vec operator-(Vec v) const { return {x - v.x, y - v.y, z - v.z}; }
    Vec operator*(float s) const { return {s * x, s * y, s * z}; }
    static float Dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

struct Ray {
    Vec origin, direction;
    float t_min = 0, t_max = std::numeric_limits<float>::infinity();
};

struct Hit {
    float distance;
    Vec normal;
    int material;
};

class Shape {
public:
    virtual ~Shape() = default;
    virtual bool intersect(const Ray& ray, Hit& hit) const = 0;
};

class Sphere : public Shape {
public:
    Sphere(Vec centre, float radius, int material) : centre_(centre), radius_(radius), material_(material) {}

    bool intersect(const Ray& ray, Hit& hit) const override {
        const Vec o = ray.origin - centre_;
        const float middle = -Vec::Dot(o, ray.direction);
        const Vec closest = o + ray.direction * middle;
        const float half_chord2 = radius_ * radius_ - Vec::Dot(closest, closest);
        if (half_chord2 < 0)
            return false;
        for (const float t : {middle - std::sqrt(half_chord2), middle + std::sqrt(half_chord2)})
            if (t > ray.t_min && t < ray.t_max) {
                const Vec n = o + ray.direction * t;
                hit = {t, n * (1 / std::sqrt(Vec::Dot(n, n))), material_};
                return true;
            }
        return false;
    }

private:
    Vec centre_;
    float radius_;
    int material_;
};

class Floor : public Shape {
public:
    explicit Floor(int material) : material_(material) {}

    bool intersect(const Ray& ray, Hit& hit) const override {
        const float t = -ray.origin.z / ray.direction.z;
        if (!(t > ray.t_min && t < ray.t_max))
            return false;
        hit = {t, {0, 0, 1}, material_};
        return true;
    }

private:
    int material_;
};

class Material {
public:
    virtual ~Material() = default;
    /// 0 for what is not transparent.
    [[nodiscard]] virtual float refractive_index() const { return 0; }
};

class Glass : public Material {
public:
    [[nodiscard]] float refractive_index() const override { return 1.5f; }
};

struct World {
    std::vector<std::unique_ptr<Shape>> shapes;
    std::vector<std::unique_ptr<Material>> materials;
    float size = 1; ///< of a typical object

    bool intersect(Ray ray, Hit& hit) const {
        bool found = false;
        for (const auto& shape : shapes)
            if (shape->intersect(ray, hit)) {
                ray.t_max = hit.distance;
                found = true;
            }
        return found;
    }
};

/// Where a pixel's ray has ended on a diffuse surface.
struct Seen {
    Vec position, normal;
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

using renderer::Vec;

// How nephroid reads and makes the renderer's vector. All else that it does with vectors follows from these.
template <>
struct nephroid::vector_traits<Vec> {
    using scalar = float;
    static Vec make(float x, float y, float z) { return {x, y, z}; }
    static float x(const Vec& v) { return v.x; }
    static float y(const Vec& v) { return v.y; }
    static float z(const Vec& v) { return v.z; }
};

// The renderer's world as a scene that photons walk through: where they hit, and what happens there.
struct CausticScene {
    using Curvature = nephroid::FiniteDifferenceCurvature<Vec, CausticScene>; // the renderer knows none
    using Hit = nephroid::SurfaceHit<Vec, Curvature>;
    using Scattering = nephroid::Scattering<float, float>; // flux is a float here, and so is the refractive index
    const renderer::World& world;

    std::optional<Hit> intersect(const Vec& origin, const Vec& direction, float t_min, float t_max) const {
        renderer::Hit found;
        if (!world.intersect({origin, direction, t_min, t_max}, found))
            return std::nullopt;
        const Vec at = origin + direction * found.distance;
        Hit hit{.distance = found.distance,
                .position = at,
                .geometric_normal = found.normal,
                .shading_normal = found.normal, // the renderer has but one
                .curvature = {},                // filled in below, as it needs the hit
                .position_error =
                    nephroid::rounding_error(origin, found.distance, at), // starts the next ray off the surface
                .surface = std::size_t(found.material)};
        // Not computed here: where the photon meets glass, rays beside the hit are traced through this same function.
        hit.curvature = nephroid::finite_difference_curvature(*this, hit, world.size);
        return hit;
    }

    Scattering scatter(const Hit& hit, const Vec& direction, auto& /*random numbers*/) const {
        const float index = world.materials[hit.surface]->refractive_index();
        if (index == 0)
            return Scattering::deposit(); // a diffuse surface: splat the photon, its walk ends
        const bool entering = Vec::Dot(direction, hit.geometric_normal) < 0;
        return Scattering::refract(1, entering ? 1 / index : index); // none of the flux is lost; n before over n behind
    }
};

// Adds the caustics' irradiance to each pixel's.
void add_caustics(const renderer::World& world, const std::vector<renderer::Seen>& seen, std::vector<float>& film) {
    // The points that the camera sees, in a tree.
    const nephroid::EyePathMap map(seen, &renderer::Seen::position, &renderer::Seen::normal);
    auto sums = nephroid::sums<float>(map); // and the irradiance at each
    // The sun, aimed at the ball: no photon is wasted on the floor around it.
    const nephroid::DirectionalLight<Vec, float> sun(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = nephroid::BoundingSphere<Vec>{{0, 0, 1.25f}, 1}});
    nephroid::ThreadExecutor threads; // one per core; the result does not depend on their number
    for (const std::string& sentence : nephroid::diagnose(
             nephroid::caustics(CausticScene{world}, sun, sums, {.count = 50'000, .smoothing = 5}, threads)))
        std::cerr << sentence << '\n';
    // A pixel's radiance would be this times albedo / π and the weight of the camera's path.
    sums.for_each([&](std::size_t i, float irradiance) { film[seen[i].pixel] += irradiance; });
}
// adapter ends

int main(int argc, char** argv) {
    renderer::World world;
    world.materials.push_back(std::make_unique<renderer::Material>());
    world.materials.push_back(std::make_unique<renderer::Glass>());
    world.shapes.push_back(std::make_unique<renderer::Floor>(0));
    world.shapes.push_back(std::make_unique<renderer::Sphere>(Vec{0, 0, 1.25f}, 1.f, 1));

    constexpr std::size_t size = 256;
    std::vector<float> film(size * size);
    add_caustics(world, renderer::trace_camera(size), film);
    return write_pfm(argc > 1 ? argv[1] : "virtual_shapes.pfm", size, 1, film) ? 0 : 1;
}
