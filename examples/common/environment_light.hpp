// SPDX-License-Identifier: MIT
/// @file  An environment as a light that emits photons, aimed at the specular surfaces.
#pragma once

#include "common/environment.hpp"

#include "nephroid/emission/aligned_basis.hpp"
#include "nephroid/emission/light.hpp"
#include "nephroid/emission/target.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// Draws a direction in proportion to its light, and a point on a perpendicular disk that covers the target and lies in
/// front of the whole scene, so that objects in between cast shadows. Draws 4 samples: two for the point on the disk,
/// two for the direction.
template <class T, Flux F>
class EnvironmentLight {
public:
    using vector = Vec3<T>;
    using flux_type = F;
    static constexpr EmissionDomain domain{.coordinates = 4, .kinks = {Kinks::diagonals, Kinks::unknown}};

    /// @param scene   a sphere around everything that may cast a shadow
    /// @param others  targets of other lights of this environment: rays to them carry no flux here
    EnvironmentLight(std::shared_ptr<const Environment<T, F>> environment, const BoundingSphere<Vec3<T>>& target,
                     const BoundingSphere<Vec3<T>>& scene, std::vector<BoundingSphere<Vec3<T>>> others = {})
        : environment_(std::move(environment)), target_(target), others_(std::move(others)),
          back_((scene.radius + length(Vec3<T>(scene.centre - target.centre))) * T(1.001)) {}

    template <SampleSource<T> Source>
    [[nodiscard]] Photon<Vec3<T>, F> emit(Source& samples, const Spread<T>& spread) const {
        const T u1 = samples.template next<T>(), u2 = samples.template next<T>();
        const double u3 = double(samples.template next<T>()), u4 = double(samples.template next<T>());
        const auto from = environment_->sample(u3, u4);
        const Vec3<T> direction = -from.towards;
        const AlignedBasis<Vec3<T>> basis = aligned_basis(direction, direction);
        const DiskPoint<T> disk = concentric_disk(u1, u2);
        const T area = pi<T> * square(target_.radius), stands_for = T(1) / from.density;
        const Vec3<T> place = target_.radius * (disk.x * basis.u + disk.y * basis.v);
        // The disk turns around the target with the direction, so the position's change here vanishes at the target.
        const T d_position = spread.length(area), d_direction = spread.length(stands_for);
        const auto tangent = [&](const Vec3<T>& across) {
            return Tangent<Vec3<T>>{(d_position - back_ * d_direction) * across, d_direction * across};
        };
        const T share = is_for_another(target_.centre + place, direction) ? T(0) : T(1);
        return {target_.centre + place - back_ * direction,
                direction,
                static_cast<F>(from.radiance * (share * stands_for * area / spread.photons)),
                {tangent(basis.theta), tangent(basis.phi)}};
    }

    /// Exact except for the interpolation between a picture's pixels, and for rays that are another light's.
    [[nodiscard]] double power() const { return environment_->total() * double(pi<T> * square(target_.radius)); }

private:
    [[nodiscard]] bool is_for_another(const Vec3<T>& at, const Vec3<T>& direction) const {
        return std::any_of(others_.begin(), others_.end(), [&](const BoundingSphere<Vec3<T>>& other) {
            return length2(cross(direction, Vec3<T>(other.centre - at))) <= square(other.radius);
        });
    }

    std::shared_ptr<const Environment<T, F>> environment_;
    BoundingSphere<Vec3<T>> target_;
    std::vector<BoundingSphere<Vec3<T>>> others_;
    T back_;
};

} // namespace nephroid::examples
