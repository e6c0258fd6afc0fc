// SPDX-License-Identifier: MIT
/// @file  Photon mapping with a fixed radius: all photons within a range, by their distance.
#pragma once

#include "nephroid/gather/coverage.hpp"
#include "nephroid/gather/gather.hpp"

#include <utility>

namespace nephroid {

struct FixedRangeOptions {
    double range;               ///< R > 0, world units: the radius of the kernel
    double normal_distance = 1; ///< > 0, in radii: photons farther from the tangent plane do not count. With 1 or more,
                                ///< all photons in the sphere do
};

/// Estimates irradiance as Σ Φ K(r²/R²)/R² over the photons within R on the side that the normal faces. The kernel
/// is the same everywhere, so on a plane no energy is lost but at the borders.
///
/// ```cpp
/// const nephroid::FixedRange estimate(map, {.range = 0.02});
/// const float e = estimate(position, normal);
/// ```
template <Vector3 V, Flux F, class K = BiweightKernel, class C = WholeDisk>
    requires Kernel<K, scalar_t<V>> && detail::MustBeCoverage<C, V>
class FixedRange {
public:
    using T = scalar_t<V>;

    /// @param map       is referred to, and must outlive the estimate
    /// @param coverage  the share of the disk of radius R that lies on the surface (gather/coverage.hpp)
    /// Throws std::invalid_argument for a range that is not positive and finite and a normal distance that is not
    /// positive.
    FixedRange(const PhotonMap<V, F>& map, FixedRangeOptions options, K kernel = {}, C coverage = {})
        : map_(&map), range_(T(options.range)), thickness_(T(options.normal_distance * options.range)), kernel_(kernel),
          coverage_(std::move(coverage)) {
        detail::check_radius<T>("nephroid::FixedRange", "range", options.range, false);
        detail::check_positive("nephroid::FixedRange", "normal_distance", options.normal_distance, true);
    }
    FixedRange(const PhotonMap<V, F>&&, FixedRangeOptions, K = {}, C = {}) = delete; // would refer to a temporary

    /// The irradiance at a point of a surface; a position or normal that is not finite receives nothing.
    /// @param normal  unit; photons on the other side do not count
    [[nodiscard]] F operator()(const V& position, const V& normal) const {
        return (*this)(position, normal, detail::NoResponse{});
    }

    /// The same with each photon's irradiance times response(direction of flight): the BRDF; the sum is radiance.
    template <class Response>
    [[nodiscard]] F operator()(const V& position, const V& normal, const Response& response) const {
        F sum = flux_traits<F>::zero();
        const T scale = T(1) / (range_ * range_);
        const V relative = map_->tree().relative(position);
        detail::for_each_within(*map_, position, normal, range_, [&](std::size_t slot, T distance2) {
            if (thickness_ < range_ && !(abs(detail::height(*map_, slot, relative, normal)) < thickness_))
                return;
            detail::receive(sum, *map_, slot, kernel_(distance2 * scale) * scale, response);
        });
        return detail::over_coverage(coverage_, sum, position, normal, range_);
    }

private:
    const PhotonMap<V, F>* map_;
    T range_, thickness_;
    K kernel_;
    C coverage_;
};

} // namespace nephroid
