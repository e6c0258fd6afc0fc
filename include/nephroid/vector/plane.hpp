// SPDX-License-Identifier: MIT
/// @file  Vectors and matrices of the plane in double precision, for the shapes of footprints.
#pragma once

#include "nephroid/vector/language.hpp"

#include <algorithm>
#include <cmath>

namespace nephroid::detail {

/// A vector of the plane.
struct Plane2 {
    double x = 0, y = 0;

    friend Plane2 operator+(Plane2 a, Plane2 b) { return {a.x + b.x, a.y + b.y}; }
    friend Plane2 operator*(double s, Plane2 a) { return {s * a.x, s * a.y}; }
    [[nodiscard]] friend double inner(Plane2 a, Plane2 b) { return a.x * b.x + a.y * b.y; }
};

/// A symmetric 2 × 2 tensor.
struct Symmetric2 {
    double xx = 0, xy = 0, yy = 0;

    [[nodiscard]] static Symmetric2 isotropic(double value) { return {value, 0, value}; }
    /// v vᵀ
    [[nodiscard]] static Symmetric2 outer(Plane2 v) { return {v.x * v.x, v.x * v.y, v.y * v.y}; }

    [[nodiscard]] double trace() const { return xx + yy; }
    [[nodiscard]] double determinant() const { return xx * yy - xy * xy; }
    [[nodiscard]] Plane2 operator()(Plane2 v) const { return {xx * v.x + xy * v.y, xy * v.x + yy * v.y}; }

    Symmetric2& operator+=(const Symmetric2& o) {
        xx += o.xx, xy += o.xy, yy += o.yy;
        return *this;
    }
    friend Symmetric2 operator+(Symmetric2 a, const Symmetric2& b) { return a += b; }
    friend Symmetric2 operator*(double s, const Symmetric2& m) { return {s * m.xx, s * m.xy, s * m.yy}; }
};

/// Any 2 × 2 matrix, by columns.
struct PlaneMatrix {
    Plane2 first, second;

    [[nodiscard]] double determinant() const { return first.x * second.y - second.x * first.y; }
    [[nodiscard]] Plane2 operator()(Plane2 v) const { return v.x * first + v.y * second; }
    /// Its determinant must not be 0.
    [[nodiscard]] PlaneMatrix inverse() const {
        const double d = 1 / determinant();
        return {{d * second.y, -d * first.y}, {-d * second.x, d * first.x}};
    }
    [[nodiscard]] PlaneMatrix transposed() const { return {{first.x, second.x}, {first.y, second.y}}; }
    friend PlaneMatrix operator*(const PlaneMatrix& a, const PlaneMatrix& b) { return {a(b.first), a(b.second)}; }
};

/// M S Mᵀ.
[[nodiscard]] inline Symmetric2 congruent(const PlaneMatrix& m, const Symmetric2& s) {
    const Plane2 row_x{m.first.x, m.second.x}, row_y{m.first.y, m.second.y};
    return {inner(row_x, s(row_x)), inner(row_x, s(row_y)), inner(row_y, s(row_y))};
}

/// The eigenvalues of a tensor, and the direction of the larger one.
struct Principal2 {
    double larger, smaller;
    Plane2 axis; ///< unit

    explicit Principal2(const Symmetric2& m) {
        const double half_difference = 0.5 * (m.xx - m.yy), middle = 0.5 * m.trace();
        const double radius = std::hypot(half_difference, m.xy);
        const double angle = 0.5 * std::atan2(m.xy, half_difference);
        larger = middle + radius, smaller = middle - radius;
        axis = {std::cos(angle), std::sin(angle)};
    }

    /// The tensor with the same axes and these eigenvalues, the first one along `axis`.
    [[nodiscard]] Symmetric2 with(double along, double across) const {
        return {along * axis.x * axis.x + across * axis.y * axis.y, (along - across) * axis.x * axis.y,
                along * axis.y * axis.y + across * axis.x * axis.x};
    }
};

} // namespace nephroid::detail
