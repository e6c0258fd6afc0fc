// SPDX-License-Identifier: MIT
/// @file  The smallest renderer with a caustic: a glass ball above a table, drawn into caustic.pgm.
#include <nephroid/caustics.hpp>
#include <nephroid/differential/curvature.hpp>
#include <nephroid/emission/light/directional.hpp>
#include <nephroid/vector/glm.hpp>

#include <glm/geometric.hpp>

#include <fstream>

using Vec = glm::vec3;
using Hit = nephroid::SurfaceHit<Vec, nephroid::AnyCurvature<nephroid::Flat, nephroid::ShapeOperator<Vec>>>;
using Scattering = nephroid::Scattering<float, float>;

// Your scene: it finds hits, says how the normal changes there, and what the surface does with light.
struct Scene {
    Vec centre{0, 0, 1.3f};
    float radius = 1, glass = 1.5f;

    std::optional<Hit> intersect(Vec origin, Vec direction, float t_min, float t_max) const {
        const Vec to_origin = origin - centre;
        const float b = glm::dot(to_origin, direction), c = glm::dot(to_origin, to_origin) - radius * radius;
        if (const float root = b * b - c; root > 0)
            for (const float t : {-b - std::sqrt(root), -b + std::sqrt(root)})
                if (t > t_min && t < t_max) {
                    const Vec normal = glm::normalize(to_origin + t * direction), at = centre + radius * normal;
                    return Hit{t,
                               at,
                               normal,
                               normal,
                               nephroid::sphere_curvature<Vec>(radius),
                               nephroid::rounding_error(origin, t, at),
                               1};
                }
        const float t = -origin.z / direction.z;
        if (!(t > t_min && t < t_max))
            return std::nullopt;
        const Vec at = origin + t * direction, up{0, 0, 1};
        return Hit{t, at, up, up, nephroid::Flat{}, nephroid::rounding_error(origin, t, at), 0};
    }

    Scattering scatter(const Hit& hit, Vec direction, auto& /*random numbers, if you need them*/) const {
        if (hit.surface == 0)
            return Scattering::deposit(); // the table is diffuse: splat the photon here
        const bool entering = glm::dot(direction, hit.geometric_normal) < 0;
        return Scattering::refract(1, entering ? 1 / glass : glass);
    }
};

struct EyeVertex { // where your camera's paths end: any struct with a position and a normal
    Vec position, normal;
    std::size_t pixel;
};

int main() {
    constexpr std::size_t size = 512;
    std::vector<EyeVertex> vertices;
    for (std::size_t i = 0; i < size * size; ++i)
        vertices.push_back({{float(i % size) / 256 - 1, float(i / size) / 256 - 1, 0}, {0, 0, 1}, i});

    const nephroid::EyePathMap map(vertices, &EyeVertex::position, &EyeVertex::normal);
    auto sums = nephroid::sums<float>(map);
    const nephroid::DirectionalLight<Vec, float> sun({.direction = {0.3f, 0, -1},
                                                      .irradiance = 1,
                                                      .patch = nephroid::BoundingSphere<Vec>{{0, 0, 1.3f}, 1},
                                                      .scene = nephroid::BoundingSphere<Vec>{{0, 0, 1}, 3}});
    nephroid::ThreadExecutor threads;

    const auto statistics = nephroid::caustics(Scene{}, sun, sums, {.count = 50'000}, threads);

    std::vector<float> irradiance(size * size);
    sums.for_each([&](std::size_t vertex, float e) { irradiance[vertices[vertex].pixel] += e; });

    std::ofstream picture("caustic.pgm", std::ios::binary);
    picture << "P5 " << size << ' ' << size << " 255\n";
    for (const float e : irradiance)
        picture.put(static_cast<char>(static_cast<unsigned char>(std::min(255.f, 60 * std::sqrt(e)))));
    return statistics[nephroid::Fate::splatted].flux > 0 && picture ? 0 : 1;
}
