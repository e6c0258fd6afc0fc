// SPDX-License-Identifier: MIT
/// @file  A position or a vector in double precision, whatever the renderer's own vectors are made of.
#pragma once

#include "nephroid/vector/algebra.hpp"

namespace nephroid::detail {

struct Double3 {
    double x = 0, y = 0, z = 0;

    Double3& operator+=(const Double3& o) {
        x += o.x, y += o.y, z += o.z;
        return *this;
    }
    friend Double3 operator+(const Double3& a, const Double3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Double3 operator-(const Double3& a, const Double3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Double3 operator*(double s, const Double3& a) { return {s * a.x, s * a.y, s * a.z}; }
    [[nodiscard]] friend double inner(const Double3& a, const Double3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

} // namespace nephroid::detail

template <>
struct nephroid::vector_traits<nephroid::detail::Double3> {
    using scalar = double;
    using vector = nephroid::detail::Double3;
    [[nodiscard]] static constexpr vector make(double x, double y, double z) { return {x, y, z}; }
    [[nodiscard]] static constexpr double x(const vector& v) { return v.x; }
    [[nodiscard]] static constexpr double y(const vector& v) { return v.y; }
    [[nodiscard]] static constexpr double z(const vector& v) { return v.z; }
};

namespace nephroid::detail {

/// A renderer's vector in double precision.
template <Vector3 V>
[[nodiscard]] Double3 double3(const V& v) {
    using t = vector_traits<V>;
    return {double(t::x(v)), double(t::y(v)), double(t::z(v))};
}

/// Back to the renderer's type.
template <Vector3 V>
[[nodiscard]] V to_world(const Double3& v) {
    using T = scalar_t<V>;
    return make_vector<V>(T(v.x), T(v.y), T(v.z));
}

/// a × b, each component the difference of two rounded products: enough for areas and normals of patches.
[[nodiscard]] inline Double3 plain_cross(const Double3& a, const Double3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// v / |v|; zero where v is.
[[nodiscard]] inline Double3 unit_or_zero(const Double3& v) {
    const double size = length(v);
    return size > 0 ? (1 / size) * v : Double3{};
}

} // namespace nephroid::detail
