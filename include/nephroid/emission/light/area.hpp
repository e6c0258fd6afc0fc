// SPDX-License-Identifier: MIT
/// @file  Emission from a surface of constant radiance, with or without a target: the common part of all area lights.
#pragma once

#include "nephroid/emission/aligned_basis.hpp"
#include "nephroid/emission/chart/direction_chart.hpp"
#include "nephroid/emission/cone.hpp"
#include "nephroid/emission/light.hpp"
#include "nephroid/emission/light/validate.hpp"

#include <optional>

namespace nephroid {

/// A point of a light's surface.
template <Vector3 V>
struct LightPoint {
    V position;
    V normal; ///< unit, on the side that emits
};

/// Emits photons from points of a surface. The radiance is the same at all points and in all directions above the
/// horizon, and zero below.
///
/// If the target fills less than π steradian as seen from a point, directions are uniform in the cone towards it, and
/// photons below the horizon carry no flux. Otherwise, and without a target, directions have the density cos/π. Each
/// point decides for itself, so that a light may extend into its target.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class AreaEmission {
public:
    using T = scalar_t<V>;

    /// @param radiance  flux per area and steradian
    /// @param target    bounds of what the light is aimed at, if any
    /// @param middle    the middle of the light, with its normal. Directions are drawn in frames that are turned from
    ///                  the frame here, so that they are continuous up to a right angle from its axis
    AreaEmission(const F& radiance, const std::optional<BoundingSphere<V>>& target, const LightPoint<V>& middle)
        : radiance_(radiance), target_(target), axis_(middle.normal) {
        if (target_) {
            const V towards = target_->centre - middle.position;
            const T distance = length(towards);
            if (distance > target_->radius)
                axis_ = T(1) / distance * towards;
        }
        frame_ = frame_about(axis_);
    }

    [[nodiscard]] const F& radiance() const { return radiance_; }

    /// Emits one of `spread.photons` photons.
    ///
    /// @param point   drawn uniformly from the light's area
    /// @param area    from which points are drawn, world units squared
    /// @param u1,u2   samples for the direction
    [[nodiscard]] Photon<V, F> emit(const LightPoint<V>& point, T area, T u1, T u2, const Spread<T>& spread) const {
        const T area_per_photon = area / spread.photons;
        if (const std::optional<Cone<V>> cone = aimed_cone(point.position)) {
            const V direction = direction_in(*cone, frame_turned_to(cone->axis), u1, u2);
            const T cosine = (std::max)(T(0), dot(direction, point.normal));
            const T solid_angle = cone->solid_angle();
            return {point.position, direction, static_cast<F>(radiance_ * (cosine * solid_angle * area_per_photon)),
                    tangents(point.normal, direction, spread.length(area), spread.length(solid_angle))};
        }
        const V direction = cosine_direction(point.normal, frame_turned_to(point.normal), concentric_disk(u1, u2));
        const T solid_angle = pi<T> / dot(direction, point.normal); // 1 / density
        return {point.position, direction, static_cast<F>(radiance_ * (pi<T> * area_per_photon)),
                tangents(point.normal, direction, spread.length(area), spread.length(solid_angle))};
    }

    /// The charts of one point, as if it were a lamp by itself: the directions above its horizon, or towards the target
    /// if there is one.
    ///
    /// @param area  represented by the point, world units squared
    [[nodiscard]] EmissionCharts<V, F> charts(const LightPoint<V>& point, T area) const {
        Cone<V> cone{point.normal, T(1)};
        if (target_) {
            const Cone<V> towards = cone_towards(*target_, point.position);
            if (towards.height < cone.height)
                cone = towards;
        }
        return cone_charts<V, F>(point.position, cone, [radiance = radiance_, area, normal = point.normal](const V& d) {
            return static_cast<F>(radiance * (area * (std::max)(T(0), dot(d, normal))));
        });
    }

    /// Estimates the power of a light of this area from 64 of its points.
    ///
    /// @param point  point(u1, u2) returns a point of the light
    template <class Points>
    [[nodiscard]] double power(T area, const Points& point) const {
        constexpr int n = 8;
        T sum = T(0);
        for (int i = 0; i < n * n; ++i)
            sum = sum + projected_solid_angle(point((T(i % n) + T(0.5)) / T(n), (T(i / n) + T(0.5)) / T(n)));
        return flux_traits<F>::power(static_cast<F>(radiance_ * (area * (sum / T(n * n)))));
    }

    /// The domain of a light whose points lie within a sphere.
    ///
    /// @param positions  kinks and edges of its positions' coordinates
    [[nodiscard]] EmissionDomain domain(const EmissionPair& positions, const V& centre, T radius) const {
        // If only some points aim at the target, directions jump between those that do and those that do not.
        const bool is_smooth = !target_ || aims_everywhere(centre, radius) || aims_nowhere(centre, radius);
        return {.coordinates = 4,
                .kinks = {is_smooth ? positions.kinks : Kinks::unknown, Kinks::diagonals},
                .edges = {positions.edges, positions.edges}};
    }

    /// Whether all points of a sphere send their photons into the cone towards the target.
    [[nodiscard]] bool aims_everywhere(const V& centre, T radius) const {
        return target_ && length(V(target_->centre - centre)) - radius > T(1.001) * reach();
    }

private:
    /// The distance from the target's centre beyond which points aim at the target: there the sphere fills half of a
    /// hemisphere, 1 − cos = ½.
    [[nodiscard]] T reach() const { return target_->radius / sqrt(T(0.75)); }
    [[nodiscard]] bool aims_nowhere(const V& centre, T radius) const {
        return length(V(target_->centre - centre)) + radius < T(0.999) * reach();
    }

    /// The cone towards the target, if the point aims at the target.
    [[nodiscard]] std::optional<Cone<V>> aimed_cone(const V& position) const {
        if (!target_)
            return std::nullopt;
        const Cone<V> cone = cone_towards(*target_, position);
        return cone.height < T(0.5) ? std::optional<Cone<V>>(cone) : std::nullopt;
    }

    /// The integral of the cosine over the directions into which a point emits, never zero. Exact if the horizon does
    /// not cut the cone, otherwise approximate.
    [[nodiscard]] T projected_solid_angle(const LightPoint<V>& point) const {
        const std::optional<Cone<V>> cone = aimed_cone(point.position);
        if (!cone)
            return pi<T>;
        const T sine = sqrt(cone->height * (T(2) - cone->height));
        const T cosine = dot(cone->axis, point.normal);
        const T least = T(1e-3); // other points may see the target even if these do not
        if (cosine >= sine)
            return pi<T> * sine * sine * (std::max)(least, cosine);
        const T above = (std::max)(T(0), cosine + sine);
        return pi<T> * sine * ((std::max)(least * sine, above * above / T(4)));
    }

    /// A frame about an axis. It is continuous as long as the axis is less than a right angle away from the middle's.
    [[nodiscard]] Frame<V> frame_turned_to(const V& axis) const {
        using t = vector_traits<V>;
        const Frame<V> local = frame_about(make_vector<V>(dot(axis, frame_.u), dot(axis, frame_.v), dot(axis, axis_)));
        const auto world = [&](const V& l) -> V { return t::x(l) * frame_.u + (t::y(l) * frame_.v + t::z(l) * axis_); };
        return {world(local.u), world(local.v)};
    }

    [[nodiscard]] static PhotonDifferential<V, 2> tangents(const V& normal, const V& direction, T d_position_length,
                                                           T d_direction_length) {
        const AlignedBasis<V> basis = aligned_basis(normal, direction);
        return {Tangent<V>{d_position_length * basis.u, d_direction_length * basis.theta},
                Tangent<V>{d_position_length * basis.v, d_direction_length * basis.phi}};
    }

    F radiance_;
    std::optional<BoundingSphere<V>> target_;
    V axis_;
    Frame<V> frame_ = frame_about(axis_);
};

} // namespace nephroid
