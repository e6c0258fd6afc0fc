// SPDX-License-Identifier: MIT
/// @file  Meshes, rays and lists of numbers that the tests of the examples share.
#pragma once

#include "common/ray.hpp"
#include "common/shapes/mesh.hpp"

#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <random>
#include <vector>

namespace nephroid::examples::testing {

using Real = long double;
using RealVec3 = glm::vec<3, long double>;

/// Numbers and directions from a fixed seed.
class Numbers {
public:
    explicit Numbers(unsigned seed) : engine_(seed) {}

    double operator()(double low, double high) { return low + (high - low) * double(engine_()) / 4294967296.0; }

    template <class T>
    Vec3<T> point(double low, double high) {
        const double x = (*this)(low, high), y = (*this)(low, high), z = (*this)(low, high);
        return {T(x), T(y), T(z)};
    }

    /// Unit to the rounding of T.
    template <class T>
    Vec3<T> direction() {
        const double z = (*this)(-1, 1), phi = (*this)(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
        return Vec3<T>(Vec3<double>(r * std::cos(phi), r * std::sin(phi), z));
    }

private:
    std::mt19937 engine_;
};

/// What is left of the sampler: a list of numbers, and how many were drawn.
struct ListSampler {
    std::vector<double> numbers;
    std::size_t drawn = 0;

    template <class T>
    T next() {
        return static_cast<T>(numbers.at(drawn++));
    }
};

/// A closed mesh about the centre: radius 1 + bump sin(5θ) cos(6φ), with its radial directions as normals.
template <class T>
MeshData<T> globe(unsigned rings, double bump = 0, const Vec3<T>& centre = Vec3<T>(0)) {
    MeshData<T> mesh;
    const unsigned columns = 2 * rings;
    for (unsigned j = 0; j <= rings; ++j)
        for (unsigned i = 0; i < columns; ++i) {
            const double theta = std::numbers::pi * j / rings, phi = 2 * std::numbers::pi * i / columns;
            const Vec3<double> n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
            const bool is_pole = j == 0 || j == rings;
            const double r = is_pole ? 1 : 1 + bump * std::sin(5 * theta) * std::cos(6 * phi);
            // All columns meet at the very same pole.
            const Vec3<double> unit = is_pole ? Vec3<double>(0, 0, j == 0 ? 1 : -1) : n;
            mesh.positions.push_back(centre + Vec3<T>(r * unit));
            mesh.normals.push_back(Vec3<T>(unit));
        }
    const auto at = [columns](unsigned i, unsigned j) { return j * columns + i % columns; };
    for (unsigned j = 0; j < rings; ++j)
        for (unsigned i = 0; i < columns; ++i) {
            if (j + 1 < rings)
                mesh.triangles.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
            if (j > 0)
                mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
        }
    return mesh;
}

/// A rectangle in the plane z = height as two triangles, facing up (or down), without normals.
template <class T>
MeshData<T> sheet(T half, T height, bool up = true, std::uint32_t material = 0) {
    MeshData<T> mesh;
    mesh.positions = {{-half, -half, height}, {half, -half, height}, {half, half, height}, {-half, half, height}};
    if (up)
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    else
        mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
    mesh.materials = {material, material};
    return mesh;
}

inline Real norm(const RealVec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

} // namespace nephroid::examples::testing
