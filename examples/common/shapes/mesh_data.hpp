// SPDX-License-Identifier: MIT
/// @file  The data of a triangle mesh, and their validation.
#pragma once

#include "common/ray.hpp"

#include "nephroid/vector/error.hpp"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::examples {

template <class T>
struct MeshData {
    std::vector<Vec3<T>> positions;
    std::vector<Vec3<T>> normals; ///< one for each position, of any length; zero, or no normals at all: flat
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise seen from where the normal points
    std::vector<std::uint32_t> materials;                ///< one for each triangle; empty: all are material 0

    // What textures need, each one for each position, or empty if no material has a texture.
    std::array<std::vector<glm::vec2>, 2> coordinates; ///< two sets of texture coordinates
    std::vector<glm::vec4> tangents; ///< of normal maps: x, y, z the first axis, w the sign of the second; zero: no map

    [[nodiscard]] std::array<Vec3<T>, 3> corners(std::size_t triangle) const {
        const auto& t = triangles[triangle];
        return {positions[t[0]], positions[t[1]], positions[t[2]]};
    }
};

/// Throws std::invalid_argument for an index out of range, a vertex that is not finite, and counts that differ.
template <class T>
void validate(const MeshData<T>& data) {
    const auto complain = [](const std::string& what) { invalid_argument("TriangleMesh: " + what); };
    for (std::size_t i = 0; i < data.positions.size(); ++i)
        if (!all_finite(T(16) * data.positions[i]))
            complain("vertex " + std::to_string(i) + " is not finite");
    for (const auto& triangle : data.triangles)
        for (const std::uint32_t index : triangle)
            if (index >= data.positions.size())
                complain("a triangle's index " + std::to_string(index) + " is out of range");
    if (!data.normals.empty() && data.normals.size() != data.positions.size())
        complain("there must be as many normals as positions, or none");
    for (std::size_t i = 0; i < data.normals.size(); ++i)
        if (!all_finite(data.normals[i]))
            complain("normal " + std::to_string(i) + " is not finite");
    for (const auto& set : data.coordinates)
        if (!set.empty() && set.size() != data.positions.size())
            complain("there must be as many texture coordinates as positions, or none");
    if (!data.tangents.empty() && data.tangents.size() != data.positions.size())
        complain("there must be as many tangents as positions, or none");
    if (!data.materials.empty() && data.materials.size() != data.triangles.size())
        complain("there must be as many materials as triangles, or none");
}

} // namespace nephroid::examples
