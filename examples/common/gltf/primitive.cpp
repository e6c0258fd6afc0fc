// SPDX-License-Identifier: MIT
#include "common/gltf/primitive.hpp"

#include "common/gltf/accessor.hpp"
#include "common/gltf/texture_coordinates.hpp"
#include "common/gltf/transform.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples::gltf {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Triangles from the order of a primitive's vertices. Source: glTF 2.0, section 3.7.2.1, topology types.
std::vector<Triangle> assemble(const std::vector<std::uint32_t>& corners, int mode, std::string_view owner) {
    const std::size_t n = corners.size();
    if (n < 3 || (mode == TINYGLTF_MODE_TRIANGLES && n % 3 != 0))
        fail({owner, " has ", std::to_string(n), " indices or vertices, which make no ",
              n < 3 ? "triangle" : "whole number of triangles"});

    std::vector<Triangle> triangles;
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(n / 3);
        for (std::size_t i = 0; i < n; i += 3)
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        return triangles;
    }
    triangles.reserve(n - 2);
    for (std::size_t i = 0; i + 2 < n; ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN)
            triangles.push_back({corners[0], corners[i + 1], corners[i + 2]});
        else if (i % 2 == 0)
            triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
        else
            triangles.push_back({corners[i], corners[i + 2], corners[i + 1]});
    }
    return triangles;
}

/// The corners in the file's order: its indices, or else the vertices one after the other.
std::vector<std::uint32_t> read_corners(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                        std::size_t vertices, std::string_view owner, Budget& budget) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices == -1) {
        corners.resize(vertices);
        for (std::size_t i = 0; i < vertices; ++i)
            corners[i] = static_cast<std::uint32_t>(i);
    } else {
        const AccessorView view = view_indices(model, primitive.indices, owner);
        budget.charge(view.count, sizeof(std::uint32_t));
        corners = read_indices(model, view);
    }
    for (std::size_t i = 0; i < corners.size(); ++i)
        if (corners[i] >= vertices)
            fail({owner, " has the index ", std::to_string(corners[i]), " at place ", std::to_string(i), ", but only ",
                  std::to_string(vertices), " vertices"});
    return corners;
}

std::vector<glm::vec3> read_positions(const tinygltf::Model& model, const AccessorView& view,
                                      const glm::dmat4& to_world, std::string_view owner) {
    std::vector<glm::vec3> positions = read_vectors(model, view);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        glm::vec3& position = positions[i];
        if (!is_finite(glm::dvec3(position)))
            fail({owner, " has a position that is not finite at vertex ", std::to_string(i)});
        const glm::dvec3 world(to_world * glm::dvec4(glm::dvec3(position), 1));
        constexpr double most = std::numeric_limits<float>::max();
        if (!(std::abs(world.x) <= most && std::abs(world.y) <= most && std::abs(world.z) <= most))
            fail({owner, " has a position that is too large at vertex ", std::to_string(i)});
        position = glm::vec3(world);
    }
    return positions;
}

/// Twice the area, along the face's normal.
template <class Scalar>
glm::vec<3, Scalar> face_of(const std::vector<glm::vec3>& positions, const Triangle& t) {
    using V = glm::vec<3, Scalar>;
    const V a(positions[t[0]]), b(positions[t[1]]), c(positions[t[2]]);
    return glm::cross(b - a, c - a);
}

/// Whether the triangle's normal vanishes in float or in double.
bool has_no_area(const std::vector<glm::vec3>& positions, const Triangle& t) {
    return face_of<float>(positions, t) == glm::vec3(0) || face_of<double>(positions, t) == glm::dvec3(0);
}

/// Replaces normals of zero by the mean normal of the faces around, weighted by area.
void repair(std::vector<glm::vec3>& normals, const MeshDescription& mesh) {
    std::vector<glm::dvec3> sums(normals.size(), glm::dvec3(0));
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t corner : t)
            if (normals[corner] == glm::vec3(0))
                sums[corner] += face_of<double>(mesh.positions, t);
    for (const Triangle& t : mesh.triangles)
        for (const std::uint32_t corner : t)
            if (normals[corner] == glm::vec3(0) && sums[corner] == glm::dvec3(0)) // the faces cancel: take one of them
                sums[corner] = face_of<double>(mesh.positions, t);
    for (std::size_t i = 0; i < normals.size(); ++i)
        if (normals[i] == glm::vec3(0))
            normals[i] = sums[i] == glm::dvec3(0) ? glm::vec3(0, 0, 1) : glm::vec3(glm::normalize(sums[i]));
}

std::vector<glm::vec3> read_normals(const tinygltf::Model& model, const AccessorView& view,
                                    const NormalTransform& transform, const MeshDescription& mesh,
                                    std::string_view owner, Warnings& warnings) {
    std::vector<glm::vec3> normals = read_vectors(model, view);
    std::size_t missing = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        if (!is_finite(glm::dvec3(normals[i])))
            fail({owner, " has a normal that is not finite at vertex ", std::to_string(i)});
        glm::dvec3 world(0);
        if (normals[i] != glm::vec3(0))
            world = transform.matrix * glm::normalize(glm::dvec3(normals[i]));
        const double length = glm::length(world);
        normals[i] = length > 0 ? glm::vec3(world / length) : glm::vec3(0);
        missing += length > 0 ? 0 : 1;
    }
    if (missing > 0) {
        warnings.add(std::string(owner) + " has " + std::to_string(missing) +
                     " normals of length zero, which are replaced by those of the triangles around");
        repair(normals, mesh);
    }
    return normals;
}
} // namespace

std::optional<MeshDescription> read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                                              const glm::dmat4& to_world, std::string_view owner,
                                              const MaterialDescription& material, Budget& budget, Warnings& warnings) {
    if (primitive.mode < TINYGLTF_MODE_POINTS || primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN)
        fail({owner, " is of the mode ", std::to_string(primitive.mode), "; glTF has 0 to 6"});
    if (primitive.mode < TINYGLTF_MODE_TRIANGLES) {
        warnings.add(std::string(owner) + " has points or lines, which are left out");
        return std::nullopt;
    }
    if (!primitive.targets.empty())
        warnings.add(std::string(owner) + " has morph targets, which are not read");

    const auto attribute = [&](const char* name) {
        const auto found = primitive.attributes.find(name);
        return found == primitive.attributes.end() ? -1 : found->second;
    };
    const int position = attribute("POSITION");
    if (position == -1)
        fail({owner, " has no positions"});
    const AccessorView view = view_vectors(model, position, owner);
    if (view.count >= std::numeric_limits<std::uint32_t>::max())
        fail({owner, " has ", std::to_string(view.count), " vertices; fewer than 2^32 can be read"});
    budget.charge(view.count, 2 * sizeof(glm::vec3) + 2 * sizeof(Triangle));

    MeshDescription mesh;
    mesh.positions = read_positions(model, view, to_world, owner);
    const std::vector<std::uint32_t> corners = read_corners(model, primitive, view.count, owner, budget);
    budget.charge(corners.size(), sizeof(Triangle));
    mesh.triangles = assemble(corners, primitive.mode, owner);

    const NormalTransform transform = normal_transform(to_world);
    if (transform.mirrored)
        for (Triangle& t : mesh.triangles)
            std::swap(t[1], t[2]);
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return has_no_area(mesh.positions, t); });
    if (mesh.triangles.empty()) {
        warnings.add(std::string(owner) + " has no triangle with an area; it is left out");
        return std::nullopt;
    }

    if (const int normal = attribute("NORMAL"); normal != -1) {
        const AccessorView normals = view_vectors(model, normal, owner);
        if (normals.count != view.count)
            fail({owner, " has ", std::to_string(view.count), " positions, but ", std::to_string(normals.count),
                  " normals"});
        mesh.normals = read_normals(model, normals, transform, mesh, owner, warnings);
    }
    if (attribute("COLOR_0") != -1)
        warnings.add(std::string(owner) + " has vertex colours (COLOR_0), which are not read");
    read_texture_coordinates(mesh, model, primitive, material, to_world, owner, budget, warnings);
    return mesh;
}

} // namespace nephroid::examples::gltf
