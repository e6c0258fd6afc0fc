// SPDX-License-Identifier: MIT
/// @file  Normal maps: the shading normal of a hit on a triangle, and how it changes along the surface.
#pragma once

#include "common/material.hpp"
#include "common/shapes/mesh.hpp"

#include "nephroid/vector/dual.hpp"
#include "nephroid/vector/glm.hpp"

#include <glm/geometric.hpp>

#include <cstddef>

namespace nephroid::examples {

/// The texture coordinates of a mesh's triangle.
struct TextureTriangle {
    std::size_t triangle;
    glm::dvec2 corner, edge_1, edge_2; ///< at the first vertex, and the differences of the others from it

    /// @param set  of texture coordinates, which the mesh must have
    template <class T>
    TextureTriangle(const TriangleMesh<T>& mesh, std::size_t index, std::size_t set) : triangle(index) {
        const auto& coordinates = mesh.data().coordinates[set];
        const auto& vertices = mesh.data().triangles[index];
        corner = coordinates[vertices[0]];
        edge_1 = glm::dvec2(coordinates[vertices[1]]) - corner;
        edge_2 = glm::dvec2(coordinates[vertices[2]]) - corner;
    }

    /// The coordinates at a point of the triangle.
    template <class T>
    [[nodiscard]] glm::dvec2 at(const TriangleMesh<T>& mesh, const Vec3<T>& point) const {
        const auto [u, v] = mesh.barycentric(triangle, point);
        return corner + double(u) * edge_1 + double(v) * edge_2;
    }
};

/// Gives a hit the normal of a normal map, and its curvature, that of the map as well as of the surface. Where the map
/// turns the normal to the back of the surface, and where the mesh has no tangents, the hit stays as it is.
///
/// The map's (x, y, z) stands for x T + y B + z N with the interpolated vertex normal N, the tangent T perpendicular to
/// it, and B = ±N × T, each of length 1. Where N is on the back of the triangle, -N takes its place, but not in B:
/// the sign belongs to the file's normal, and B is a direction in the image.
/// Source: glTF 2.0, sections 3.7.2.1 and 3.9.3; the derivatives by dual numbers.
template <class T>
void bend_normal(const TriangleMesh<T>& shape, std::size_t triangle, const MaterialTextures& textures, Hit<T>& hit) {
    using Varying = Dual<double, 2>; // with its derivatives by the barycentric coordinates
    using VaryingVector = glm::vec<3, Varying>;
    const MeshData<T>& mesh = shape.data();
    const auto& [texture, reference] = textures.normal;
    if (mesh.tangents.empty() || mesh.coordinates[reference.set].empty())
        return;
    const auto& vertices = mesh.triangles[triangle];
    const glm::dvec4 t0(mesh.tangents[vertices[0]]), t1(mesh.tangents[vertices[1]]), t2(mesh.tangents[vertices[2]]);
    if (t0.w == 0 || t1.w == 0 || t2.w == 0)
        return;
    const auto barycentric = shape.barycentric(triangle, hit.position);
    const Varying u = Varying::parameter(double(barycentric[0]), 0), v = Varying::parameter(double(barycentric[1]), 1);
    const auto between = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) -> VaryingVector {
        return VaryingVector(a) + u * VaryingVector(b - a) + v * VaryingVector(c - a);
    };

    const glm::dvec3 geometric(hit.geometric_normal);
    VaryingVector n(geometric); // as the file has it
    double front = 1;           // times n: on the triangle's front
    if (!mesh.normals.empty()) {
        const glm::dvec3 n0(mesh.normals[vertices[0]]), n1(mesh.normals[vertices[1]]), n2(mesh.normals[vertices[2]]);
        const VaryingVector sum = between(n0, n1, n2);
        const Varying side = dot(sum, VaryingVector(geometric));
        if (n0 != glm::dvec3(0) && n1 != glm::dvec3(0) && n2 != glm::dvec3(0) && side.value() != 0) {
            n = normalize(sum);
            front = side.value() < 0 ? -1 : 1;
        }
    }
    const VaryingVector t = between(glm::dvec3(t0), glm::dvec3(t1), glm::dvec3(t2)), across = t - dot(t, n) * n;
    if (!(length(across).value() > 1e-3)) // the vertices' directions, each of length 1, contradict one another
        return;
    const double sign = t0.w + t1.w + t2.w < 0 ? -1 : 1;
    const VaryingVector x = normalize(across), y = Varying(sign) * cross(n, x);

    const TextureTriangle image(shape, triangle, reference.set);
    const auto texel = texture->smooth_data(reference.transformed(image.at(shape, hit.position)));
    const glm::dvec2 e1 = reference.transformed_change(image.edge_1), e2 = reference.transformed_change(image.edge_2);
    const auto band = [&](int i) {
        return Varying(2 * texel.value[i] - 1, {2 * (texel.d_u[i] * e1.x + texel.d_v[i] * e1.y),
                                                2 * (texel.d_u[i] * e2.x + texel.d_v[i] * e2.y)});
    };
    const Varying scale(textures.normal_scale);
    const VaryingVector bent = scale * band(0) * x + scale * band(1) * y + Varying(front) * band(2) * n;
    const VaryingVector unit = normalize(bent);
    const auto part = [&](const auto& of) { return glm::dvec3(of(unit.x), of(unit.y), of(unit.z)); };
    const glm::dvec3 normal = part([](const Varying& c) { return c.value(); });
    if (!(glm::dot(normal, geometric) > 1e-3))
        return;

    const auto [p0, p1, p2] = shape.corners(triangle);
    const glm::dvec3 edge_1 = glm::dvec3(p1) - glm::dvec3(p0), edge_2 = glm::dvec3(p2) - glm::dvec3(p0);
    const glm::dvec3 face = glm::cross(edge_1, edge_2);
    const double area2 = glm::dot(face, face);
    hit.shading_normal = Vec3<T>(normal);
    hit.curvature = InterpolatedCurvature<Vec3<T>>{Vec3<T>(glm::cross(edge_2, face) / area2),
                                                   Vec3<T>(glm::cross(face, edge_1) / area2),
                                                   Vec3<T>(part([](const Varying& c) { return c.derivative(0); })),
                                                   Vec3<T>(part([](const Varying& c) { return c.derivative(1); }))};
}

} // namespace nephroid::examples
