// SPDX-License-Identifier: MIT
/// @file  Curvature from rays traced beside the hit, for renderers that do not know it.
#pragma once

#include "nephroid/differential/curvature.hpp"

#include <cmath>
#include <cstddef>
#include <optional>

namespace nephroid {

/// The change of a shading normal, dn = curvature(dx), by central differences: two rays beside the hit are traced from
/// a little above the surface straight down to it. They are traced only when the walk asks for dn: none where a surface
/// only receives light, two for each tangent at a mirror or glass surface. `Statistics::rays` does not count them.
///
/// Where a ray finds nothing, or another `surface`, or a normal that turns too fast for the scale, the rays move closer
/// together. At a rim or a crease, the difference to the hit itself is used, on the side where the surface continues.
/// If no ray finds the surface, dn is NaN and not a silent zero: the photon ends as Fate::invalid.
/// `finite_difference_curvature` makes one; a default-constructed one gives NaN.
///
/// @tparam Tracer  has `intersect(origin, direction, t_min, t_max)` as transport/scene.hpp asks; may be incomplete here
template <Vector3 V, class Tracer>
class FiniteDifferenceCurvature {
public:
    using T = scalar_t<V>;

    FiniteDifferenceCurvature() = default;

    /// @param tracer  is referred to, and must outlive the curvature
    /// The others as of a hit, and `finite_difference_curvature`.
    FiniteDifferenceCurvature(const Tracer& tracer, const V& position, const V& geometric_normal,
                              const V& shading_normal, std::optional<std::size_t> surface, T scale)
        : tracer_(&tracer), position_(position), geometric_normal_(geometric_normal), shading_normal_(shading_normal),
          surface_(surface), scale_(scale) {}

    /// @param d_position  dx, in the tangent plane
    [[nodiscard]] V operator()(const V& d_position) const {
        if (!tracer_ || !all_finite(d_position) || !(scale_ > T(0)) || !isfinite(scale_))
            return unknown();
        if (!(largest_component(d_position) > T(0)))
            return zero_vector<V>();
        const V along = direction_of(d_position);
        return dot(d_position, along) * derivative(along);
    }

private:
    struct Probe {
        V origin;
        V normal;
    };

    /// A change of the normal, and the distance over which it changed.
    struct Difference {
        V turn;
        T apart;

        [[nodiscard]] T size() const { return length(turn) / apart; }
        /// Whether the normal turns at most four times as fast as on a sphere with this radius.
        [[nodiscard]] bool is_gentle(T scale) const { return scale * length(turn) <= T(4) * apart; }
    };

    /// dn over the length of dx, along a unit vector in the tangent plane.
    [[nodiscard]] V derivative(const V& along) const {
        std::optional<Difference> found;
        T scale = scale_;
        for (int attempt = 0; attempt < 8 && scale > least_scale(); ++attempt) {
            const T h = step(scale);
            const auto ahead = probe(along, h), behind = probe(along, -h);
            const auto to_ahead = from_hit(along, ahead), to_behind = from_hit(along, behind);
            found = gentler(to_ahead, to_behind);
            if (ahead && behind) {
                const Difference across{ahead->normal - behind->normal, to_ahead->apart + to_behind->apart};
                if (to_ahead->is_gentle(scale) && to_behind->is_gentle(scale))
                    return T(1) / across.apart * across.turn;
                // The points are too far apart: they give the radius only roughly.
                scale = (std::max)(T(1) / (std::max)(to_ahead->size(), to_behind->size()), scale / T(16));
            } else if (found && found->is_gentle(scale)) {
                break;
            } else {
                scale = scale / T(4);
            }
        }
        return found ? V(T(1) / found->apart * found->turn) : unknown();
    }

    [[nodiscard]] std::optional<Difference> from_hit(const V& along, const std::optional<Probe>& probe) const {
        if (!probe)
            return std::nullopt;
        const T offset = dot(V(probe->origin - position_), along);
        const T sign = offset < T(0) ? T(-1) : T(1);
        return Difference{sign * (probe->normal - shading_normal_), sign * offset};
    }

    [[nodiscard]] static std::optional<Difference> gentler(const std::optional<Difference>& a,
                                                           const std::optional<Difference>& b) {
        return !b || (a && a->size() <= b->size()) ? a : b;
    }

    /// Traces a ray down to the surface at `offset` along the tangent plane. The surface may lie as far below the plane
    /// as the ray begins above it.
    [[nodiscard]] std::optional<Probe> probe(const V& along, T offset) const {
        const T height = abs(offset);
        const T skipped = tracer_epsilon();
        const V origin = position_ + (offset * along + (height + skipped) * geometric_normal_);
        const auto hit = tracer_->intersect(origin, -geometric_normal_, T(0), T(2) * height + skipped);
        if (!hit)
            return std::nullopt;
        if constexpr (requires { std::size_t((*hit).surface); })
            if (surface_ && *surface_ != std::size_t((*hit).surface))
                return std::nullopt;
        V normal = (*hit).geometric_normal;
        if constexpr (requires { V((*hit).shading_normal); })
            normal = (*hit).shading_normal;
        return Probe{origin, dot(normal, shading_normal_) < T(0) ? V(-normal) : normal};
    }

    /// The distance h = R δ^(1/3) of the rays from the hit, which balances the truncation (h/R)²/R and the rounding
    /// δ/h, with R the scale and δ = ε (1 + |p|/R) the error of a normal computed from a position p.
    [[nodiscard]] T step(T scale) const {
        const double r(scale), away(largest_component(position_)), epsilon(std::numeric_limits<T>::epsilon());
        return T(std::cbrt(epsilon * r * r * (r + away)));
    }

    /// What the tracer skips at the start of every ray (`HasTracerEpsilon`, transport/scene.hpp).
    [[nodiscard]] T tracer_epsilon() const {
        if constexpr (requires { T(tracer_->tracer_epsilon); })
            return T(tracer_->tracer_epsilon);
        else
            return T(0);
    }

    [[nodiscard]] static V unknown() {
        const T nan = std::numeric_limits<T>::quiet_NaN();
        return make_vector<V>(nan, nan, nan);
    }

    /// Below this scale neighbouring points round to the same position.
    [[nodiscard]] T least_scale() const {
        return T(64) * std::numeric_limits<T>::epsilon() * largest_component(position_);
    }

    const Tracer* tracer_ = nullptr;
    V position_ = zero_vector<V>();
    V geometric_normal_ = zero_vector<V>();
    V shading_normal_ = zero_vector<V>();
    std::optional<std::size_t> surface_;
    T scale_ = T(0);
};

/// A hit with a `position` and a `geometric_normal`.
template <class H>
concept LiesOnSurface = requires(const H hit) {
    requires Vector3<std::remove_cvref_t<decltype(hit.position)>>;
    { hit.geometric_normal } -> std::convertible_to<std::remove_cvref_t<decltype(hit.position)>>;
};

/// Makes the curvature of a hit for a renderer that knows only distances and normals.
///
/// ```cpp
/// struct Adapter {
///     using Hit = nephroid::SurfaceHit<V, nephroid::FiniteDifferenceCurvature<V, Adapter>>;
///     std::optional<Hit> intersect(const V& origin, const V& direction, float t_min, float t_max) const {
///         …
///         Hit hit{distance, position, normal, normal, {}, position_error, material};
///         hit.curvature = nephroid::finite_difference_curvature(*this, hit, object_size);
///         return hit;
///     }
/// };
/// ```
///
/// @param tracer  the tracer that found the hit: `tracer.intersect(origin, direction, t_min, t_max)`; must outlive the
///                result. It must find surfaces from both sides; their normals may face the ray or not
/// @param hit     with `position`, `geometric_normal`, and where it has them `shading_normal` and a number `surface`,
///                which the neighbouring points must share
/// @param scale   the surface's least radius of curvature near the hit, or the object's size where that is unknown;
///                world units, positive and finite (else dn is NaN). Too large a scale costs a few more rays, as long
///                as the factor is well below ε^(−1/3), 200 in float; too small a scale costs accuracy, the factor
///                to the power 2/3. The rays start about ε^(1/3) scale off the surface: a tracer that skips a distance
///                at the start of every ray must skip less, or have a member `tracer_epsilon` that says how much
/// @return  for the hit's member `curvature`. The relative error is about (ε (1 + |p|/scale))^(2/3), with ε the
///          scalar's epsilon and |p| the position's largest coordinate: 3e-5 in float, 5e-11 in double
template <class Tracer, LiesOnSurface H>
[[nodiscard]] auto finite_difference_curvature(const Tracer& tracer, const H& hit,
                                               scalar_t<std::remove_cvref_t<decltype(hit.position)>> scale) {
    using V = std::remove_cvref_t<decltype(hit.position)>;
    V shading_normal = hit.geometric_normal;
    if constexpr (requires { V(hit.shading_normal); })
        shading_normal = hit.shading_normal;
    std::optional<std::size_t> surface;
    if constexpr (requires { std::size_t(hit.surface); })
        surface = std::size_t(hit.surface);
    return FiniteDifferenceCurvature<V, Tracer>(tracer, hit.position, hit.geometric_normal, shading_normal, surface,
                                                scale);
}

template <class Tracer, LiesOnSurface H, class Scale>
auto finite_difference_curvature(const Tracer&&, const H&, Scale) = delete; // would refer to a temporary

} // namespace nephroid
