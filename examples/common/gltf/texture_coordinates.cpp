// SPDX-License-Identifier: MIT
#include "common/gltf/texture_coordinates.hpp"

#include "common/gltf/accessor.hpp"
#include "common/gltf/transform.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::examples::gltf {
namespace {

/// Fails unless there is one element for each vertex.
void check_count(const AccessorView& view, const MeshDescription& mesh, std::string_view owner,
                 std::string_view attribute) {
    if (view.count != mesh.positions.size())
        fail({owner, " has ", std::to_string(mesh.positions.size()), " positions, but ", std::to_string(view.count),
              " of ", attribute});
}

void read_tangents(MeshDescription& mesh, const tinygltf::Model& model, int accessor, const glm::dmat4& to_world,
                   std::string_view owner, Budget& budget) {
    const AccessorView view = view_vectors(model, accessor, owner, 4);
    check_count(view, mesh, owner, "TANGENT");
    budget.charge(view.count, 2 * sizeof(glm::vec4));
    mesh.tangents = read_quadruples(model, view);
    // A mirroring transform turns the cross product around, but not what it stands for.
    const bool mirrored = normal_transform(to_world).mirrored;
    for (glm::vec4& tangent : mesh.tangents) {
        const glm::dvec3 along = glm::dmat3(to_world) * glm::dvec3(tangent);
        const double length = glm::length(along);
        const bool is_known = std::isfinite(length) && length > 0 && tangent.w != 0;
        tangent = is_known ? glm::vec4(along / length, (tangent.w < 0) == mirrored ? 1 : -1) : glm::vec4(0);
    }
}

/// Directions of length 1 summed up at a vertex.
struct DirectionSum {
    glm::dvec3 sum{0};
    std::size_t count = 0;
};

/// The mean direction in which the first coordinate grows, over the triangles around each vertex. A vertex between
/// triangles with the image and triangles with its mirror image becomes two, because their directions may cancel.
void compute_tangents(MeshDescription& mesh, const TextureReference& map, Budget& budget) {
    using Sums = std::array<DirectionSum, 2>; // of the positive sign, and of the negative one
    constexpr std::size_t most_bytes =
        sizeof(Sums) + sizeof(std::uint32_t) + 2 * (2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4));
    budget.charge(mesh.positions.size(), most_bytes);
    budget.charge(mesh.triangles.size(), 3 * sizeof(signed char));
    const std::size_t count = mesh.positions.size();
    std::vector<Sums> sums(count);
    std::vector<std::array<signed char, 3>> signs(mesh.triangles.size()); // of the corners; 0: no direction
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = mesh.triangles[i];
        const auto& coordinates = mesh.coordinates[map.set];
        const glm::dvec3 p(mesh.positions[a]), e1 = glm::dvec3(mesh.positions[b]) - p,
                                               e2 = glm::dvec3(mesh.positions[c]) - p;
        const auto change = [&](std::uint32_t from, std::uint32_t to) {
            return map.transformed_change(glm::dvec2(coordinates[to]) - glm::dvec2(coordinates[from]));
        };
        const glm::dvec2 d1 = change(a, b), d2 = change(a, c);
        const double area = d1.x * d2.y - d1.y * d2.x, sign = area < 0 ? -1 : 1;
        const glm::dvec3 along = sign * (d2.y * e1 - d1.y * e2), face = glm::cross(e1, e2);
        const double length = glm::length(along);
        if (area == 0 || !(length > 0))
            continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t corner = mesh.triangles[i][k];
            // The image's second coordinate grows downwards. The sign belongs to the normal of the vertex.
            const bool faces_back = !mesh.normals.empty() && glm::dot(glm::dvec3(mesh.normals[corner]), face) < 0;
            const bool is_negative = (area > 0) != faces_back;
            signs[i][k] = is_negative ? -1 : 1;
            sums[corner][is_negative].sum += along / length;
            ++sums[corner][is_negative].count;
        }
    }

    mesh.tangents.assign(count, glm::vec4(0));
    const auto tangent = [&](std::size_t vertex, const DirectionSum& direction, float sign) {
        glm::dvec3 along = direction.sum;
        if (!mesh.normals.empty())
            along -= glm::dot(along, glm::dvec3(mesh.normals[vertex])) * glm::dvec3(mesh.normals[vertex]);
        const double length = glm::length(along); // floats of length 1 that cancel leave their rounding
        return length > 1e-6 * double(direction.count) ? glm::vec4(along / length, sign) : glm::vec4(0);
    };
    std::vector<std::uint32_t> negative(count); // the vertex for the triangles with the negative sign
    for (std::size_t i = 0; i < count; ++i) {
        negative[i] = static_cast<std::uint32_t>(i);
        const auto& [plus, minus] = sums[i];
        mesh.tangents[i] = plus.count > 0 ? tangent(i, plus, 1) : tangent(i, minus, -1);
        if (plus.count == 0 || minus.count == 0)
            continue;
        negative[i] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.tangents.push_back(tangent(i, minus, -1));
        const auto repeat = [i](auto& of_vertices) {
            if (!of_vertices.empty()) {
                const auto value = of_vertices[i];
                of_vertices.push_back(value);
            }
        };
        repeat(mesh.positions);
        repeat(mesh.normals);
        for (auto& set : mesh.coordinates)
            repeat(set);
    }
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            if (signs[i][k] < 0)
                mesh.triangles[i][k] = negative[mesh.triangles[i][k]];
}

/// Says how many vertices of triangles have no tangent, because these triangles do without the map.
void warn_of_unknown_tangents(const MeshDescription& mesh, std::string_view owner, Warnings& warnings) {
    std::vector<bool> is_unknown(mesh.positions.size());
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle)
            is_unknown[corner] = mesh.tangents[corner].w == 0;
    const auto count = std::count(is_unknown.begin(), is_unknown.end(), true);
    if (count > 0)
        warnings.add(std::string(owner) + " has " + std::to_string(count) +
                     " vertices without a tangent, whose triangles have no normal map: their texture coordinates are "
                     "all the same or contradict one another, or the file's TANGENT is 0");
}
} // namespace

void read_texture_coordinates(MeshDescription& mesh, const tinygltf::Model& model, const tinygltf::Primitive& primitive,
                              const MaterialDescription& material, const glm::dmat4& to_world, std::string_view owner,
                              Budget& budget, Warnings& warnings) {
    for (std::size_t set = 0; set < mesh.coordinates.size(); ++set) {
        if (!material.uses_coordinates(set))
            continue;
        const std::string name = "TEXCOORD_" + std::to_string(set);
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) {
            warnings.add(std::string(owner) + " has no " + name + " for its material's textures; " +
                         "it has their colour at (0, 0), and no normal map");
            continue;
        }
        const AccessorView view = view_vectors(model, found->second, owner, 2);
        check_count(view, mesh, owner, name);
        budget.charge(view.count, 2 * sizeof(glm::vec2));
        mesh.coordinates[set] = read_pairs(model, view);
        for (const glm::vec2& uv : mesh.coordinates[set])
            if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
                fail({owner, " has a ", name, " that is not finite"});
    }
    if (!material.normal_texture || mesh.coordinates[material.normal_texture->set].empty())
        return;
    const auto tangent = primitive.attributes.find("TANGENT");
    if (tangent != primitive.attributes.end() && !mesh.normals.empty())
        read_tangents(mesh, model, tangent->second, to_world, owner, budget);
    else
        compute_tangents(mesh, *material.normal_texture, budget);
    warn_of_unknown_tangents(mesh, owner, warnings);
}

} // namespace nephroid::examples::gltf
