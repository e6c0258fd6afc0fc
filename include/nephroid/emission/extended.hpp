// SPDX-License-Identifier: MIT
/// @file  A sun with a size: a directional light whose photons carry the extent of its disk along as tangents.
#pragma once

#include "nephroid/emission/light.hpp"
#include "nephroid/emission/target.hpp"
#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/frame.hpp"
#include "nephroid/vector/text.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace nephroid {

/// The parameters of photons that stand for a disk of directions: none that a scene would ask for.
struct DirectionExtent {
    static constexpr std::array tangents{TangentKind::extent, TangentKind::extent};
};

/// What is seen of a sun.
template <Vector3 V>
struct DiskInSky {
    double angular_radius; ///< of the disk, radians, >= 0; the sun's is 0.00465
    /// A point by the first mirror or glass. Across the light there, photons stay where they are while their
    /// directions change. Any point would do for light that is the same everywhere; a near one keeps the change
    /// small, to which the tangents are exact to first order alone.
    V pivot;
    double second_moment = 1.0 / 8; ///< of the kernel that photons are splatted with; that of the biweight
};

/// Light from a disk in the sky, such as the sun's. Its photons fly in the direction of the disk's middle, and two more
/// tangents widen their footprints by what the other directions would do: the second moments of the disk's light are
/// exact, its profile is the kernel's instead. So the light keeps its two coordinates, where a light that draws its
/// directions would have four.
///
/// ```cpp
/// const nephroid::Extended sun(nephroid::DirectionalLight<Vec3, Colour>({direction, irradiance, glass}),
///                              {.angular_radius = 0.00465, .pivot = glass.centre});
/// ```
///
/// @tparam L  a light whose photons all fly in one direction, with two tangents
template <Light L>
    requires(emitted_t<L>::tangent_count == 2)
class Extended : public detail::DomainLike<L> {
public:
    using vector = typename L::vector;
    using flux_type = typename L::flux_type;
    using T = scalar_t<vector>;
    using photon_type = ParametricPhoton<vector, flux_type, 4, DirectionExtent>;

    /// Throws std::invalid_argument for an angular radius that is negative or above a quarter, a pivot that is not
    /// finite, and a moment that is not positive.
    Extended(L light, const DiskInSky<vector>& options) : light_(std::move(light)), options_(options) {
        const double radius = options.angular_radius;
        if (!(radius >= 0 && radius <= 0.25))
            invalid_argument("nephroid::Extended: angular_radius is " + detail::text_of(radius) +
                             "; it must be from 0 to 0.25 radians, as tangents are exact for small disks");
        if (!all_finite(options.pivot))
            invalid_argument("nephroid::Extended: pivot is " + detail::text_of(options.pivot) + "; it must be finite");
        if (!(options.second_moment > 0) || !std::isfinite(options.second_moment))
            invalid_argument("nephroid::Extended: second_moment is " + detail::text_of(options.second_moment) +
                             "; it must be positive, as that of every kernel is");
    }

    template <SampleSource<T> S>
    [[nodiscard]] photon_type emit(S& samples, const Spread<T>& spread) const {
        const auto photon = light_.emit(samples, spread);
        // A disk of radius r has the variance r²/4 along an axis, and half of a tangent d has m₂ (d/2)².
        const T d_length(options_.angular_radius / std::sqrt(options_.second_moment));
        const T before = dot(vector(options_.pivot - photon.position), photon.direction);
        const auto [u, v] = frame_about(photon.direction);
        const auto turned = [&](const vector& axis) {
            const vector d_direction = d_length * axis;
            return Tangent<vector>{-before * d_direction, d_direction};
        };
        return {photon.position,
                photon.direction,
                photon.flux,
                {photon.differential[0], photon.differential[1], turned(u), turned(v)},
                {}};
    }

    [[nodiscard]] EmissionDomain exact_domain() const requires detail::DeclaresDomain<L> { return domain_of(light_); }
    template <class S>
        requires requires(const L& light, S& samples) { light.draw_coordinates(samples); }
    void draw_coordinates(S& samples) const { light_.draw_coordinates(samples); }

    /// The same light, aimed at what lies within a sphere, with its pivot there.
    [[nodiscard]] Extended aimed_at(const BoundingSphere<vector>& target) const requires AimsAt<L, vector> {
        DiskInSky<vector> options = options_;
        options.pivot = target.centre;
        return {light_.aimed_at(target), options};
    }

    [[nodiscard]] double power() const { return double(light_.power()); }
    [[nodiscard]] const L& light() const { return light_; }

private:
    L light_;
    DiskInSky<vector> options_;
};
template <class L> // named, because g++ 12 loses the const of the constructor's parameter
Extended(L, DiskInSky<typename L::vector>)->Extended<L>;

} // namespace nephroid
