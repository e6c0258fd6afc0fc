// SPDX-License-Identifier: MIT
/// @file  Openings: the surfaces through which a lamp's light enters a scene, as smooth maps of the unit square.
#pragma once

#include "geometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::examples::web {

/// A rectangle or a disk that lies in a plane z = constant and faces up, or a part of an upright cylinder.
struct Opening {
    enum class Kind { rectangle, disk, outside, inside };

    Kind kind;
    float radius;       ///< of the cylinder or the disk; half the side of the rectangle
    float low, high;    ///< heights of the cylinder; both are that of a plane
    float middle, half; ///< angles of the cylinder about the z axis, radians

    struct Point {
        Vec position, normal; ///< the normal is unit, on the lamp's side
        float area;           ///< per unit of the square
    };
    [[nodiscard]] Point at(float u, float v) const {
        const float x = 2 * u - 1, y = 2 * v - 1;
        if (kind == Kind::rectangle)
            return {{radius * x, radius * y, high}, {0, 0, 1}, 4 * radius * radius};
        if (kind == Kind::disk) { // the square's circles become ellipses that fill the disk, without kinks
            const float a = std::sqrt(1 - 0.5f * y * y), b = std::sqrt(1 - 0.5f * x * x);
            const float jacobian = a * b - x * x * y * y / (4 * a * b);
            return {{radius * x * a, radius * y * b, high}, {0, 0, 1}, 4 * radius * radius * (std::max)(jacobian, 0.f)};
        }
        const float angle = middle + half * x, side = kind == Kind::inside ? -1.f : 1.f;
        const Vec out(std::cos(angle), std::sin(angle), 0);
        return {{radius * out.x, radius * out.y, low + v * (high - low)}, side * out, width() * height()};
    }

    /// The opening's size, world units.
    [[nodiscard]] float width() const { return is_flat() ? 2 * radius : 2 * half * radius; }
    [[nodiscard]] float height() const { return is_flat() ? 2 * radius : high - low; }

private:
    [[nodiscard]] bool is_flat() const { return kind == Kind::rectangle || kind == Kind::disk; }
};

/// The openings of a scene for one place of the lamp.
struct Openings {
    std::array<Opening, 2> list{};
    std::size_t size = 0;

    void add(const Opening& opening) { list[size++] = opening; }
};

/// The part of an upright cylinder's outer side that faces a lamp; none for a lamp above it.
inline void add_outside(Openings& openings, const Vec& lamp, const Tube& tube) {
    const float away = std::sqrt(lamp.x * lamp.x + lamp.y * lamp.y);
    if (away > tube.radius)
        openings.add({Opening::Kind::outside, tube.radius, tube.low, tube.high, std::atan2(lamp.y, lamp.x),
                      std::acos(tube.radius / away)});
}

/// The same of its inner side.
inline void add_inside(Openings& openings, const Vec& lamp, const Tube& tube) {
    const float away = std::sqrt(lamp.x * lamp.x + lamp.y * lamp.y);
    const float hidden = away > tube.radius ? std::acos(tube.radius / away) : 0; // by the side next to the lamp
    openings.add(
        {Opening::Kind::inside, tube.radius, tube.low, tube.high, std::atan2(-lamp.y, -lamp.x), pi<float> - hidden});
}

} // namespace nephroid::examples::web
