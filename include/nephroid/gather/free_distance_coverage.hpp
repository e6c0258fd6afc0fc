// SPDX-License-Identifier: MIT
/// @file  The coverage of estimates from stored photons by the free distances about eye path vertices.
#pragma once

#include "nephroid/gather/coverage.hpp"
#include "nephroid/receiver/free_distances.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace nephroid {

/// The share of a kernel's weight by the free distances about the nearest eye path vertex: for walls and edges as the
/// renderer's own rays find them, but at least a twentieth. For estimates at or near the vertices.
///
/// Share and estimate count what is turned by less than 60° from the normal. The share ends at walls and steps, but an
/// estimate goes by distance alone: beside a thin screen the photons of both rooms count over the share of one room, so
/// that the estimate is too bright. `splat_global` asks the free distances for each photon instead.
///
/// ```cpp
/// const nephroid::FreeDistances distances(map, scene);
/// const nephroid::FixedRange estimate(photons, {.range = 0.3}, nephroid::BiweightKernel{},
///                                     nephroid::FreeDistanceCoverage{distances, nephroid::BiweightKernel{}});
/// ```
template <class V, class K = BiweightKernel>
class FreeDistanceCoverage {
public:
    using T = scalar_t<V>;

    /// @param distances  kept by reference; must outlive the coverage
    /// @param kernel     the estimate's
    explicit FreeDistanceCoverage(const FreeDistances<V>& distances, K kernel = {})
        : distances_(&distances), kernel_(kernel) {}
    explicit FreeDistanceCoverage(const FreeDistances<V>&&, K = {}) = delete; // would refer to a temporary

    [[nodiscard]] T operator()(const V& position, const V& normal, T radius) const {
        using t = vector_traits<V>;
        const EyePathMap<V>& map = distances_->map();
        const auto faces = [&](std::size_t slot) {
            return map.normal_x()[slot] * t::x(normal) + map.normal_y()[slot] * t::y(normal) +
                       map.normal_z()[slot] * t::z(normal) >
                   T(detail::one_surface_cosine);
        };
        std::array<Neighbour<T>, 1> nearest;
        const std::size_t found =
            map.tree().nearest(map.tree().relative(position), nearest, std::numeric_limits<T>::infinity(), faces);
        return found > 0 ? (std::max)(T(detail::least_coverage), distances_->coverage(nearest[0].slot, radius, kernel_))
                         : T(1);
    }

private:
    const FreeDistances<V>* distances_;
    K kernel_;
};

} // namespace nephroid
