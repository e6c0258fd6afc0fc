// SPDX-License-Identifier: MIT
/// @file  Analytic surfaces and their intersections with rays, for every kind of number. They use nothing of the
///        library, and no normal is differentiated.
#pragma once

#include "common/numerics/arithmetic.hpp"

namespace nephroid::examples::numerics {

enum class Kind : unsigned char { plane, sphere, cylinder, torus, wave, triangle };
inline constexpr int kind_count = 6;
inline constexpr std::array<const char*, kind_count> kind_names = {"plane", "sphere", "cylinder",
                                                                   "torus", "wave",   "triangle"};

/// A surface, and whether it refracts or reflects. The meaning of the data depends on the kind:
///
/// plane     point[0] on it, point[1] its normal
/// sphere    point[0] centre, number[0] radius
/// cylinder  point[0] on the axis, point[1] along it, number[0] radius
/// torus     point[0] centre, point[1] axis, number[0] radius of the ring, number[1] of the tube
/// wave      (x − o) · up = a sin(k · (x − o)): point[0] o, point[1] up, point[2] k, number[0] a
/// triangle  point[0..2] corners, point[3..5] their normals
///
/// Normals and axes need not be unit: they are rounded.
template <class S>
struct Surface {
    Kind kind = Kind::plane;
    bool first = true;     ///< sphere, cylinder: whether the ray meets the side that it would enter through
    bool refracts = false; ///< otherwise it reflects, as it does beyond the critical angle
    S eta = S(1);          ///< n₁/n₂
    std::array<Point<S>, 6> point{};
    std::array<S, 2> number{};
};

template <class S>
struct Line {
    Point<S> x, w; ///< origin and direction, unit
};

template <class S>
struct Meeting {
    Point<S> position;
    Point<S> face;  ///< the geometric normal, unit
    Point<S> shade; ///< the shading normal, unit
};

/// Signed distance-like field of a torus or a wave, and its gradient.
template <class S>
struct Field {
    S value;
    Point<S> gradient;
};

template <class S>
[[nodiscard]] Field<S> field(const Surface<S>& s, const Point<S>& p) {
    const Point<S> q = p - s.point[0];
    if (s.kind == Kind::torus) {
        const Point<S> axis = s.point[1].unit(), radial = q.across(axis);
        const S z = q.dot(axis), rho = radial.length(), off = rho - s.number[0];
        const Point<S> to_ring = (off / rho) * radial + z * axis;
        const S d = to_ring.length();
        return {d - s.number[1], (S(1) / d) * to_ring};
    }
    const S phase = s.point[2].dot(q);
    return {q.dot(s.point[1]) - s.number[0] * sine_of(phase),
            s.point[1] - (s.number[0] * cosine_of(phase)) * s.point[2]};
}

/// A point's coordinates b1, b2 in a triangle, by ratios of areas.
template <class S>
[[nodiscard]] std::array<S, 2> coordinates_in(const Surface<S>& triangle, const Point<S>& p) {
    const Point<S> e1 = triangle.point[1] - triangle.point[0], e2 = triangle.point[2] - triangle.point[0];
    const Point<S> face = e1.cross(e2), q = p - triangle.point[0];
    const S whole = face.dot(face);
    return {q.cross(e2).dot(face) / whole, e1.cross(q).dot(face) / whole};
}

/// @param about  a point near the wanted intersection, because a torus and a wave have several
template <class S>
[[nodiscard]] Meeting<S> meet(const Surface<S>& s, const Line<S>& ray, const Point<double>& about) {
    const Point<S>&x = ray.x, &w = ray.w;
    const auto through = [&](const Point<S>& p, const Point<S>& n) -> Point<S> {
        return x + ((p - x).dot(n) / w.dot(n)) * w;
    };
    switch (s.kind) {
    case Kind::plane: {
        const Point<S> n = s.point[1].unit();
        return {through(s.point[0], n), n, n};
    }
    case Kind::sphere: {
        const Point<S> o = x - s.point[0];
        const S middle = -o.dot(w);
        const Point<S> closest = o + middle * w;
        const S half = sqrt(s.number[0] * s.number[0] - closest.dot(closest));
        const Point<S> p = x + (s.first ? middle - half : middle + half) * w;
        const Point<S> n = (S(1) / s.number[0]) * (p - s.point[0]);
        return {p, n, n};
    }
    case Kind::cylinder: {
        const Point<S> axis = s.point[1].unit(), o = (x - s.point[0]).across(axis), d = w.across(axis);
        const S dd = d.dot(d), middle = -o.dot(d) / dd;
        const Point<S> closest = o + middle * d;
        const S half = sqrt((s.number[0] * s.number[0] - closest.dot(closest)) / dd);
        const Point<S> p = x + (s.first ? middle - half : middle + half) * w;
        const Point<S> n = (S(1) / s.number[0]) * (p - s.point[0]).across(axis);
        return {p, n, n};
    }
    case Kind::triangle: {
        const Point<S> n = (s.point[1] - s.point[0]).cross(s.point[2] - s.point[0]).unit();
        const Point<S> p = through(s.point[0], n);
        const auto [b1, b2] = coordinates_in(s, p);
        const Point<S> shade = s.point[3] + b1 * (s.point[4] - s.point[3]) + b2 * (s.point[5] - s.point[3]);
        return {p, n, shade.unit()};
    }
    case Kind::torus:
    case Kind::wave:
        break;
    }
    // Newton's method from nearby; the last step only serves the derivatives, as the one before is below rounding.
    S t = (lift<S>(about) - x).dot(w);
    for (int i = 0, left = 40; i < left; ++i) {
        const auto [value, gradient] = field(s, Point<S>(x + t * w));
        const S step = value / gradient.dot(w);
        t = t - step;
        if (left == 40 && !(std::abs(as_double(step)) > std::ldexp(std::abs(as_double(t)), 6 - digits_of<S>)))
            left = i + 2;
    }
    const Point<S> p = x + t * w, n = field(s, p).gradient.unit();
    return {p, n, n};
}

/// The squared cosine after refraction, 1 − (η sin)²; not positive in total reflection.
template <class S>
[[nodiscard]] S squared_cosine_beyond(const Surface<S>& s, const Point<S>& w, const Point<S>& n) {
    const Point<S> along = w.across(n);
    return S(1) - s.eta * s.eta * along.dot(along);
}

/// The direction after a surface: Snell's law scales its part along the surface, and its length stays 1.
template <class S>
[[nodiscard]] Point<S> turned(const Surface<S>& s, const Point<S>& w, const Point<S>& n) {
    const Point<S> along = w.across(n);
    if (!s.refracts || !(as_double(squared_cosine_beyond(s, w, n)) > 0))
        return along - w.dot(n) * n;
    const S cosine = sqrt(squared_cosine_beyond(s, w, n));
    return s.eta * along + (as_double(w.dot(n)) < 0 ? -cosine : cosine) * n;
}

} // namespace nephroid::examples::numerics
