// SPDX-License-Identifier: MIT
/// @file  Closed scenes whose indirect light is known: rooms of rectangles, and a sphere.
#pragma once

#include "nephroid/emission/light/quad.hpp"
#include "nephroid/emission/light_set.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/transport/scene.hpp"
#include "nephroid/vector/glm.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace nephroid::tests {

template <class T>
struct RoomVertex {
    glm::vec<3, T> position, normal;
};

/// A rectangle, seen from the side of u × v.
template <class T, class F>
struct Wall {
    glm::vec<3, T> corner, u, v;
    F albedo;
    Event event = Event::diffuse;

    [[nodiscard]] glm::vec<3, T> normal() const { return normalize(cross(u, v)); }
    [[nodiscard]] T area() const { return length(cross(u, v)); }
};

/// A room of rectangles.
template <class T, class F = T>
struct Room {
    using V = glm::vec<3, T>;
    using Hit = SurfaceHit<V, Flat>;
    std::vector<Wall<T, F>> walls;

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, T t_min, T t_max) const {
        std::optional<Hit> nearest;
        for (std::size_t i = 0; i < walls.size(); ++i) {
            const Wall<T, F>& wall = walls[i];
            const V n = cross(wall.u, wall.v);
            const T t = dot(n, V(wall.corner - o)) / dot(n, d);
            if (!(t > t_min && t < t_max))
                continue;
            const V p = o + t * d, r = p - wall.corner;
            const T a = dot(r, wall.u), b = dot(r, wall.v), rounding = T(1e-6); // walls meet without gaps
            if (a < -rounding || a > dot(wall.u, wall.u) + rounding || b < -rounding ||
                b > dot(wall.v, wall.v) + rounding)
                continue;
            t_max = t;
            const V unit = normalize(n);
            nearest = Hit{t, p, unit, unit, Flat{}, rounding_error(o, t, p), i};
        }
        return nearest;
    }
    template <class Sampler>
    [[nodiscard]] Scattering<F, T> scatter(const Hit& hit, const V&, Sampler&) const {
        return {walls[hit.surface].event, walls[hit.surface].albedo, T(1)};
    }

    /// The middles of n by n cells of some walls.
    [[nodiscard]] std::vector<RoomVertex<T>> vertices(int n, const std::vector<std::size_t>& of) const {
        std::vector<RoomVertex<T>> all;
        for (const std::size_t i : of)
            for (int k = 0; k < n * n; ++k)
                all.push_back({walls[i].corner + (T(k % n) + T(0.5)) / T(n) * walls[i].u +
                                   (T(k / n) + T(0.5)) / T(n) * walls[i].v,
                               walls[i].normal()});
        return all;
    }

    /// Lambertian light from some walls.
    [[nodiscard]] LightSet<QuadLight<V, F>> glow(const F& emission, const std::vector<std::size_t>& from) const {
        std::vector<std::variant<QuadLight<V, F>>> lights;
        for (const std::size_t i : from)
            lights.push_back(QuadLight<V, F>({walls[i].corner, walls[i].u, walls[i].v, emission * F(1 / pi<T>)}));
        return LightSet<QuadLight<V, F>>(std::move(lights));
    }
};

/// The six sides of the box [0, size], seen from inside: x = 0, x = size, floor, ceiling, z = 0, z = size.
template <class T, class F>
[[nodiscard]] std::vector<Wall<T, F>> box_walls(const F& albedo, const glm::vec<3, T>& size = {1, 1, 1}) {
    using V = glm::vec<3, T>;
    const V x{size.x, 0, 0}, y{0, size.y, 0}, z{0, 0, size.z}, o{0, 0, 0};
    return {{o, y, z, albedo}, {x, z, y, albedo}, {o, z, x, albedo},
            {y, x, z, albedo}, {o, x, y, albedo}, {z, y, x, albedo}};
}

/// The unit cube in which all walls glow and reflect alike: irradiance 0.5 of indirect light everywhere, for an
/// emission and an albedo of a half.
template <class T>
[[nodiscard]] Room<T> furnace() {
    return {box_walls<T, T>(T(0.5))};
}

/// The same with a block [0.3, 0.6] x [0, 0.4] x [0.3, 0.6] on its floor: sides first, its top last.
template <class T>
[[nodiscard]] Room<T> furnace_with_block() {
    using V = glm::vec<3, T>;
    Room<T> room = furnace<T>();
    const V low{T(0.3), 0, T(0.3)}, x{T(0.3), 0, 0}, y{0, T(0.4), 0}, z{0, 0, T(0.3)};
    for (const Wall<T, T>& wall :
         {Wall<T, T>{low, z, y, T(0.5)}, Wall<T, T>{low + x, y, z, T(0.5)}, Wall<T, T>{low, y, x, T(0.5)},
          Wall<T, T>{low + z, x, y, T(0.5)}, Wall<T, T>{low + y, z, x, T(0.5)}})
        room.walls.push_back(wall);
    // What glows under the block lights nothing: the floor there is left out, in four parts around it.
    const V o{0, 0, 0};
    room.walls[2] = {o, V(0, 0, 1), V(T(0.3), 0, 0), T(0.5)};
    room.walls.push_back({V(T(0.6), 0, 0), V(0, 0, 1), V(T(0.4), 0, 0), T(0.5)});
    room.walls.push_back({V(T(0.3), 0, 0), V(0, 0, T(0.3)), x, T(0.5)});
    room.walls.push_back({V(T(0.3), 0, T(0.6)), V(0, 0, T(0.4)), x, T(0.5)});
    return room;
}

/// A sphere seen from inside, with a point lamp anywhere in it.
template <class T>
struct SphereRoom {
    using V = glm::vec<3, T>;
    using Hit = SurfaceHit<V, Flat>;
    T radius = 1, albedo = T(0.8);

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, T t_min, T t_max) const {
        const T b = dot(o, d), c = dot(o, o) - radius * radius, discriminant = b * b - c;
        if (!(discriminant > T(0)))
            return std::nullopt;
        for (const T t : {-b - std::sqrt(discriminant), -b + std::sqrt(discriminant)})
            if (t > t_min && t < t_max) {
                const V p = o + t * d, n = normalize(p);
                return Hit{t, radius * n, -n, -n, Flat{}, rounding_error(o, t, p), 0};
            }
        return std::nullopt;
    }
    template <class Sampler>
    [[nodiscard]] Scattering<T, T> scatter(const Hit&, const V&, Sampler&) const {
        return Scattering<T, T>::diffuse(albedo);
    }

    /// Places spread evenly over the sphere.
    [[nodiscard]] std::vector<RoomVertex<T>> vertices(int count) const {
        std::vector<RoomVertex<T>> all;
        for (int i = 0; i < count; ++i) {
            const double z = 1 - (2 * i + 1) / double(count), r = std::sqrt(1 - z * z), a = 2.39996322972865332 * i;
            const V n(T(r * std::cos(a)), T(r * std::sin(a)), T(z));
            all.push_back({radius * n, -n});
        }
        return all;
    }
};

/// The map of a room's vertices.
template <class T>
[[nodiscard]] EyePathMap<glm::vec<3, T>> map_of(const std::vector<RoomVertex<T>>& vertices) {
    return EyePathMap(vertices, &RoomVertex<T>::position, &RoomVertex<T>::normal);
}

} // namespace nephroid::tests
