// SPDX-License-Identifier: MIT
#include "common/gltf/texture_coordinates.hpp"

#include "common/gltf/accessor.hpp"
#include "common/gltf/transform.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <string>

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

/// The mean direction in which the first coordinate grows, over the triangles around each vertex. Where the image is
/// mirrored on some of these triangles, the sign is that of most of them.
void compute_tangents(MeshDescription& mesh, const TextureReference& map, Budget& budget) {
    budget.charge(mesh.positions.size(), sizeof(glm::vec4) + sizeof(glm::dvec4));
    const auto& coordinates = mesh.coordinates[map.set];
    std::vector<glm::dvec4> sums(mesh.positions.size(), glm::dvec4(0));
    for (const auto& [a, b, c] : mesh.triangles) {
        const glm::dvec3 p(mesh.positions[a]), e1 = glm::dvec3(mesh.positions[b]) - p,
                                               e2 = glm::dvec3(mesh.positions[c]) - p;
        const auto change = [&](std::uint32_t from, std::uint32_t to) {
            return map.transformed_change(glm::dvec2(coordinates[to]) - glm::dvec2(coordinates[from]));
        };
        const glm::dvec2 d1 = change(a, b), d2 = change(a, c);
        const double area = d1.x * d2.y - d1.y * d2.x, sign = area < 0 ? -1 : 1;
        const glm::dvec3 along = sign * (d2.y * e1 - d1.y * e2);
        const double length = glm::length(along);
        if (area != 0 && length > 0)
            for (const std::uint32_t corner : {a, b, c})
                sums[corner] += glm::dvec4(along / length, -sign); // the image's second coordinate grows downwards
    }
    mesh.tangents.assign(sums.size(), glm::vec4(0));
    for (std::size_t i = 0; i < sums.size(); ++i) {
        glm::dvec3 along(sums[i]);
        if (!mesh.normals.empty())
            along -= glm::dot(along, glm::dvec3(mesh.normals[i])) * glm::dvec3(mesh.normals[i]);
        const double length = glm::length(along);
        if (length > 0)
            mesh.tangents[i] = glm::vec4(along / length, sums[i].w < 0 ? -1 : 1);
    }
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
}

} // namespace nephroid::examples::gltf
