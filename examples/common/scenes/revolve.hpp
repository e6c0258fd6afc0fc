// SPDX-License-Identifier: MIT
/// @file  Bodies of revolution, y up: a profile in radius and height, turned about the y axis.
#pragma once

#include "common/shapes/mesh_data.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

namespace nephroid::examples {

/// A point of a profile, with the outward normal there; both in radius and height.
struct ProfilePoint {
    double radius, height;
    double normal_radius, normal_height;
};

/// Adds the surface of a closed profile, whose points run so that the body is on their left.
///
/// @param steps  around the axis, at least 3
template <class T>
void add_revolved(MeshData<T>& mesh, const std::vector<ProfilePoint>& profile, std::size_t steps,
                  std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto count = static_cast<std::uint32_t>(profile.size()), turns = static_cast<std::uint32_t>(steps);
    mesh.normals.resize(mesh.positions.size(), Vec3<T>(0));
    for (std::uint32_t turn = 0; turn < turns; ++turn) {
        const double angle = 2 * std::numbers::pi * turn / turns, c = std::cos(angle), s = std::sin(angle);
        for (const ProfilePoint& p : profile) {
            mesh.positions.push_back({T(p.radius * c), T(p.height), T(p.radius * s)});
            mesh.normals.push_back({T(p.normal_radius * c), T(p.normal_height), T(p.normal_radius * s)});
        }
    }
    const auto at = [&](std::uint32_t turn, std::uint32_t i) { return first + turn % turns * count + i % count; };
    for (std::uint32_t turn = 0; turn < turns; ++turn)
        for (std::uint32_t i = 0; i < count; ++i) {
            mesh.triangles.push_back({at(turn, i), at(turn, i + 1), at(turn + 1, i + 1)});
            mesh.triangles.push_back({at(turn, i), at(turn + 1, i + 1), at(turn + 1, i)});
            mesh.materials.insert(mesh.materials.end(), 2, material);
        }
}

/// A circle about this radius and height 0, counter-clockwise with the radius to the right.
[[nodiscard]] inline std::vector<ProfilePoint> circle(double radius, double of_circle, std::size_t steps) {
    std::vector<ProfilePoint> profile;
    for (std::size_t i = 0; i < steps; ++i) {
        const double angle = 2 * std::numbers::pi * double(i) / double(steps), c = std::cos(angle), s = std::sin(angle);
        profile.push_back({radius + of_circle * c, of_circle * s, c, s});
    }
    return profile;
}

/// A rectangle in radius and height with round corners, counter-clockwise with the radius to the right.
///
/// @param corner  radius of the corners
/// @param steps   along each corner
[[nodiscard]] inline std::vector<ProfilePoint> rounded_rectangle(double inner, double outer, double low, double high,
                                                                 double corner, std::size_t steps) {
    std::vector<ProfilePoint> profile;
    const double r[] = {outer - corner, outer - corner, inner + corner, inner + corner};
    const double h[] = {low + corner, high - corner, high - corner, low + corner};
    for (std::size_t quarter = 0; quarter < 4; ++quarter)
        for (std::size_t i = 0; i <= steps; ++i) {
            const double angle =
                0.5 * std::numbers::pi * (double(quarter) - 1 + double(i) / double(steps)); // from below outwards
            const double c = std::cos(angle), s = std::sin(angle);
            profile.push_back({r[quarter] + corner * c, h[quarter] + corner * s, c, s});
        }
    return profile;
}

} // namespace nephroid::examples
