// SPDX-License-Identifier: MIT
/// @file  A sphere of constant radiance that emits outwards.
#pragma once

#include "nephroid/emission/light/area.hpp"

namespace nephroid {

/// Emits outwards from a sphere, with or without a target (see `AreaEmission`). With a target, photons start only in
/// the cap from which a part of the target is above the horizon. Draws 4 samples: two for the position, two for the
/// direction.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class SphereLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 4};

    struct Options {
        V centre;   ///< world units, finite
        T radius;   ///< world units, > 0
        F radiance; ///< flux per area and steradian, >= 0
        /// Bounds of what the photons are aimed at, with a radius > 0 and not all inside of the light; without them the
        /// light sends all of its light.
        std::optional<BoundingSphere<V>> target = std::nullopt;
    };

    /// Throws std::invalid_argument for a parameter outside of the ranges above.
    explicit SphereLight(const Options& options) : SphereLight(options, validated_cap(options)) {}

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>();
        const T u2 = samples.template next<T>();
        const T u3 = samples.template next<T>();
        const T u4 = samples.template next<T>();
        return emission_.emit(point(u1, u2), area_, u3, u4, spread);
    }

    /// The same light, aimed at what lies within a sphere.
    [[nodiscard]] SphereLight aimed_at(const BoundingSphere<V>& target) const {
        return SphereLight({centre_, radius_, emission_.radiance(), target});
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        EmissionDomain exact = emission_.domain(direction_pair(cap_), centre_, radius_);
        // The frames about normals are discontinuous at a right angle to the middle one.
        if (cap_.height >= T(1) && !emission_.aims_everywhere(centre_, radius_))
            exact.kinks[0] = Kinks::unknown;
        return exact;
    }

    /// The charts of one point of the light, which emits a share of the light's flux, in (0, 1].
    ///
    /// @param u1,u2  choose the point, in [0, 1]
    [[nodiscard]] EmissionCharts<V, F> charts_at(T u1, T u2, T share) const {
        return emission_.charts(point(u1, u2), share * area_);
    }

    /// Exact without a target, π radiance × area; otherwise estimated from 64 points of the cap.
    [[nodiscard]] double power() const { return power_; }

private:
    SphereLight(const Options& options, const Cone<V>& cap)
        : centre_(options.centre), radius_(options.radius), cap_(cap), across_(frame_about(cap.axis)),
          area_(cap.solid_angle() * square(options.radius)),
          emission_(options.radiance, options.target,
                    LightPoint<V>{options.centre + options.radius * cap.axis, cap.axis}),
          power_(emission_.power(area_, [this](T u1, T u2) { return point(u1, u2); })) {}

    /// The cone of the normals n for which a part of the target is above the tangent plane (y − centre) · n =
    /// radius.
    [[nodiscard]] static Cone<V> validated_cap(const Options& options) {
        const detail::Validator validate("SphereLight");
        validate.finite("centre", options.centre);
        validate.positive("radius", options.radius);
        validate.positive("radius squared", square(options.radius));
        validate.flux("radiance", options.radiance);
        validate.target(options.target);
        if (!options.target)
            return every_direction<V>();

        const V towards = options.target->centre - options.centre;
        const T distance = length(towards);
        const T reach = distance + (options.target->radius - options.radius);
        if (!(reach > T(0)))
            validate.complain("target of radius", detail::text_of(options.target->radius),
                              "lies inside of the light, where it sends nothing; aim it at what is outside");
        if (reach >= T(2) * distance)
            return every_direction<V>(T(1) / distance * towards);
        constexpr T up = T(1) + T(8) * std::numeric_limits<T>::epsilon(); // rounded up, to miss no normal
        return {T(1) / distance * towards, (std::min)(T(2), up * reach / distance)};
    }

    [[nodiscard]] LightPoint<V> point(T u1, T u2) const {
        const V normal = direction_in(cap_, across_, u1, u2);
        return {centre_ + radius_ * normal, normal};
    }

    V centre_;
    T radius_;
    Cone<V> cap_;
    Frame<V> across_;
    T area_;
    AreaEmission<V, F> emission_;
    double power_;
};

} // namespace nephroid
