// SPDX-License-Identifier: MIT
/// @file  The reference: rays in wide precision, optics by angles, and derivatives by differences. Shares no formula
///        with the library.
#pragma once

#include "common/numerics/wide.hpp"

#include "nephroid/vector/traits.hpp"

#include <array>
#include <cstdint>

namespace nephroid::examples::numerics {

/// A vector or a point. Its products are members, so that they are not confused with the library's.
struct Space {
    Wide x, y, z;

    friend Space operator+(const Space& a, const Space& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Space operator-(const Space& a, const Space& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Space operator*(const Wide& s, const Space& a) { return {s * a.x, s * a.y, s * a.z}; }

    [[nodiscard]] Wide dot(const Space& b) const { return x * b.x + y * b.y + z * b.z; }
    [[nodiscard]] Space cross(const Space& b) const {
        return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
    }
    [[nodiscard]] Wide length() const { return sqrt(dot(*this)); }
    [[nodiscard]] Space unit() const { return (Wide(1) / length()) * *this; }
    /// The vector without its part along the unit vector n.
    [[nodiscard]] Space across(const Space& n) const { return *this - dot(n) * n; }
};

template <Vector3 V>
[[nodiscard]] Space widen(const V& v) {
    using t = vector_traits<V>;
    return {Wide(t::x(v)), Wide(t::y(v)), Wide(t::z(v))};
}

template <Vector3 V>
[[nodiscard]] V narrow(const Space& v) {
    using T = scalar_t<V>;
    return vector_traits<V>::make(static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z));
}

/// |a − b|, for comparisons: the difference is taken in wide precision.
template <Vector3 V>
[[nodiscard]] double distance(const V& a, const Space& b) {
    return static_cast<double>((widen(a) - b).length());
}

[[nodiscard]] inline double magnitude(const Space& a) { return static_cast<double>(a.length()); }

/// The mirror image of the reversed ray in the normal: twice the foot of the perpendicular, minus the point.
[[nodiscard]] inline Space mirrored(const Space& direction, const Space& normal) {
    const Space back = Wide(-1) * direction, foot = back.dot(normal) * normal;
    return Wide(2) * foot - back;
}

/// Snell's law by angles in the plane of incidence: sin' = eta sin along the tangent, cos' against the normal.
[[nodiscard]] inline Space bent(const Space& direction, const Space& normal, const Wide& eta) {
    const Space along = direction.across(normal);
    const Wide sine = along.length();
    if (sine == Wide(0))
        return direction;
    const Wide sine_bent = eta * sine;
    const Wide cosine_bent = sqrt((Wide(1) - sine_bent) * (Wide(1) + sine_bent));
    return (sine_bent / sine) * along - cosine_bent * normal;
}

/// Where a ray from x along w meets the plane through p across n.
[[nodiscard]] inline Space on_plane(const Space& x, const Space& w, const Space& p, const Space& n) {
    return x + ((p - x).dot(n) / w.dot(n)) * w;
}

/// Where a ray from x along the unit w meets a sphere about the origin: first or, if `leaving`, second.
[[nodiscard]] inline Space on_sphere(const Space& x, const Space& w, const Wide& radius, bool leaving) {
    const Wide middle = -x.dot(w);
    const Wide half = sqrt(radius * radius - x.across(w).dot(x.across(w)));
    return x + (leaving ? middle + half : middle - half) * w;
}

/// The point's coordinates b1, b2 in a triangle, by Cramer's rule; what lies off the triangle's plane is ignored.
[[nodiscard]] inline std::array<Wide, 2> barycentric(const std::array<Space, 3>& corner, const Space& point) {
    const Space e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], face = e1.cross(e2), p = point - corner[0];
    const Wide volume = e1.dot(e2.cross(face));
    return {p.dot(e2.cross(face)) / volume, e1.dot(p.cross(face)) / volume};
}

/// The step of `derivative`: epsilon^(1/5), where its two errors balance.
[[nodiscard]] inline Wide difference_step() { return power_of_two(-(Wide::digits - 1) / 5); }

/// df/dp at p = 0 by central differences and one step of Richardson's extrapolation.
template <class F>
[[nodiscard]] auto derivative(const F& f) {
    const auto central = [&](const Wide& h) { return (Wide(0.5) / h) * (f(h) - f(-h)); };
    const Wide h = difference_step();
    return (Wide(1) / Wide(3)) * (Wide(4) * central(Wide(0.5) * h) - central(h));
}

/// Bound on the error of `derivative`, per unit of |f|, for f analytic in |p| < radius: the extrapolation leaves h^4
/// f⁗'/(4 · 5!) <= (h / radius)^4 / radius by Cauchy's estimate, rounding 64 operations of epsilon, times 4/h ·
/// 4/3.
[[nodiscard]] inline double derivative_error(double radius) {
    const double h = static_cast<double>(difference_step());
    return std::pow(h / radius, 4) / radius + 64 * power_of_two(1 - Wide::digits) * 6 / h;
}

/// Random numbers that are the same on every machine: integer arithmetic, and numbers that are exact in float.
class Draws {
public:
    explicit Draws(std::uint32_t seed) : state_(seed) {}

    /// A number in [low, high), on a grid of 2^-24 of the range.
    [[nodiscard]] double in(double low, double high) {
        state_ ^= state_ << 13, state_ ^= state_ >> 17, state_ ^= state_ << 5; // xorshift, Marsaglia 2003
        return low + (high - low) * static_cast<double>(state_ >> 8) / 16777216;
    }
    [[nodiscard]] Space in_cube() { return {in(-1, 1), in(-1, 1), in(-1, 1)}; }
    /// A direction, uniform on the sphere.
    [[nodiscard]] Space direction() {
        for (;;) {
            const Space v = in_cube();
            if (const double r2 = static_cast<double>(v.dot(v)); r2 > 0.01 && r2 < 1)
                return v.unit();
        }
    }

private:
    std::uint32_t state_; // not zero
};

} // namespace nephroid::examples::numerics
