// SPDX-License-Identifier: MIT
#include "common/study/judge/scenes.hpp"

#include "nephroid/sequence/hash.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

namespace nephroid::examples::study::judge {

namespace {

using V = Vec3<float>;
using Solid = Material<float>;

class Draw {
public:
    explicit Draw(std::uint64_t seed) : seed_(seed) {}

    [[nodiscard]] double between(double low, double high) {
        return low + (high - low) * double(hash_bits(seed_, number_++) >> 11) * 0x1p-53;
    }
    /// As likely within any factor.
    [[nodiscard]] double of_all_sizes(double low, double high) {
        return std::exp(between(std::log(low), std::log(high)));
    }

private:
    std::uint64_t seed_, number_ = 0;
};

/// What is lit: parts, the sphere about its mirrors and glass, and where the light falls on the floor if nothing but
/// its direction counts.
struct Subject {
    std::vector<Scene<float, float>::Part> parts;
    Solid solid = Solid::mirror(1);
    BoundingSphere<V> target;
    double reach;         ///< of the light on the floor about its middle, world units
    double bending = 1;   ///< sine of the light's angle on its way down over that of its angle from the lamp
    bool is_below = true; ///< whether the light goes on along its direction
};

[[nodiscard]] SineWave<float> wave(Draw& draw, double height, double steepest) {
    const double kx = draw.between(0.5, 3), ky = draw.between(0.5, 3);
    const double amplitude = draw.of_all_sizes(0.1, 1) * steepest / (2 * std::numbers::pi * std::hypot(kx, ky));
    return SineWave<float>({.height = float(height),
                            .amplitude = float(amplitude),
                            .kx = float(kx),
                            .ky = float(ky),
                            .x_min = -1,
                            .x_max = 1,
                            .y_min = -1,
                            .y_max = 1});
}

/// A closed block of triangles: waves above, flat below.
[[nodiscard]] TriangleMesh<float> wavy_block(Draw& draw, bool with_normals) {
    const auto cells = std::uint32_t(draw.between(20, 60));
    const double kx = draw.between(0.5, 2), ky = draw.between(0.5, 2), amplitude = draw.of_all_sizes(0.005, 0.03);
    MeshData<float> mesh;
    const auto corner = [&](std::uint32_t i, std::uint32_t j) { return j * (cells + 1) + i; };
    for (const bool is_top : {true, false})
        for (std::uint32_t j = 0; j <= cells; ++j)
            for (std::uint32_t i = 0; i <= cells; ++i) {
                const double x = 2.0 * i / cells - 1, y = 2.0 * j / cells - 1, u = 2 * std::numbers::pi * kx,
                             v = 2 * std::numbers::pi * ky, angle = u * x + v * y, slope = amplitude * std::cos(angle);
                mesh.positions.push_back(V(x, y, is_top ? 1 + amplitude * std::sin(angle) : 0.8));
                if (with_normals)
                    mesh.normals.push_back(is_top ? V(-u * slope, -v * slope, 1) : V(0, 0, -1));
            }
    const std::uint32_t below = (cells + 1) * (cells + 1);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (std::uint32_t j = 0; j < cells; ++j)
        for (std::uint32_t i = 0; i < cells; ++i) {
            add(corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
            add(below + corner(i, j), below + corner(i, j + 1), below + corner(i + 1, j + 1), below + corner(i + 1, j));
        }
    // The sides have corners of their own, without normals.
    const auto side = [&](std::uint32_t from, std::uint32_t to) {
        const auto first = std::uint32_t(mesh.positions.size());
        for (const std::uint32_t at : {below + from, below + to, to, from}) {
            mesh.positions.push_back(mesh.positions[at]);
            if (with_normals)
                mesh.normals.push_back(V(0));
        }
        add(first, first + 1, first + 2, first + 3);
    };
    for (std::uint32_t i = 0; i < cells; ++i) {
        side(corner(i, 0), corner(i + 1, 0));
        side(corner(cells, i), corner(cells, i + 1));
        side(corner(cells - i, cells), corner(cells - i - 1, cells));
        side(corner(0, cells - i), corner(0, cells - i - 1));
    }
    if (!with_normals)
        mesh.normals.assign(mesh.positions.size(), V(0));
    mesh.materials.assign(mesh.triangles.size(), 1);
    return TriangleMesh<float>(std::move(mesh));
}

/// @param away  from the subject towards the light, unit
[[nodiscard]] Subject subject_of(std::size_t kind, Draw& draw, const V& away) {
    switch (kind) {
    case 0: {
        const double index = 1.33;
        return {{{wave(draw, 1, 0.6), 1}},
                Solid::dielectric(index, draw.between(0, 1) < 0.5, Follow::refraction),
                {V(0, 0, 1), 1.5f},
                1.3,
                1 / index};
    }
    case 1:
        return {{{wave(draw, 1.1, 0.4), 1}, {wave(draw, 0.9, 0.2), 1}},
                Solid::dielectric(draw.between(1.3, 1.7), false, Follow::refraction),
                {V(0, 0, 1), 1.5f},
                1.3};
    case 2:
    case 3: {
        const double radius = draw.between(0.3, 0.8), height = radius + draw.between(0.05, 0.6);
        const V centre(0, 0, float(height));
        const bool is_glass = kind == 2;
        return {{{Sphere<float>(centre, float(radius)), 1}},
                is_glass ? Solid::dielectric(draw.between(1.3, 1.7), draw.between(0, 1) < 0.5, Follow::both)
                         : Solid::mirror(1),
                {centre, float(radius) * 1.0001f},
                is_glass ? 1.3 * radius / double(away.z) : 3,
                1,
                is_glass};
    }
    case 4: {
        const double height = draw.between(0.2, 0.8), across = std::hypot(double(away.x), double(away.y));
        return {{{Cylinder<float>({.radius = 1,
                                   .height = float(height),
                                   .facing_x = float(-double(away.x) / across),
                                   .facing_y = float(-double(away.y) / across),
                                   .least_cosine = 0}),
                  1}},
                Solid::mirror(1),
                {V(0, 0, float(height / 2)), float(std::sqrt(1 + height * height / 4) * 1.0001)},
                1.1,
                1,
                false};
    }
    default:
        return {{{wavy_block(draw, kind == 6), 1}},
                Solid::dielectric(draw.between(1.3, 1.7), true, Follow::both),
                {V(0, 0, 0.9f), 1.5f},
                1.3};
    }
}

} // namespace

BuiltinCase<float, float> scene_of(std::size_t kind, std::size_t lamp, std::uint64_t seed) {
    Draw draw(hash_bits(hash_bits(seed, kind), lamp));
    const double elevation = draw.between(0.6, 1.3), azimuth = draw.between(0, 2 * std::numbers::pi);
    const V away(float(std::cos(elevation) * std::cos(azimuth)), float(std::cos(elevation) * std::sin(azimuth)),
                 float(std::sin(elevation)));
    Subject subject = subject_of(kind, draw, away);
    const double distance = draw.between(2.5, 5), radius = draw.of_all_sizes(0.03, 0.5);
    const V from = subject.target.centre + float(distance) * away;
    std::vector<CaseLight<float, float>::AnyLight> light;
    if (lamp == 0)
        light.push_back(DirectionalLight<V, float>({.direction = -away, .irradiance = 1, .patch = subject.target}));
    else if (lamp == 1)
        light.push_back(PointLight<V, float>(
            {.position = from, .intensity = float(distance * distance), .target = subject.target}));
    else
        light.push_back(
            DiskLight<V, float>({.centre = from,
                                 .normal = -away,
                                 .radius = float(radius),
                                 .radiance = float(distance * distance / (std::numbers::pi * radius * radius)),
                                 .target = subject.target}));
    // Where the middle ray meets the floor.
    const double sine = std::cos(elevation) * subject.bending, fall = sine / std::sqrt(1 - sine * sine);
    const double drop = subject.is_below ? double(subject.target.centre.z) * fall : 0;
    const double x = -drop * std::cos(azimuth), y = -drop * std::sin(azimuth), reach = subject.reach;
    subject.parts.insert(subject.parts.begin(), {Floor<float>(0), 0});
    return {Scene<float, float>(std::move(subject.parts), {Solid::diffuse(1), std::move(subject.solid)}),
            CaseLight<float, float>(std::move(light)),
            {x - reach, x + reach, y - reach, y + reach}};
}

} // namespace nephroid::examples::study::judge
