// SPDX-License-Identifier: MIT
/// @file  Runs the library on the oracle's chains, with a tracer whose hits are exact except for rounding.
#pragma once

#include "common/numerics/chain.hpp"

#include "nephroid/differential/curvature.hpp"
#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/glm.hpp"

#include <optional>

namespace nephroid::examples::numerics {

/// A scene that the ray meets surface by surface in the chain's order.
template <class T>
class ChainScene {
public:
    using V = glm::vec<3, T>;
    using Normals = AnyCurvature<Flat, ShapeOperator<V>, ParametricCurvature<V>, InterpolatedCurvature<V>>;
    using Hit = SurfaceHit<V, Normals>;

    explicit ChainScene(const Chain& chain) : chain_(chain) {}

    [[nodiscard]] std::optional<Hit> intersect(const V& origin, const V& direction, T, T) const {
        if (next_ == chain_.surfaces.size())
            return std::nullopt;
        const std::size_t i = next_++;
        Steady steady;
        const Surface<Wide> s = lift<Wide>(chain_.surfaces[i], steady);
        const Line<Wide> ray{widen(origin), widen(direction).unit()};
        const Meeting<Wide> m = meet(s, ray, chain_.meetings[i]);
        const T distance = static_cast<T>((m.position - ray.x).dot(ray.w));
        const V position = narrow(m.position);
        if (!is_finite(lift<double>(m.position)))
            return std::nullopt; // missed
        return Hit{distance,
                   position,
                   narrow(m.face),
                   narrow(m.shade),
                   normals(s, m),
                   rounding_error(origin, distance, position),
                   i};
    }

    [[nodiscard]] Scattering<T, T> scatter(const Hit& hit, const V&, auto&) const {
        if (hit.surface + 1 == chain_.surfaces.size())
            return Scattering<T, T>::deposit();
        const Surface<double>& s = chain_.surfaces[hit.surface];
        return s.refracts ? Scattering<T, T>::refract(T(1), T(s.eta)) : Scattering<T, T>::reflect(T(1));
    }

    [[nodiscard]] static V narrow(const Point<double>& p) { return V(T(p.x), T(p.y), T(p.z)); }
    [[nodiscard]] static V narrow(const Point<Wide>& p) {
        return V(static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z));
    }
    [[nodiscard]] static Point<Wide> widen(const V& v) { return {Wide(v.x), Wide(v.y), Wide(v.z)}; }

private:
    /// The curvature, in a different form for each kind of surface.
    [[nodiscard]] Normals normals(const Surface<Wide>& s, const Meeting<Wide>& m) const {
        const Point<Wide>& n = m.face;
        switch (s.kind) {
        case Kind::plane:
            return Flat{};
        case Kind::sphere:
            return sphere_curvature<V>(static_cast<T>(s.number[0]));
        case Kind::cylinder: {
            const Point<Wide> axis = s.point[1].unit();
            return principal_curvatures<V>(narrow(n.cross(axis)), T(1) / static_cast<T>(s.number[0]), narrow(axis),
                                           T(0));
        }
        case Kind::torus: {
            const Point<Wide> axis = s.point[1].unit(), q = m.position - s.point[0];
            const Point<Wide> radial = q.across(axis).unit(), around = axis.cross(radial);
            const Wide cosine = n.dot(radial), sine = n.dot(axis);
            const Point<Wide> up_the_tube = cosine * axis - sine * radial;
            return ParametricCurvature<V>{narrow((s.number[0] + s.number[1] * cosine) * around),
                                          narrow(s.number[1] * up_the_tube), narrow(cosine * around),
                                          narrow(up_the_tube)};
        }
        case Kind::wave: {
            const Point<Wide>& k = s.point[2];
            const Wide phase = k.dot(m.position - s.point[0]);
            const Wide length = field(s, m.position).gradient.length();
            const Point<Wide> turned = (s.number[0] * sine_of(phase) / length) * k.across(n);
            return ShapeOperator<V>{narrow(k.x * turned), narrow(k.y * turned), narrow(k.z * turned)};
        }
        case Kind::triangle: {
            const auto [b1, b2] = coordinates_in(s, m.position);
            const auto corner = [&](std::size_t i) { return narrow(s.point[i]); };
            return interpolated_normals(corner(0), corner(1), corner(2), corner(3), corner(4), corner(5),
                                        static_cast<T>(b1), static_cast<T>(b2));
        }
        }
        return Flat{};
    }

    const Chain& chain_;
    mutable std::size_t next_ = 0; // a scene serves one walk
};

/// A sampler whose numbers do not matter, because a chain has no random choices.
struct NoChoice {
    template <class T>
    [[nodiscard]] T next() const {
        return T(0.5);
    }
};

template <class T>
[[nodiscard]] Photon<glm::vec<3, T>, T> photon_of(const Chain& chain) {
    const auto narrow = [](const Point<double>& p) { return ChainScene<T>::narrow(p); };
    return {narrow(chain.position),
            narrow(chain.direction),
            T(1),
            {Tangent<glm::vec<3, T>>{narrow(chain.d_position[0]), narrow(chain.d_direction[0])},
             Tangent<glm::vec<3, T>>{narrow(chain.d_position[1]), narrow(chain.d_direction[1])}}};
}

template <class T>
struct Outcome {
    Tangents tangents;
    double determinant; ///< of the footprint, by the library's own cross product
};

/// The tangents where `nephroid::walk` deposits the photon; nothing if the photon did not arrive. A deposit has no
/// `d_direction`, which is computed by the same steps one by one.
template <class T>
[[nodiscard]] std::optional<Outcome<T>> run_library(const Chain& chain, Statistics& account) {
    using V = glm::vec<3, T>;
    const auto point = [](const V& v) { return Point<double>{double(v.x), double(v.y), double(v.z)}; };
    Photon<V, T> photon = photon_of<T>(chain);
    NoChoice sampler;

    const auto deposit = walk(ChainScene<T>(chain), photon, sampler, WalkLimits{}, account);
    if (!deposit)
        return std::nullopt;
    account.end(Fate::splatted, double(deposit->flux));

    Outcome<T> outcome{};
    const ChainScene<T> scene(chain);
    for (std::size_t i = 0; i < chain.surfaces.size(); ++i) {
        const auto hit = scene.intersect(photon.position, photon.direction, T(0), T(1));
        if (!hit)
            return std::nullopt;
        const auto flight = transfer(photon.direction, hit->distance, hit->geometric_normal);
        if (!flight)
            return std::nullopt;
        for (Tangent<V>& tangent : photon.differential)
            tangent = (*flight)(tangent);
        photon.position = hit->position;
        if (i + 1 == chain.surfaces.size())
            break;

        const Surface<double>& s = chain.surfaces[i];
        const T side = dot(photon.direction, hit->geometric_normal) > T(0) ? T(-1) : T(1);
        const V normal = side * hit->shading_normal;
        const auto through = s.refracts ? refraction(photon.direction, normal, T(s.eta)) : std::nullopt;
        const Reflection<V> back(photon.direction, normal);
        for (Tangent<V>& tangent : photon.differential) {
            const V d_normal = side * V(hit->curvature(tangent.d_position));
            tangent.d_direction = through ? through->differentiate(tangent.d_direction, d_normal)
                                          : back.differentiate(tangent.d_direction, d_normal);
        }
        photon.direction = through ? through->direction() : back.direction();
    }
    for (std::size_t j = 0; j < 2; ++j) {
        outcome.tangents.d_position[j] = point(deposit->d_position[j]);
        outcome.tangents.d_direction[j] = point(photon.differential[j].d_direction);
    }
    outcome.determinant =
        double(dot(deposit->normal, cross(deposit->d_position[0], deposit->d_position[1]))); // faces the photon
    return outcome;
}

} // namespace nephroid::examples::numerics
