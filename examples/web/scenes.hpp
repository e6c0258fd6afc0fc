// SPDX-License-Identifier: MIT
/// @file  The three scenes of the browser: a mirror ring, a tumbler of water, a wavy pool. The page's shader draws the
///        same shapes (page/shader.js).
#pragma once

#include "openings.hpp"
#include "waves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>

namespace nephroid::examples::web {

/// A polished ring that lies on the floor: a mirror on its inner and outer sides.
struct Ring {
    static constexpr float inner = 0.72f, outer = 0.8f, height = 0.34f, reflectance = 0.9f, half_map = 1.25f;
    static constexpr std::array<Tube, 2> sides = {Tube{inner, 0, height}, Tube{outer, 0, height}};

    [[nodiscard]] Openings openings(const Vec& lamp) const {
        Openings found;
        add_inside(found, lamp, sides[0]);
        add_outside(found, lamp, sides[1]);
        return found;
    }

    [[nodiscard]] std::optional<Hit> intersect(Ray ray) const {
        std::size_t nearest = 3;
        const auto take = [&](std::optional<float> t, std::size_t surface) {
            if (t)
                ray.t_max = *t, nearest = surface;
        };
        take(to_plane(ray, 0), the_floor);
        take(sides[0].nearest(ray), 1);
        take(sides[1].nearest(ray), 2);
        if (const auto t = to_plane(ray, height)) {
            const Vec p = ray.at(*t);
            if (const float r2 = p.x * p.x + p.y * p.y; r2 > inner * inner && r2 < outer * outer)
                return plane_hit(ray, *t, height, 1, 3);
        }
        if (nearest == 3)
            return std::nullopt;
        return nearest == the_floor ? plane_hit(ray, ray.t_max, 0, 1, the_floor)
                                    : sides[nearest - 1].hit(ray, ray.t_max, nearest);
    }

    [[nodiscard]] Scattered scatter(const Hit&, const Vec&) const { return Scattered::reflect(reflectance); }
    [[nodiscard]] Media media(std::size_t) const { return {1, 1}; }
};

/// A tumbler of water on the floor: glass with a thick base, open at the top.
struct Tumbler {
    static constexpr float outer = 0.42f, inner = 0.385f, top = 0.96f, under = 0.004f, base = 0.09f, water = 0.62f;
    static constexpr float glass = 1.5f, wet = 1.333f, half_map = 1.8f;
    static constexpr std::array<Tube, 3> tubes = {Tube{outer, under, top}, Tube{inner, base, water},
                                                  Tube{inner, water, top}};
    struct Disk {
        float height, up, from, to;
    };
    static constexpr std::array<Disk, 4> disks = {Disk{top, 1, inner, outer}, Disk{under, -1, 0, outer},
                                                  Disk{base, 1, 0, inner}, Disk{water, 1, 0, inner}};
    static constexpr std::array<Media, 8> sides = {
        {{1, 1}, {1, glass}, {glass, wet}, {glass, 1}, {1, glass}, {1, glass}, {wet, glass}, {1, wet}}};

    [[nodiscard]] Openings openings(const Vec& lamp) const {
        Openings found;
        found.add({Opening::Kind::disk, outer, top, top, 0, 0});
        add_outside(found, lamp, tubes[0]);
        return found;
    }

    [[nodiscard]] std::optional<Hit> intersect(Ray ray) const {
        constexpr std::size_t nothing = 8;
        std::size_t nearest = nothing;
        for (std::size_t i = 0; i < tubes.size(); ++i)
            if (const auto t = tubes[i].nearest(ray))
                ray.t_max = *t, nearest = 1 + i;
        for (std::size_t i = 0; i < disks.size(); ++i)
            if (const auto t = to_plane(ray, disks[i].height)) {
                const Vec p = ray.at(*t);
                const float r2 = p.x * p.x + p.y * p.y;
                if (r2 >= disks[i].from * disks[i].from && r2 < disks[i].to * disks[i].to)
                    ray.t_max = *t, nearest = 4 + i;
            }
        if (const auto t = to_plane(ray, 0))
            return plane_hit(ray, *t, 0, 1, the_floor);
        if (nearest == nothing)
            return std::nullopt;
        if (nearest <= tubes.size())
            return tubes[nearest - 1].hit(ray, ray.t_max, nearest);
        const Disk& disk = disks[nearest - 4];
        return plane_hit(ray, ray.t_max, disk.height, disk.up, nearest);
    }

    [[nodiscard]] Scattered scatter(const Hit& hit, const Vec& direction) const {
        return pass_through(hit, direction, media(hit.surface));
    }
    [[nodiscard]] Media media(std::size_t surface) const { return sides[surface]; }
};

/// A basin of water with waves. Light that meets its walls is lost to the floor; here it goes on to the floor beyond,
/// where nobody looks, so that its sheets do not end at the walls.
struct Pool {
    static constexpr float half_map = 1, depth = 0.8f, wet = 1.333f;
    Waves waves;

    [[nodiscard]] Openings openings(const Vec&) const {
        Openings found;
        found.add({Opening::Kind::rectangle, half_map, depth, depth, 0, 0});
        return found;
    }

    [[nodiscard]] std::optional<Hit> intersect(Ray ray) const {
        if (const auto t = waves.nearest(ray, depth))
            return waves.hit(ray, *t, depth, 1);
        const auto t = to_plane(ray, 0);
        return t ? std::optional(plane_hit(ray, *t, 0, 1, the_floor)) : std::nullopt;
    }

    [[nodiscard]] Scattered scatter(const Hit& hit, const Vec& direction) const {
        return pass_through(hit, direction, media(1));
    }
    [[nodiscard]] Media media(std::size_t) const { return {1, wet}; }
};

/// Any of the three, as the library sees it.
struct Scene {
    static constexpr bool scatters_by_chance = false;
    std::variant<Ring, Tumbler, Pool> shape;

    [[nodiscard]] std::optional<Hit> intersect(const Vec& origin, const Vec& direction, float t_min,
                                               float t_max) const {
        return std::visit([&](const auto& one) { return one.intersect({origin, direction, t_min, t_max}); }, shape);
    }
    [[nodiscard]] Scattered scatter(const Hit& hit, const Vec& direction, auto&) const {
        if (hit.surface == the_floor)
            return Scattered::deposit();
        return std::visit([&](const auto& one) { return one.scatter(hit, direction); }, shape);
    }
    [[nodiscard]] Media media(std::size_t surface) const {
        return std::visit([&](const auto& one) { return one.media(surface); }, shape);
    }
    [[nodiscard]] Openings openings(const Vec& lamp) const {
        return std::visit([&](const auto& one) { return one.openings(lamp); }, shape);
    }
    [[nodiscard]] float half_map() const {
        return std::visit([](const auto& one) { return one.half_map; }, shape);
    }
};

} // namespace nephroid::examples::web
