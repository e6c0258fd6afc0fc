// SPDX-License-Identifier: MIT
/// @file  A spot light: a point's intensity that falls off from an inner cone to an outer one.
#pragma once

#include "nephroid/emission/light/point.hpp"

namespace nephroid {

/// Emits from one point, uniformly into its outer cone or into the cone towards its target, whichever is smaller. The
/// falloff scales each photon's flux. Draws 2 samples.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class SpotLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 2};

    struct Options {
        V position;  ///< world units, finite
        V axis;      ///< the direction in which it shines, any length but zero
        T cos_inner; ///< within this angle of the axis the intensity is full; in (cos_outer, 1]
        T cos_outer; ///< beyond this angle it is zero; in [-1, cos_inner)
        F intensity; ///< flux per steradian on the axis, >= 0
        /// Bounds of what the photons are aimed at, with a radius > 0; without them the light sends all of its light.
        std::optional<BoundingSphere<V>> target = std::nullopt;
    };

    /// Throws std::invalid_argument for a parameter outside of the ranges above.
    explicit SpotLight(const Options& options)
        : position_(options.position), intensity_(options.intensity), inner_height_(T(1) - options.cos_inner),
          outer_height_(T(1) - options.cos_outer), ring_height_(options.cos_inner - options.cos_outer) {
        const detail::Validator validate("SpotLight");
        validate.finite("position", options.position);
        axis_ = validate.direction("axis", options.axis);
        validate.flux("intensity", options.intensity);
        validate.target(options.target);
        if (!(options.cos_inner <= T(1)))
            validate.complain("cos_inner", detail::text_of(options.cos_inner), "is not in (cos_outer, 1]");
        if (!(options.cos_outer >= T(-1)))
            validate.complain("cos_outer", detail::text_of(options.cos_outer), "is not in [-1, cos_inner)");
        if (!(options.cos_outer < options.cos_inner))
            validate.complain("cos_outer", detail::text_of(options.cos_outer),
                              "is not below cos_inner; the outer cone is the wider one");

        cone_ = {axis_, outer_height_};
        if (options.target) {
            const Cone<V> towards = cone_towards(*options.target, position_);
            if (towards.height < cone_.height)
                cone_ = towards;
        }
        frame_ = frame_about(cone_.axis);
        power_ = estimate_power();
    }

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>();
        const T u2 = samples.template next<T>();
        const V direction = direction_in(cone_, frame_, u1, u2);
        const T solid_angle = cone_.solid_angle();
        return {position_, direction,
                static_cast<F>(intensity_ * (falloff(direction) * (solid_angle / spread.photons))),
                detail::point_tangents(direction, spread.length(solid_angle))};
    }

    /// The same light, aimed at what lies within a sphere.
    [[nodiscard]] SpotLight aimed_at(const BoundingSphere<V>& target) const {
        return SpotLight(
            {position_, axis_, T(1) - inner_height_, T(1) - inner_height_ - ring_height_, intensity_, target});
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        const EmissionPair pair = direction_pair(cone_);
        return {.coordinates = 2, .kinks = {pair.kinks}, .edges = {pair.edges, pair.edges}};
    }

    [[nodiscard]] EmissionCharts<V, F> charts() const {
        return cone_charts<V, F>(position_, cone_, [light = *this](const V& direction) -> F {
            return static_cast<F>(light.intensity_ * light.falloff(direction));
        });
    }

    /// The intensity in a unit direction over that on the axis, in [0, 1].
    /// Source: glTF extension KHR_lights_punctual, "Inner and outer cone angles".
    [[nodiscard]] T falloff(const V& direction) const {
        const T height = T(0.5) * length2(V(direction - axis_));       // 1 − cos, without cancellation
        const T across_ring = (outer_height_ - height) / ring_height_; // 0 at the outer cone, 1 at the inner one
        return square((std::clamp)(across_ring, T(0), T(1)));
    }

    /// Exact without a target; otherwise estimated from 256 directions.
    [[nodiscard]] double power() const { return power_; }

private:
    [[nodiscard]] double estimate_power() const {
        constexpr int n = 16;
        constexpr T least = T(1e-3); // the target may be lit even if all samples are dark
        T mean = T(0);
        for (int i = 0; i < n * n; ++i) {
            const T u1 = (T(i % n) + T(0.5)) / T(n), u2 = (T(i / n) + T(0.5)) / T(n);
            mean = mean + falloff(direction_in(cone_, frame_, u1, u2)) / T(n * n);
        }
        if (cone_.height == outer_height_)
            mean = (inner_height_ + ring_height_ / T(3)) / outer_height_;
        return flux_traits<F>::power(static_cast<F>(intensity_ * (cone_.solid_angle() * (std::max)(least, mean))));
    }

    V position_;
    V axis_ = zero_vector<V>();
    F intensity_;
    T inner_height_;
    T outer_height_;
    T ring_height_; ///< outer minus inner; from the cosines, because the heights may round to the same number
    Cone<V> cone_ = every_direction<V>();
    Frame<V> frame_ = frame_about(cone_.axis);
    double power_ = 0;
};

} // namespace nephroid
