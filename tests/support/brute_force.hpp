// SPDX-License-Identifier: MIT
/// @file  Splatting by its definition: every photon at every vertex, in double, by covariances instead of matrices.
///        Shares no formula with the library.
#pragma once

#include "support/vertex.hpp"

#include "nephroid/transport/walk.hpp"

#include "nephroid/vector/glm.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nephroid::tests {

/// columns x rows vertices with this spacing: corner + i spacing u + j spacing v.
template <class T>
void add_lattice(std::vector<Vertex<glm::vec<3, T>>>& vertices, int columns, int rows, double spacing,
                 const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v, const glm::dvec3& normal) {
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const glm::dvec3 p = corner + i * spacing * u + j * spacing * v;
            vertices.push_back({glm::vec<3, T>(p), glm::vec<3, T>(normal)});
        }
}

/// A symmetric 2 x 2 matrix in coordinates of a footprint's plane: C = a aᵀ + b bᵀ (semi-axes) + r².
struct Covariance {
    glm::dvec3 e1, e2;
    double xx, xy, yy;

    template <class V, class F>
    Covariance(const Deposit<V, F, 2>& deposit, double disk_radius) {
        const glm::dvec3 n(deposit.normal), helper = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        const auto times = [](const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
        const auto across = [](const glm::dvec3& a, const glm::dvec3& b) {
            return glm::dvec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
        };
        e1 = across(n, helper);
        e1 /= std::sqrt(times(e1, e1));
        e2 = across(n, e1);
        xx = yy = disk_radius * disk_radius;
        xy = 0;
        for (const V& d : deposit.d_position) {
            const double x = 0.5 * times(glm::dvec3(d), e1), y = 0.5 * times(glm::dvec3(d), e2);
            xx += x * x, xy += x * y, yy += y * y;
        }
    }
    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
    [[nodiscard]] double major() const {
        return std::sqrt(0.5 * (xx + yy) + std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy));
    }
    [[nodiscard]] double minor() const { return std::sqrt(determinant()) / major(); }
    /// xᵀ C⁻¹ x of a vector's part in the plane: 1 on the outline.
    [[nodiscard]] double radius2(const glm::dvec3& d) const {
        const double x = d.x * e1.x + d.y * e1.y + d.z * e1.z, y = d.x * e2.x + d.y * e2.y + d.z * e2.z;
        return (yy * x * x - 2 * xy * x * y + xx * y * y) / determinant();
    }
};

/// The sum at a vertex, and how much rounding may change it.
struct Received {
    double value = 0;
    double tolerance = 0;
};

/// π K(|M (x − x_p)|) Φ / A at every vertex [Frisvad et al. 2014, eq. 10 to 12]; nothing at a vertex that lies
/// farther from the tangent plane than both `normal_distance` minor radii and the spacing, or that faces the other way.
///
/// @param kernel     of a squared radius, in double, with slopes up to `steepest` of its peak
/// @param filter     the radius of the disk that the pixel filter adds, world units; 0 for none
/// @param epsilon    of the scalar that the library calculates with
template <class V, class Kernel, class F>
void receive(std::vector<Received>& image, const std::vector<Vertex<V>>& vertices, const Deposit<V, F, 2>& deposit,
             double flux, const Kernel& kernel, double filter, double spacing, double epsilon,
             double normal_distance = 0.25) {
    const Covariance c(deposit, filter);
    const double thickness = (std::max)(normal_distance * c.minor(), spacing);
    const double peak = flux / std::sqrt(c.determinant());
    const glm::dvec3 n(deposit.normal), centre(deposit.position);
    // M (x − x_p) is a difference of terms of up to major / minor each; its square is off by twice that, K by its
    // slope, and the peak by a few roundings. On the edge of the disk and of the slab either side may be right.
    const double doubt = 64 * epsilon * c.major() / c.minor();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(vertices[i].position) - centre, m(vertices[i].normal);
        const double facing = m.x * n.x + m.y * n.y + m.z * n.z;
        const double off = std::abs(d.x * n.x + d.y * n.y + d.z * n.z) / thickness, r2 = c.radius2(d);
        if (facing <= 0 || off > 1 + doubt || r2 > 1 + doubt)
            continue;
        const double value = peak * kernel((std::min)(r2, std::nextafter(1.0, 0.0)));
        const bool on_the_edge = off > 1 - doubt || r2 > 1 - doubt;
        image[i].value += off < 1 && r2 < 1 ? value : 0;
        image[i].tolerance += on_the_edge ? value + peak * 4 * doubt : peak * 4 * doubt;
    }
}

} // namespace nephroid::tests
