// SPDX-License-Identifier: MIT
/// @file  How dense photons are to be: what relaxation evens out is the noise about that, not the caustic itself.
///
/// Repulsion alone comes to rest where all photons are equally far apart, so it does to a caustic's densities what
/// diffusion does: 20 iterations blur a map as if its 300 nearest photons had been averaged. With distances measured
/// in units of the spacing that the density in that place asks for, it comes to rest at that density. The density is
/// a pilot estimate from many neighbours, as for adaptive kernels [Abramson 1982]; what the pilot itself has blurred
/// is not lost, for the photons' density over the pilot's is evened out over a few spacings only, as by
/// multiplicative bias correction [Jones, Linton and Nielsen 1995].
#pragma once

#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/repulsion.hpp"

#include <algorithm>
#include <span>
#include <vector>

namespace nephroid {

template <class Cloud>
class TargetSpacing {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    /// One look-up for every photon.
    ///
    /// @param neighbours   of the pilot estimate, an Epanechnikov kernel that reaches to the last of them
    /// @param constraints  by slot, or empty: near a feature a pilot sees both of its sides, and is trusted less
    template <class E>
    TargetSpacing(const Cloud& cloud, std::size_t neighbours, std::span<const PhotonConstraint<V>> constraints,
                  E& executor)
        : pilots_(cloud.tree().slots(), Pilot{T(1), T(0)}) {
        detail::for_each_leaf<std::vector<Neighbour<T>>>(cloud.tree(), executor, [&](auto& crowd, std::uint32_t leaf) {
            const TreeLeaf range = cloud.tree().leaves()[leaf];
            for (std::size_t slot = range.first; slot < range.first + range.size; ++slot) {
                detail::nearest_on_surface(cloud, slot, neighbours, crowd);
                pilots_[slot] = pilot(crowd, constraints);
            }
        });
    }

    /// The factor on the squared distance between two photons that measures it in units of the spacing in the middle
    /// between them, times that at the first: > 0. For a field of densities ρ it is sqrt(ρ₂/ρ₁).
    [[nodiscard]] T factor(std::size_t first, std::size_t second) const {
        const Pilot &a = pilots_[first], &b = pilots_[second];
        return T(1) + a.trust * b.trust * (std::clamp(b.root_density / a.root_density, T(1) / most, most) - T(1));
    }

private:
    struct Pilot {
        T root_density; ///< square root of photons per area; > 0
        T trust;        ///< 0 at a feature, 1 away from any
    };

    static constexpr T most = T(8); ///< ratio of roots of densities of neighbours: beyond, one pilot is an accident
    static constexpr std::size_t fewest = 16; ///< photons, whose density says little
    /// The share of held photons in a neighbourhood, by weight, from which on its pilot is not trusted at all. A
    /// straight feature through the middle, in a band of 1.5 mean distances to each side, makes it 0.23: a quarter of
    /// the trust is left. Measured: with 0.1 soft slopes that pass for features are evened out, and with no limit edges
    /// become 1.5 to 1.8 times as wide, with this one 1% wider.
    static constexpr T held_at_feature = T(0.3);

    [[nodiscard]] static Pilot pilot(std::span<const Neighbour<T>> crowd,
                                     std::span<const PhotonConstraint<V>> constraints) {
        T radius2(0), weights(0), held(0);
        for (const Neighbour<T>& other : crowd)
            radius2 = (std::max)(radius2, other.distance2);
        if (crowd.size() < fewest || !(T(1) / radius2 > T(0)) || !isfinite(T(1) / radius2))
            return {T(1), T(0)}; // too few, or all in one place
        for (const Neighbour<T>& other : crowd) {
            const T weight = T(1) - other.distance2 / radius2;
            weights = weights + weight;
            if (!constraints.empty())
                held = held + weight * constraints[other.slot].weight;
        }
        return {sqrt(weights / radius2), (std::max)(T(0), T(1) - held / (held_at_feature * weights))};
    }

    std::vector<Pilot> pilots_; // by slot
};

} // namespace nephroid
