// SPDX-License-Identifier: MIT
#include "common/gltf/transform.hpp"

#include "common/gltf/report.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace nephroid::examples::gltf {
namespace {

bool fits_float(double value) { return std::abs(value) <= double{std::numeric_limits<float>::max()}; }

/// Whether a property is present. Fails if it is but has not `count` entries that are finite in float.
bool has(const std::vector<double>& entries, std::size_t count, std::string_view node, std::string_view property) {
    if (entries.empty())
        return false;
    if (entries.size() != count)
        fail({node, " has a ", property, " of ", std::to_string(entries.size()), " numbers; ", std::to_string(count),
              " are needed"});
    for (const double entry : entries)
        static_cast<void>(to_float(entry, node, property));
    return true;
}

glm::dmat4 from_matrix(const std::vector<double>& m, std::string_view name) {
    glm::dmat4 result;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            result[column][row] = m[static_cast<std::size_t>(4 * column + row)];

    const glm::dvec4 bottom(result[0].w, result[1].w, result[2].w, result[3].w - 1);
    constexpr double tolerance = 1e-4; // for matrices that were multiplied in float
    if (glm::dot(bottom, bottom) > tolerance * tolerance)
        fail({name, " has a matrix whose last row is not 0 0 0 1"});
    result[0].w = result[1].w = result[2].w = 0;
    result[3].w = 1;
    return result;
}

glm::dmat3 from_rotation(const std::vector<double>& xyzw, std::string_view name) {
    const glm::dvec4 q(xyzw[0], xyzw[1], xyzw[2], xyzw[3]);
    const double length = std::sqrt(glm::dot(q, q));
    if (!(length > 0))
        fail({name, " has a rotation of length zero"});
    return glm::mat3_cast(glm::dquat(q.w / length, q.x / length, q.y / length, q.z / length));
}
} // namespace

glm::dmat4 local_transform(const tinygltf::Node& node, std::string_view name) {
    if (has(node.matrix, 16, name, "matrix"))
        return from_matrix(node.matrix, name);

    glm::dmat3 linear(1);
    if (has(node.rotation, 4, name, "rotation"))
        linear = from_rotation(node.rotation, name);
    if (has(node.scale, 3, name, "scale"))
        for (int column = 0; column < 3; ++column)
            linear[column] *= node.scale[static_cast<std::size_t>(column)];
    glm::dmat4 result(linear);
    if (has(node.translation, 3, name, "translation"))
        result[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
    return result;
}

NormalTransform normal_transform(const glm::dmat4& to_world) {
    const glm::dvec3 x(to_world[0]), y(to_world[1]), z(to_world[2]);
    const glm::dmat3 cofactors(glm::cross(y, z), glm::cross(z, x), glm::cross(x, y)); // determinant times the inverse
    const bool mirrored = glm::dot(x, cofactors[0]) < 0;
    return {mirrored ? -cofactors : cofactors, mirrored};
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_finite_in_float(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!fits_float(m[column][row]))
                return false;
    return true;
}

float to_float(double value, std::string_view owner, std::string_view property) {
    if (!fits_float(value))
        fail({owner, " has a ", property, " of ", std::to_string(value), ", which is not finite in float"});
    return static_cast<float>(value);
}

} // namespace nephroid::examples::gltf
