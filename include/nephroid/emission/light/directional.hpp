// SPDX-License-Identifier: MIT
/// @file  A directional light, such as the sun: a collimated beam from a patch in front of the objects that it lights.
#pragma once

#include "nephroid/emission/aligned_basis.hpp"
#include "nephroid/emission/beam.hpp"
#include "nephroid/emission/chart/beam_chart.hpp"
#include "nephroid/emission/light.hpp"
#include "nephroid/emission/light/validate.hpp"
#include "nephroid/emission/warp.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <variant>

namespace nephroid {

/// Emits in one direction, uniformly from a patch. Draws 2 samples.
///
/// The patch aims the light. It should cover the shadow of the specular objects, and be as small as possible.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class DirectionalLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 2};

    struct Options {
        V direction;  ///< in which the light travels, any length but zero
        F irradiance; ///< of a surface perpendicular to the beam, flux per area, >= 0
        /// Where photons start. A sphere is replaced by the disk in front that covers it; a disk is perpendicular to
        /// the beam; a parallelogram may have any orientation, and the photons' tangents lie in it.
        /// `smallest_beam_over` makes a patch for given bounds.
        BeamPatch<V> patch;
        /// The bounds of your scene. Photons start outside of them, so that a wall between sun and glass casts a
        /// shadow. Without bounds, photons start on a disk or parallelogram itself, or 64 radii in front of a sphere:
        /// objects further away than that cast no shadow, and hits are exact to a few millionths of the radius only.
        std::optional<BoundingSphere<V>> scene = std::nullopt;
    };

    /// Throws std::invalid_argument for a direction without length or in the patch's plane, a patch without area, a
    /// negative irradiance, and values that are not finite.
    explicit DirectionalLight(const Options& options) : irradiance_(options.irradiance), scene_(options.scene) {
        validate_.flux("irradiance", options.irradiance);
        direction_ = validate_.direction("direction", options.direction);
        std::visit([this](const auto& patch) { this->cover(patch); }, options.patch);
        validate_.sphere("scene's", options.scene);
        if (options.scene)
            origin_ = origin_ - distance_out_of(*options.scene) * direction_;
        else if (sphere_)
            origin_ = origin_ - T(64) * sphere_->radius * direction_;
        validate_.positive("patch's area", area_);
        basis_ = aligned_basis(normal_, direction_);
    }

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>();
        const T u2 = samples.template next<T>();
        const DiskPoint<T> at = is_disk_ ? concentric_disk(u1, u2) : DiskPoint<T>{u1, u2};
        const T d_length = spread.length(area_);
        const V zero = zero_vector<V>();
        return {origin_ + (at.x * edge_u_ + at.y * edge_v_),
                direction_,
                static_cast<F>(irradiance_ * (area_ * cosine_ / spread.photons)),
                {Tangent<V>{d_length * basis_.u, zero}, Tangent<V>{d_length * basis_.v, zero}}};
    }

    /// The same light over the shadow of a sphere alone, if its patch is a sphere. A disk or a parallelogram is all
    /// that shines, as of a laser: then there is nothing to aim, and the light stays as it is.
    [[nodiscard]] DirectionalLight aimed_at(const BoundingSphere<V>& target) const {
        if (!sphere_)
            return *this;
        // No later than before, or what stood in the way of this light would not stand in the way of the aimed one.
        const std::optional<BoundingSphere<V>> scene =
            scene_ ? scene_ : BoundingSphere<V>{sphere_->centre, T(65) * sphere_->radius};
        return DirectionalLight({direction_, irradiance_, target, scene});
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        return {.coordinates = 2, .kinks = {is_disk_ ? Kinks::diagonals : Kinks::nowhere}};
    }

    /// Exact: irradiance times the patch's area, projected along the beam.
    [[nodiscard]] double power() const {
        return flux_traits<F>::power(static_cast<F>(irradiance_ * (area_ * cosine_)));
    }

    /// One chart: the parallelogram, or the square around the disk.
    [[nodiscard]] EmissionCharts<V, F> charts() const {
        if (!is_disk_)
            return {beam_chart<V, F>(direction_, origin_, edge_u_, edge_v_,
                                     static_cast<F>(irradiance_ * (area_ * cosine_)), false)};
        return {beam_chart<V, F>(direction_, V(origin_ - (edge_u_ + edge_v_)), V(T(2) * edge_u_), V(T(2) * edge_v_),
                                 static_cast<F>(irradiance_ * (T(4) / pi<T> * area_)), true)};
    }

    /// The direction in which the light travels, unit.
    [[nodiscard]] const V& direction() const { return direction_; }

private:
    void cover(const BoundingSphere<V>& sphere) {
        validate_.finite("patch's centre", sphere.centre);
        validate_.positive("patch's radius", sphere.radius);
        sphere_ = sphere;
        cover(beam_over(direction_, sphere));
    }

    void cover(const BeamDisk<V>& disk) {
        validate_.finite("patch's centre", disk.centre);
        validate_.positive("patch's radius", disk.radius);
        const Frame<V> across = frame_about(direction_);
        is_disk_ = true;
        origin_ = disk.centre;
        edge_u_ = disk.radius * across.u;
        edge_v_ = disk.radius * across.v;
        normal_ = direction_;
        area_ = pi<T> * square(disk.radius);
    }

    void cover(const Parallelogram<V>& patch) {
        validate_.finite("patch's corner", patch.corner);
        validate_.finite("patch's edge_u", patch.edge_u);
        validate_.finite("patch's edge_v", patch.edge_v);
        origin_ = patch.corner;
        edge_u_ = patch.edge_u;
        edge_v_ = patch.edge_v;
        const V face = cross(edge_u_, edge_v_);
        area_ = length(face);
        validate_.positive("patch's area", area_);
        normal_ = validate_.direction("patch's edge_u x edge_v", face);
        cosine_ = abs(dot(normal_, direction_));
        if (!(cosine_ > T(4) * std::numeric_limits<T>::epsilon()))
            validate_.complain("direction", detail::text_of(direction_), "lies in the patch's plane; turn the patch");
    }

    /// The distance by which the patch has to move against the light until all of it is outside of the scene.
    [[nodiscard]] T distance_out_of(const BoundingSphere<V>& scene) const {
        const V last = is_disk_ ? origin_ : origin_ + (T(0.5) * edge_u_ + T(0.5) * edge_v_);
        const T tilt = is_disk_ ? T(0) : T(0.5) * (abs(dot(edge_u_, direction_)) + abs(dot(edge_v_, direction_)));
        const T ahead = dot(V(last - scene.centre), direction_) + tilt;
        return (std::max)(T(0), ahead + scene.radius + detail::beam_margin(scene.centre, scene.radius));
    }

    static constexpr detail::Validator validate_{"DirectionalLight"};

    V direction_ = zero_vector<V>();
    F irradiance_;
    std::optional<BoundingSphere<V>> scene_;
    std::optional<BoundingSphere<V>> sphere_; ///< the patch, if it is one
    bool is_disk_ = false;
    V origin_ = zero_vector<V>(); ///< the disk's centre or the parallelogram's corner
    V edge_u_ = zero_vector<V>(); ///< the disk's radius or the parallelogram's edge
    V edge_v_ = zero_vector<V>();
    V normal_ = zero_vector<V>();
    T area_ = T(0);
    T cosine_ = T(1);
    AlignedBasis<V> basis_{zero_vector<V>(), zero_vector<V>(), zero_vector<V>(), zero_vector<V>()};
};

} // namespace nephroid
