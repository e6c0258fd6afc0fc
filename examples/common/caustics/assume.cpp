// SPDX-License-Identifier: MIT
#include "common/caustics/assume.hpp"

#include "common/text.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace nephroid::examples {

namespace {

constexpr std::array<double, 3> assumed_sun{-0.5, -1, 0.35}; // towards the assumed camera: the light is seen
constexpr const char* ground_name = "ground";

/// An axis-aligned box; empty by default.
struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

    [[nodiscard]] bool is_empty() const { return !(low.x <= high.x); }
    [[nodiscard]] float size() const { return glm::length(high - low); }
    void add(const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

/// The bounds of the meshes whose materials meet a condition.
template <class Condition>
[[nodiscard]] Bounds bounds_of(const SceneDescription& scene, const Condition& counts) {
    Bounds bounds;
    for (const MeshDescription& mesh : scene.meshes)
        if (counts(scene.materials[mesh.material]))
            for (const auto& triangle : mesh.triangles)
                for (const std::uint32_t corner : triangle)
                    bounds.add(mesh.positions[corner]);
    return bounds;
}

[[nodiscard]] Bounds specular_bounds(const SceneDescription& scene) {
    return bounds_of(scene, [](const MaterialDescription& m) { return m.is_specular(); });
}

[[nodiscard]] Bounds all_bounds(const SceneDescription& scene) {
    return bounds_of(scene, [](const MaterialDescription&) { return true; });
}

[[nodiscard]] bool is_diffuse(const MaterialDescription& m) { return !m.emits() && !m.is_specular(); }

/// Whether a triangle has a point below (x, z), lower than y.
[[nodiscard]] bool lies_below(const MeshDescription& mesh, const std::array<std::uint32_t, 3>& t,
                              const glm::dvec3& from) {
    const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    const auto side = [&](const glm::dvec3& p, const glm::dvec3& q) {
        return (q.x - p.x) * (from.z - p.z) - (q.z - p.z) * (from.x - p.x);
    };
    const double u = side(b, c), v = side(c, a), w = side(a, b), sum = u + v + w;
    const bool is_over = (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
    return is_over && sum != 0 && (u * a.y + v * b.y + w * c.y) / sum < from.y;
}

/// Whether diffuse surfaces lie under most of the specular ones, or under most of their light that falls straight down.
[[nodiscard]] bool has_floor(const SceneDescription& scene, const Bounds& specular) {
    constexpr int grid = 5;
    int found = 0;
    for (int i = 0; i < grid * grid; ++i) {
        const glm::dvec3 low(specular.low), size(glm::dvec3(specular.high) - low);
        const glm::dvec3 from = low + size * glm::dvec3((i % grid + 0.5) / grid, 0.5, (i / grid + 0.5) / grid);
        found += std::any_of(scene.meshes.begin(), scene.meshes.end(), [&](const MeshDescription& mesh) {
            return is_diffuse(scene.materials[mesh.material]) &&
                   std::any_of(mesh.triangles.begin(), mesh.triangles.end(),
                               [&](const auto& t) { return lies_below(mesh, t, from); });
        });
    }
    return 2 * found >= grid * grid;
}

void add_sun(SceneDescription& scene, const std::array<double, 3>& direction, double degrees) {
    LightDescription sun;
    sun.name = "sun";
    sun.direction = glm::vec3(glm::normalize(glm::dvec3(direction[0], direction[1], direction[2])));
    sun.intensity = glm::vec3(std::numbers::pi_v<float>); // white surfaces that face the sun have a radiance of 1
    sun.angular_diameter = static_cast<float>(degrees * std::numbers::pi / 180);
    scene.lights.push_back(sun);
}

/// @return  its height
float add_ground(SceneDescription& scene, const Bounds& specular, double albedo) {
    Bounds all = all_bounds(scene);
    const Bounds& on_it = specular.is_empty() ? all : specular;
    constexpr float gap = 1e-4f, reach = 50; // in units of the size; objects on the ground do not touch it
    const glm::vec3 middle = 0.5f * (on_it.low + on_it.high);
    const float half = reach * all.size(), y = on_it.low.y - gap * on_it.size();
    MaterialDescription material;
    material.name = ground_name;
    material.base_color = glm::vec3(static_cast<float>(albedo));
    material.metallic = 0;
    MeshDescription ground;
    ground.name = ground_name;
    ground.material = scene.materials.size();
    ground.positions = {{middle.x - half, y, middle.z - half},
                        {middle.x - half, y, middle.z + half},
                        {middle.x + half, y, middle.z + half},
                        {middle.x + half, y, middle.z - half}};
    ground.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.materials.push_back(material);
    scene.meshes.push_back(ground);
    return y;
}

/// Whether the file has light of its own.
[[nodiscard]] bool is_lit(const SceneDescription& scene) {
    return !scene.lights.empty() ||
           !bounds_of(scene, [](const MaterialDescription& m) { return m.emits(); }).is_empty();
}

} // namespace

Additions add_sun_and_ground(SceneDescription& scene, const Options& options) {
    Additions additions;
    const Bounds specular = specular_bounds(scene);
    if (scene.meshes.empty())
        return additions;
    const bool lit = is_lit(scene);
    const bool anything_diffuse = !bounds_of(scene, is_diffuse).is_empty();
    if (options.ground) {
        additions.ground_level = add_ground(scene, specular, *options.ground);
    } else if (!specular.is_empty() && (!anything_diffuse || (!lit && !has_floor(scene, specular)))) {
        constexpr double albedo = 0.8;
        additions.ground_level = add_ground(scene, specular, albedo);
        additions.assumed.push_back(text("nothing diffuse lies below what is specular: assumed --ground %g", albedo));
    }
    if (options.sun) {
        add_sun(scene, options.sun->direction, options.sun->degrees);
    } else if (!lit && !options.environment) {
        add_sun(scene, assumed_sun, 0);
        additions.assumed.push_back(
            text("no light in the file: assumed --sun %g,%g,%g", assumed_sun[0], assumed_sun[1], assumed_sun[2]));
    }
    return additions;
}

std::vector<glm::vec3> points_of_interest(const SceneDescription& scene, const Additions& additions) {
    Bounds shown = specular_bounds(scene);
    if (shown.is_empty())
        shown = all_bounds(scene);
    const Bounds specular = shown;
    if (additions.ground_level)
        for (const LightDescription& light : scene.lights)
            if (light.kind == LightDescription::Kind::directional && light.direction.y < 0)
                for (int i = 0; i < 8; ++i) {
                    const glm::vec3 corner(i & 1 ? specular.high.x : specular.low.x,
                                           i & 2 ? specular.high.y : specular.low.y,
                                           i & 4 ? specular.high.z : specular.low.z);
                    const float down = (corner.y - *additions.ground_level) / -light.direction.y;
                    shown.add(corner + (std::min)(down, 2 * specular.size()) * light.direction);
                }
    const glm::vec3 margin = 0.1f * (shown.high - shown.low);
    return {shown.low - margin, shown.high + margin};
}

} // namespace nephroid::examples
