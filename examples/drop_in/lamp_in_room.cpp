// SPDX-License-Identifier: MIT
/// @file  Caustics in a renderer whose lamp stands in the scene, whose rays skip their first thousandth, and whose hits
///        know their material and no more: a table and the floor under it are the same to them.
#include "picture.hpp"

#include <array>
#include <cmath>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

/// The renderer as it was before.
namespace renderer {

struct Vec3 {
    float x, y, z;
};
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline float length(Vec3 a) { return std::sqrt(a.x * a.x + a.y * a.y + a.z * a.z); }

constexpr float epsilon = 0.001f; // against shadows on a surface by itself

enum Material { diffuse, mirror, lamp };

/// A rectangle at a height, its sides along the axes; seen from above and from below.
struct Rectangle {
    float x0, y0, x1, y1, height;
    Material material;
};

struct Room {
    std::vector<Rectangle> rectangles{{-4, -4, 4, 4, 0, diffuse},            // the floor
                                      {0.6f, -0.4f, 1.4f, 0.4f, 1, diffuse}, // a table
                                      {-4, -4, 4, 4, 4, mirror},             // the ceiling
                                      {-0.15f, -0.15f, 0.15f, 0.15f, 2.5f, lamp}};
    float radiance = 10; ///< of the lamp, upwards

    struct Hit {
        float t;
        Vec3 normal;
        Material material;
    };

    [[nodiscard]] std::optional<Hit> trace(Vec3 from, Vec3 direction, float t_max = 1e30f) const {
        std::optional<Hit> nearest;
        for (const Rectangle& r : rectangles) {
            const float t = (r.height - from.z) / direction.z;
            const float x = from.x + t * direction.x, y = from.y + t * direction.y;
            if (t > epsilon && t < t_max && x >= r.x0 && x <= r.x1 && y >= r.y0 && y <= r.y1) {
                nearest = {t, {0, 0, direction.z < 0 ? 1.f : -1.f}, r.material}; // turned towards the ray
                t_max = t;
            }
        }
        return nearest;
    }
};

struct Seen {
    Vec3 position, normal;
    std::size_t pixel;
};

/// From straight above, [-1.5, 1.5]²; the ceiling is not looked at.
std::vector<Seen> trace_camera(const Room& room, std::size_t size) {
    std::vector<Seen> seen;
    const auto at = [size](std::size_t i) { return 3 * (float(i) + 0.5f) / float(size) - 1.5f; };
    for (std::size_t pixel = 0; pixel < size * size; ++pixel) {
        const Vec3 eye{at(pixel % size), at(pixel / size), 3.5f};
        if (const auto hit = room.trace(eye, {0, 0, -1}); hit->material == diffuse)
            seen.push_back({{eye.x, eye.y, eye.z - hit->t}, hit->normal, pixel});
    }
    return seen;
}

/// What the lamp's mirror image gives a point: the sum over the lamp's points, as far as nothing is in the way.
float exact_irradiance(const Room& room, Vec3 at) {
    constexpr int n = 12;
    const Rectangle ceiling = room.rectangles[2], lamp = room.rectangles[3];
    const float width = lamp.x1 - lamp.x0, cell = width * width / (n * n);
    float sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const Vec3 image{lamp.x0 + width * (float(i % n) + 0.5f) / n, lamp.y0 + width * (float(i / n) + 0.5f) / n,
                         2 * ceiling.height - lamp.height};
        const Vec3 away = image - at;
        const float distance = length(away), cosine = away.z / distance;
        const Vec3 up = (1 / distance) * away, down{up.x, up.y, -up.z};
        const float to_ceiling = (ceiling.height - at.z) / up.z;
        const bool is_lit = room.trace(at, up)->material == mirror &&
                            room.trace(at + to_ceiling * up, down)->material == renderer::lamp;
        sum += is_lit ? room.radiance * cosine * cosine * cell / (distance * distance) : 0;
    }
    return sum;
}

} // namespace renderer

// adapter begins
#include <nephroid/nephroid.hpp>

using renderer::Vec3;

template <>
struct nephroid::vector_traits<Vec3> {
    using scalar = float;
    static Vec3 make(float x, float y, float z) { return {x, y, z}; }
    static float x(const Vec3& v) { return v.x; }
    static float y(const Vec3& v) { return v.y; }
    static float z(const Vec3& v) { return v.z; }
};

struct CausticScene {
    using Hit = nephroid::SurfaceHit<Vec3, nephroid::Flat>;
    using Scattering = nephroid::MirrorScattering<float>;
    static constexpr float tracer_epsilon = renderer::epsilon; // rays begin so much further back, and skip nothing
    const renderer::Room& room;

    std::optional<Hit> intersect(const Vec3& origin, const Vec3& direction, float, float t_max) const {
        const auto found = room.trace(origin, direction, t_max);
        if (!found)
            return std::nullopt;
        const Vec3 at = origin + found->t * direction;
        return Hit{.distance = found->t,
                   .position = at,
                   .geometric_normal = found->normal,
                   .shading_normal = found->normal,
                   .curvature = {},
                   .position_error = nephroid::rounding_error(origin, found->t, at),
                   .surface = std::size_t(found->material)}; // no object: the library looks for edges and steps itself
    }
    Scattering scatter(const Hit& hit, const Vec3&, auto&) const {
        if (hit.surface == renderer::mirror)
            return Scattering::reflect(1);
        return hit.surface == renderer::diffuse ? Scattering::deposit() : Scattering::absorb(); // the lamp takes light
    }
};

void add_caustics(const renderer::Room& room, const std::vector<renderer::Seen>& seen, std::vector<float>& film) {
    const nephroid::EyePathMap map(seen, &renderer::Seen::position, &renderer::Seen::normal);
    auto sums = nephroid::sums<float>(map);
    const renderer::Rectangle lamp = room.rectangles[3];
    const nephroid::QuadLight<Vec3, float> light(
        {.corner = {lamp.x0, lamp.y0, lamp.height}, // on the rectangle that stands in the room
         .edge_u = {lamp.x1 - lamp.x0, 0, 0},
         .edge_v = {0, lamp.y1 - lamp.y0, 0},
         .radiance = room.radiance,
         .target = nephroid::BoundingSphere<Vec3>{{0, 0, 4}, 1.2f}}); // of the ceiling, what lights the picture
    nephroid::ThreadExecutor threads;
    for (const std::string& sentence :
         nephroid::diagnose(nephroid::caustics(CausticScene{room}, light, sums, {.count = 100'000}, threads)))
        std::cerr << sentence << '\n';
    sums.for_each([&](std::size_t i, float irradiance) { film[seen[i].pixel] += irradiance; });
}
// adapter ends

int main(int argc, char** argv) {
    const std::string path = argc > 1 ? argv[1] : "lamp_in_room.pfm";
    const renderer::Room room;
    constexpr std::size_t size = 256;
    const auto seen = renderer::trace_camera(room, size);
    std::vector<float> film(size * size), exact(size * size);
    add_caustics(room, seen, film);
    for (const renderer::Seen& point : seen)
        exact[point.pixel] = renderer::exact_irradiance(room, point.position);
    return write_pfm(path, size, 1, film) && write_pfm(path + ".exact.pfm", size, 1, exact) ? 0 : 1;
}
