// SPDX-License-Identifier: MIT
/// @file  Policies for a photon's footprint: from its differential, or a disk of fixed radius.
#pragma once

#include "nephroid/footprint/ellipse.hpp"
#include "nephroid/transport/deposit.hpp"

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <optional>

namespace nephroid {

/// The footprint is the photon differential's [Frisvad et al. 2014]. The default.
struct DifferentialFootprint {
    template <Vector3 V, Flux F, std::size_t N>
        requires(N >= 2)
    [[nodiscard]] std::optional<Ellipse<V>> operator()(const Deposit<V, F, N>& deposit) const {
        if (!std::all_of(deposit.d_position.begin(), deposit.d_position.end(),
                         [](const V& d) { return all_finite(d); }))
            return std::nullopt;
        return footprint(deposit.d_position, deposit.normal);
    }
};

/// The footprint is a disk of this radius, the same for every photon: splatting with a fixed bandwidth, which needs no
/// differentials (`WithoutTangents`).
/// Source: Lavignotte and Paulin 2003, as Frisvad et al. 2014 compare with it.
struct FixedFootprint {
    double radius; ///< world units, > 0
    template <Vector3 V, Flux F, std::size_t N>
    [[nodiscard]] std::optional<Ellipse<V>> operator()(const Deposit<V, F, N>& deposit) const {
        const Frame<V> frame = frame_about(deposit.normal);
        return Ellipse<V>{scalar_t<V>(radius) * frame.u, scalar_t<V>(radius) * frame.v, deposit.normal};
    }
};

namespace detail {
/// `shape(deposit)` returns the photon's footprint, or nothing if it is not an ellipse.
template <class P, class D, class V>
concept ShapesFootprint = requires(const P shape, const D& deposit) {
    { shape(deposit) } -> std::same_as<std::optional<Ellipse<V>>>;
};
} // namespace detail

} // namespace nephroid
