// SPDX-License-Identifier: MIT
/// @file  Curved footprints: a splat that bends as the map bends, made of pieces that are ellipses.
///
/// Around a photon the map is F(u) = F + J u + ½ H u u. The photon lights the image of a disk under it, and at a fold
/// this is far from an ellipse. Seven pieces of half the disk's radius, one in its middle and six half way to its edge,
/// are splatted where the map takes them, each with the map's tangents there. Their mean is the centre of the single
/// splat, shift included. On a straight map their second and fourth moments are those of a single biweight, and they
/// reach as far.
#pragma once

#include "nephroid/footprint/ellipse.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/smoothing/second_order/policies.hpp"
#include "nephroid/transport/deposit.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace nephroid::detail {

/// A disk of half the radius of the unit disk.
struct DiskPiece {
    Plane2 centre;
    double weight; ///< part of the flux
};

/// Seven biweights with these centres and weights have the second and fourth moments of a single biweight; no other
/// weights and radii of a hexagon with a middle do. The weights are powers of two and add up to exactly 1.
inline constexpr std::array<DiskPiece, 7> disk_pieces = [] {
    constexpr double h = 0.43301270189221932338; // √3/4
    return std::array<DiskPiece, 7>{{{{0, 0}, 0.25},
                                     {{0.5, 0}, 0.125},
                                     {{0.25, h}, 0.125},
                                     {{-0.25, h}, 0.125},
                                     {{-0.5, 0}, 0.125},
                                     {{-0.25, -h}, 0.125},
                                     {{0.25, -h}, 0.125}}};
}();

/// A deposit in pieces.
template <Vector3 V, Flux F, std::size_t N>
struct CurvedDeposit {
    std::array<Deposit<V, F, N>, disk_pieces.size()> all;
    std::size_t count; ///< how many of them to splat: all, or only the first, which is then the whole deposit

    [[nodiscard]] std::span<const Deposit<V, F, N>> pieces() const { return {all.data(), count}; }
};

/// Splits a deposit into pieces if its footprint bends.
///
/// @param deposit        with its final tangents and position
/// @param second         second derivatives of the map by the half tangents, along the surface
/// @param second_moment  of the kernel
template <Vector3 V, Flux F, std::size_t N>
[[nodiscard]] CurvedDeposit<V, F, N> curved(const Deposit<V, F, N>& deposit, const std::array<Double3, 3>& second,
                                            const CurvedFootprints& policy, double second_moment) {
    using T = scalar_t<V>;
    CurvedDeposit<V, F, N> result;
    result.all[0] = deposit;
    result.count = 1;
    const double minor = double(radii(footprint(deposit.d_position[0], deposit.d_position[1], deposit.normal)).minor);
    const double bend2 = inner(second[0], second[0]) + 2 * inner(second[1], second[1]) + inner(second[2], second[2]);
    if (!(bend2 > square(policy.least_bend * minor)) || !std::isfinite(bend2))
        return result;

    result.count = disk_pieces.size();
    constexpr double of_centres = 3.0 / 32; // their variance; a quarter of a biweight's own makes up the rest of 1/8
    const double size = std::sqrt(second_moment / (of_centres + 0.25 * second_moment));
    const Double3 mean = (0.5 * square(size) * of_centres) * (second[0] + second[2]);
    for (std::size_t i = 0; i < result.count; ++i) {
        const Plane2 q = size * disk_pieces[i].centre;
        const Double3 by_u = q.x * second[0] + q.y * second[1], by_v = q.x * second[1] + q.y * second[2];
        Deposit<V, F, N>& piece = result.all[i];
        piece = deposit;
        piece.flux = static_cast<F>(deposit.flux * T(disk_pieces[i].weight));
        piece.position = deposit.position +
                         (T(0.5 * q.x) * deposit.d_position[0] + T(0.5 * q.y) * deposit.d_position[1]) +
                         to_world<V>(0.5 * (q.x * by_u + q.y * by_v) - mean);
        const T radius = T(0.5 * size);
        piece.d_position[0] = radius * (deposit.d_position[0] + to_world<V>(2 * by_u));
        piece.d_position[1] = radius * (deposit.d_position[1] + to_world<V>(2 * by_v));
        for (std::size_t a = 2; a < N; ++a)
            piece.d_position[a] = radius * deposit.d_position[a];
    }
    return result;
}

} // namespace nephroid::detail
