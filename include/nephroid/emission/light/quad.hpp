// SPDX-License-Identifier: MIT
/// @file  A parallelogram of constant radiance that emits on one side.
#pragma once

#include "nephroid/emission/light/area.hpp"

namespace nephroid {

/// Emits from the parallelogram corner + [0, 1] edge_u + [0, 1] edge_v, on the side of edge_u × edge_v, with or
/// without a target (see `AreaEmission`). Draws 4 samples: two for the position, two for the direction.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class QuadLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 4};

    struct Options {
        V corner;   ///< world units, finite
        V edge_u;   ///< from the corner, world units
        V edge_v;   ///< from the corner, world units; not parallel to edge_u
        F radiance; ///< flux per area and steradian, >= 0
        /// Bounds of what the photons are aimed at, with a radius > 0; without them the light sends all of its light.
        std::optional<BoundingSphere<V>> target = std::nullopt;
    };

    /// Throws std::invalid_argument for a parameter that is not finite, no area, a negative radiance, a target
    /// whose radius is not positive.
    explicit QuadLight(const Options& options) : QuadLight(options, validated_normal(options)) {}

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>();
        const T u2 = samples.template next<T>();
        const T u3 = samples.template next<T>();
        const T u4 = samples.template next<T>();
        return emission_.emit(point(u1, u2), area_, u3, u4, spread);
    }

    /// The same light, aimed at what lies within a sphere.
    [[nodiscard]] QuadLight aimed_at(const BoundingSphere<V>& target) const {
        return QuadLight({corner_, edge_u_, edge_v_, emission_.radiance(), target});
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        const V middle = point(T(0.5), T(0.5)).position;
        return emission_.domain({Kinks::nowhere, DomainEdge::ends}, middle,
                                T(0.5) * (length(edge_u_) + length(edge_v_)));
    }

    /// The charts of one point of the light, which emits a share of the light's flux, in (0, 1].
    ///
    /// @param u1,u2  choose the point, in [0, 1]
    [[nodiscard]] EmissionCharts<V, F> charts_at(T u1, T u2, T share) const {
        return emission_.charts(point(u1, u2), share * area_);
    }

    /// Exact without a target, π radiance × area; otherwise estimated from 64 points of the parallelogram.
    [[nodiscard]] double power() const { return power_; }

private:
    QuadLight(const Options& options, const V& normal)
        : corner_(options.corner), edge_u_(options.edge_u), edge_v_(options.edge_v), normal_(normal),
          area_(length(cross(options.edge_u, options.edge_v))),
          emission_(options.radiance, options.target, point(T(0.5), T(0.5))),
          power_(emission_.power(area_, [this](T u1, T u2) { return point(u1, u2); })) {}

    [[nodiscard]] static V validated_normal(const Options& options) {
        const detail::Validator validate("QuadLight");
        validate.finite("corner", options.corner);
        validate.finite("edge_u", options.edge_u);
        validate.finite("edge_v", options.edge_v);
        validate.positive("area", length(cross(options.edge_u, options.edge_v)));
        validate.flux("radiance", options.radiance);
        validate.target(options.target);
        return validate.direction("edge_u x edge_v", cross(options.edge_u, options.edge_v));
    }

    [[nodiscard]] LightPoint<V> point(T u1, T u2) const { return {corner_ + (u1 * edge_u_ + u2 * edge_v_), normal_}; }

    V corner_;
    V edge_u_;
    V edge_v_;
    V normal_;
    T area_;
    AreaEmission<V, F> emission_;
    double power_;
};

} // namespace nephroid
