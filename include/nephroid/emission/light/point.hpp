// SPDX-License-Identifier: MIT
/// @file  A point light: the same intensity in every direction.
#pragma once

#include "nephroid/emission/chart/direction_chart.hpp"
#include "nephroid/emission/cone.hpp"
#include "nephroid/emission/light.hpp"
#include "nephroid/emission/light/validate.hpp"

#include <optional>

namespace nephroid {

namespace detail {
/// The tangents of a photon from a point: two orthogonal changes of direction, and none of position.
template <Vector3 V>
[[nodiscard]] PhotonDifferential<V, 2> point_tangents(const V& direction, scalar_t<V> d_direction_length) {
    const Frame<V> frame = frame_about(direction);
    const V zero = zero_vector<V>();
    return {Tangent<V>{zero, d_direction_length * frame.u}, Tangent<V>{zero, d_direction_length * frame.v}};
}
} // namespace detail

/// Emits from one point, uniformly into the cone towards its target, or into every direction if it has no target or is
/// inside of it. Draws 2 samples.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class PointLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 2};

    struct Options {
        V position;  ///< world units, finite
        F intensity; ///< flux per steradian, >= 0
        /// Bounds of what the photons are aimed at, with a radius > 0; without them the light sends all of its light.
        std::optional<BoundingSphere<V>> target = std::nullopt;
    };

    /// Throws std::invalid_argument unless the position is finite, the intensity >= 0 and the target's radius > 0.
    explicit PointLight(const Options& options) : position_(options.position), intensity_(options.intensity) {
        const detail::Validator validate("PointLight");
        validate.finite("position", options.position);
        validate.flux("intensity", options.intensity);
        validate.target(options.target);
        if (options.target)
            cone_ = cone_towards(*options.target, position_);
        frame_ = frame_about(cone_.axis);
    }

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>();
        const T u2 = samples.template next<T>();
        const V direction = direction_in(cone_, frame_, u1, u2);
        const T solid_angle = cone_.solid_angle();
        return {position_, direction, static_cast<F>(intensity_ * (solid_angle / spread.photons)),
                detail::point_tangents(direction, spread.length(solid_angle))};
    }

    /// The same light, aimed at what lies within a sphere.
    [[nodiscard]] PointLight aimed_at(const BoundingSphere<V>& target) const {
        return PointLight({position_, intensity_, target});
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        const EmissionPair pair = direction_pair(cone_);
        return {.coordinates = 2, .kinks = {pair.kinks}, .edges = {pair.edges, pair.edges}};
    }

    [[nodiscard]] EmissionCharts<V, F> charts() const {
        return cone_charts<V, F>(position_, cone_, [intensity = intensity_](const V&) { return intensity; });
    }

    /// Exact: intensity times the solid angle of the cone.
    [[nodiscard]] double power() const {
        return flux_traits<F>::power(static_cast<F>(intensity_ * cone_.solid_angle()));
    }

private:
    V position_;
    F intensity_;
    Cone<V> cone_ = every_direction<V>();
    Frame<V> frame_ = frame_about(cone_.axis);
};

} // namespace nephroid
