// SPDX-License-Identifier: MIT
/// @file  A directional light: a collimated beam from a patch in front of what it lights, such as the sun's.
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
/// The patch is what the light is aimed with: the smaller it is about the specular objects' shadow, the better.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class DirectionalLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 2};

    struct Options {
        V direction;  ///< the way the light goes, any length but zero
        F irradiance; ///< of a surface across the beam, flux per area, >= 0
        /// A sphere is covered by a disk in front of it; a disk lies across the beam; a parallelogram may lie as it
        /// likes: photons start on it, and their tangents lie in it. `smallest_beam_over` makes one for given bounds.
        BeamPatch<V> patch;
        /// All that may stand in the light's way: it starts outside of this, so that a wall between sun and glass
        /// casts its shadow. Without it a disk or a parallelogram is where photons start, and those aimed at a sphere
        /// start 64 radii ahead of it: what is further away than that does not count, and what they meet is found
        /// to a few millionths of a radius only. Pass your scene's bounds.
        std::optional<BoundingSphere<V>> scene = std::nullopt;
    };

    /// Throws std::invalid_argument for a direction without length or in the patch's plane, a patch without area, a
    /// negative irradiance, and what is not finite.
    explicit DirectionalLight(const Options& options) : irradiance_(options.irradiance) {
        validate_.flux("irradiance", options.irradiance);
        direction_ = validate_.direction("direction", options.direction);
        std::visit([this](const auto& patch) { this->cover(patch); }, options.patch);
        validate_.sphere("scene's", options.scene);
        if (options.scene)
            origin_ = origin_ - way_out_of(*options.scene) * direction_;
        else if (std::holds_alternative<BoundingSphere<V>>(options.patch))
            origin_ = origin_ - T(64) * std::get<BoundingSphere<V>>(options.patch).radius * direction_;
        validate_.positive("patch's area", area_);
        basis_ = aligned_basis(normal_, direction_);
    }

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>();
        const T u2 = samples.template next<T>();
        const DiskPoint<T> place = is_disk_ ? concentric_disk(u1, u2) : DiskPoint<T>{u1, u2};
        const T d_length = spread.length(area_);
        const V zero = zero_vector<V>();
        return {origin_ + (place.x * edge_u_ + place.y * edge_v_),
                direction_,
                static_cast<F>(irradiance_ * (area_ * cosine_ / spread.photons)),
                {Tangent<V>{d_length * basis_.u, zero}, Tangent<V>{d_length * basis_.v, zero}}};
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        return {.coordinates = 2, .kinks = {is_disk_ ? Kinks::diagonals : Kinks::nowhere}};
    }

    /// Exact: irradiance times the patch's area as the beam sees it.
    [[nodiscard]] double power() const {
        return flux_traits<F>::power(static_cast<F>(irradiance_ * (area_ * cosine_)));
    }

    /// Its patch; of a disk, the square about it.
    [[nodiscard]] EmissionCharts<V, F> charts() const {
        if (!is_disk_)
            return {beam_chart<V, F>(direction_, origin_, edge_u_, edge_v_,
                                     static_cast<F>(irradiance_ * (area_ * cosine_)), false)};
        return {beam_chart<V, F>(direction_, V(origin_ - (edge_u_ + edge_v_)), V(T(2) * edge_u_), V(T(2) * edge_v_),
                                 static_cast<F>(irradiance_ * (T(4) / pi<T> * area_)), true)};
    }

    /// The unit direction that the light goes.
    [[nodiscard]] const V& direction() const { return direction_; }

private:
    void cover(const BoundingSphere<V>& sphere) {
        validate_.finite("patch's centre", sphere.centre);
        validate_.positive("patch's radius", sphere.radius);
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

    /// How far the patch has to go back against the light until all of it is outside of the scene.
    [[nodiscard]] T way_out_of(const BoundingSphere<V>& scene) const {
        const V last = is_disk_ ? origin_ : origin_ + (T(0.5) * edge_u_ + T(0.5) * edge_v_);
        const T tilt = is_disk_ ? T(0) : T(0.5) * (abs(dot(edge_u_, direction_)) + abs(dot(edge_v_, direction_)));
        const T ahead = dot(V(last - scene.centre), direction_) + tilt;
        return (std::max)(T(0), ahead + scene.radius + detail::beam_margin(scene.centre, scene.radius));
    }

    static constexpr detail::Validator validate_{"DirectionalLight"};

    V direction_ = zero_vector<V>();
    F irradiance_;
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
