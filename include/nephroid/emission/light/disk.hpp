// SPDX-License-Identifier: MIT
/// @file  A disk of constant radiance that emits on one side.
#pragma once

#include "nephroid/emission/light/area.hpp"

namespace nephroid {

/// Emits from a disk, on the side of its normal, with or without a target (see `AreaEmission`). Draws 4 samples: two
/// for the position, two for the direction.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class DiskLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 4};

    struct Options {
        V centre;   ///< world units, finite
        V normal;   ///< on the side that emits, any length but zero
        T radius;   ///< world units, > 0
        F radiance; ///< flux per area and steradian, >= 0
        /// Bounds of what the photons are aimed at, with a radius > 0; without them the light sends all of its light.
        std::optional<BoundingSphere<V>> target = std::nullopt;
    };

    /// Throws std::invalid_argument for a parameter outside of the ranges above.
    explicit DiskLight(const Options& options)
        : DiskLight(options, LightPoint<V>{options.centre, validated_normal(options)}) {}

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>();
        const T u2 = samples.template next<T>();
        const T u3 = samples.template next<T>();
        const T u4 = samples.template next<T>();
        return emission_.emit(point(u1, u2), area_, u3, u4, spread);
    }

    /// The same light, aimed at what lies within a sphere.
    [[nodiscard]] DiskLight aimed_at(const BoundingSphere<V>& target) const {
        return DiskLight({middle_.position, middle_.normal, radius_, emission_.radiance(), target});
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        return emission_.domain({Kinks::diagonals, DomainEdge::ends}, middle_.position, radius_);
    }

    /// The charts of one point of the light, which emits a share of the light's flux, in (0, 1].
    ///
    /// @param u1,u2  choose the point, in [0, 1]
    [[nodiscard]] EmissionCharts<V, F> charts_at(T u1, T u2, T share) const {
        return emission_.charts(point(u1, u2), share * area_);
    }

    /// Exact without a target, π radiance × area; otherwise estimated from 64 points of the disk.
    [[nodiscard]] double power() const { return power_; }

private:
    DiskLight(const Options& options, const LightPoint<V>& middle)
        : middle_(middle), across_(frame_about(middle.normal)), radius_(options.radius),
          area_(pi<T> * square(options.radius)), emission_(options.radiance, options.target, middle),
          power_(emission_.power(area_, [this](T u1, T u2) { return point(u1, u2); })) {}

    [[nodiscard]] static V validated_normal(const Options& options) {
        const detail::Validator validate("DiskLight");
        validate.finite("centre", options.centre);
        validate.positive("radius", options.radius);
        validate.positive("radius squared", square(options.radius));
        validate.flux("radiance", options.radiance);
        validate.target(options.target);
        return validate.direction("normal", options.normal);
    }

    [[nodiscard]] LightPoint<V> point(T u1, T u2) const {
        const DiskPoint<T> disk = concentric_disk(u1, u2);
        const V offset = (radius_ * disk.x) * across_.u + (radius_ * disk.y) * across_.v;
        return {middle_.position + offset, middle_.normal};
    }

    LightPoint<V> middle_;
    Frame<V> across_;
    T radius_;
    T area_;
    AreaEmission<V, F> emission_;
    double power_;
};

} // namespace nephroid
