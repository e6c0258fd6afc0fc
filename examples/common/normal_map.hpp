// SPDX-License-Identifier: MIT
/// @file  Normal maps: the shading normal of a hit on a triangle, and how it changes along the surface.
#pragma once

#include "common/material.hpp"
#include "common/shapes/mesh.hpp"

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

namespace detail {

/// A vector, and its derivatives by two barycentric coordinates.
struct VaryingVector {
    glm::dvec3 value, d_u, d_v;

    /// Interpolated between three vertices.
    [[nodiscard]] static VaryingVector between(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double u,
                                               double v) {
        return {a + u * (b - a) + v * (c - a), b - a, c - a};
    }
    [[nodiscard]] VaryingVector scaled(double factor, double factor_d_u, double factor_d_v) const {
        return {factor * value, factor_d_u * value + factor * d_u, factor_d_v * value + factor * d_v};
    }
    /// Of length 1; the vector must not be 0.
    [[nodiscard]] VaryingVector normalized() const {
        const double length = glm::length(value), square = length * length;
        return scaled(1 / length, -glm::dot(value, d_u) / (length * square), -glm::dot(value, d_v) / (length * square));
    }
    /// Without its part along a vector of length 1.
    [[nodiscard]] VaryingVector perpendicular_to(const VaryingVector& unit) const {
        return *this + unit.scaled(-glm::dot(value, unit.value), -glm::dot(d_u, unit.value) - glm::dot(value, unit.d_u),
                                   -glm::dot(d_v, unit.value) - glm::dot(value, unit.d_v));
    }
    [[nodiscard]] VaryingVector cross(const VaryingVector& b) const {
        return {glm::cross(value, b.value), glm::cross(d_u, b.value) + glm::cross(value, b.d_u),
                glm::cross(d_v, b.value) + glm::cross(value, b.d_v)};
    }
    friend VaryingVector operator+(const VaryingVector& a, const VaryingVector& b) {
        return {a.value + b.value, a.d_u + b.d_u, a.d_v + b.d_v};
    }
};

} // namespace detail

/// Gives a hit the normal of a normal map, and its curvature, that of the map as well as of the surface. Where the map
/// turns the normal to the back of the surface, and where the mesh has no tangents, the hit stays as it is.
///
/// The map's (x, y, z) stands for x T + y B + z N with the interpolated vertex normal N, the tangent T perpendicular to
/// it, and B = ±N × T, each of length 1. Where N is on the back of the triangle, -N takes its place, but not in B:
/// the sign belongs to the file's normal, and B is a direction in the image.
/// Source: glTF 2.0, sections 3.7.2.1 and 3.9.3; the derivatives by the product rule.
template <class T>
void bend_normal(const TriangleMesh<T>& shape, std::size_t triangle, const MaterialTextures& textures, Hit<T>& hit) {
    using detail::VaryingVector;
    const MeshData<T>& mesh = shape.data();
    const auto& [texture, reference] = textures.normal;
    if (mesh.tangents.empty() || mesh.coordinates[reference.set].empty())
        return;
    const auto& vertices = mesh.triangles[triangle];
    const glm::dvec4 t0(mesh.tangents[vertices[0]]), t1(mesh.tangents[vertices[1]]), t2(mesh.tangents[vertices[2]]);
    if (t0.w == 0 || t1.w == 0 || t2.w == 0)
        return;
    const auto barycentric = shape.barycentric(triangle, hit.position);
    const double u(barycentric[0]), v(barycentric[1]);

    const glm::dvec3 geometric(hit.geometric_normal);
    VaryingVector n{geometric, glm::dvec3(0), glm::dvec3(0)}; // as the file has it
    double front = 1;                                         // times n: on the triangle's front
    if (!mesh.normals.empty()) {
        const glm::dvec3 n0(mesh.normals[vertices[0]]), n1(mesh.normals[vertices[1]]), n2(mesh.normals[vertices[2]]);
        const VaryingVector between = VaryingVector::between(n0, n1, n2, u, v);
        const double side = glm::dot(between.value, geometric);
        if (n0 != glm::dvec3(0) && n1 != glm::dvec3(0) && n2 != glm::dvec3(0) && side != 0) {
            n = between.normalized();
            front = side < 0 ? -1 : 1;
        }
    }
    const VaryingVector t = VaryingVector::between(glm::dvec3(t0), glm::dvec3(t1), glm::dvec3(t2), u, v);
    const VaryingVector across = t.perpendicular_to(n);
    if (!(glm::length(across.value) > 1e-3)) // the vertices' directions, each of length 1, contradict one another
        return;
    const VaryingVector x = across.normalized();
    const VaryingVector y = n.cross(x).scaled(t0.w + t1.w + t2.w < 0 ? -1 : 1, 0, 0);

    const TextureTriangle image(shape, triangle, reference.set);
    const auto texel = texture->smooth_data(reference.transformed(image.at(shape, hit.position)));
    const glm::dvec2 e1 = reference.transformed_change(image.edge_1), e2 = reference.transformed_change(image.edge_2);
    const auto times = [&](const VaryingVector& axis, int band, double scale) {
        return axis.scaled(scale * (2 * texel.value[band] - 1),
                           2 * scale * (texel.d_u[band] * e1.x + texel.d_v[band] * e1.y),
                           2 * scale * (texel.d_u[band] * e2.x + texel.d_v[band] * e2.y));
    };
    const VaryingVector bent =
        times(x, 0, textures.normal_scale) + times(y, 1, textures.normal_scale) + times(n, 2, front);
    const double length = glm::length(bent.value);
    if (!(glm::dot(bent.value, geometric) > 1e-3 * length))
        return;

    const auto [p0, p1, p2] = shape.corners(triangle);
    const glm::dvec3 edge_1 = glm::dvec3(p1) - glm::dvec3(p0), edge_2 = glm::dvec3(p2) - glm::dvec3(p0);
    const glm::dvec3 face = glm::cross(edge_1, edge_2), normal = bent.value / length;
    const double area2 = glm::dot(face, face);
    const auto across_normal = [&](const glm::dvec3& d) {
        return Vec3<T>((d - glm::dot(normal, d) * normal) / length);
    };
    hit.shading_normal = Vec3<T>(normal);
    hit.curvature = InterpolatedCurvature<Vec3<T>>{Vec3<T>(glm::cross(edge_2, face) / area2),
                                                   Vec3<T>(glm::cross(face, edge_1) / area2), across_normal(bent.d_u),
                                                   across_normal(bent.d_v)};
}

} // namespace nephroid::examples
