// SPDX-License-Identifier: MIT
/// @file  The edges of light at stored photons: which way the irradiance changes there, and how uniformly.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/gather/gather.hpp"
#include "nephroid/vector/frame.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace nephroid::detail {

/// How the light changes around one photon.
template <Vector3 V>
struct LightEdge {
    V across;              ///< unit, in the tangent plane: the direction in which it changes most
    scalar_t<V> coherence; ///< >= 0: 0 where it is even or changes in all directions alike
};

/// Finds the edge of light at each photon of a map, from the k nearest photons:
///
/// 1. the gradient of the irradiance E, by the derivative of the biweight estimate: with r the distance of the k-th and
///    u = d/r, ∇E ∝ Σ Φ (1 − u²) u and E ∝ Σ Φ (1 − u²)²; g = r ∇E/E, 4 times the ratio of these
///    sums, has no unit;
/// 2. the structure tensor S = Σ w g gᵀ/Σ w in the photon's tangent plane, over the same neighbours with w the
///    biweight kernel; `across` is the eigenvector of its larger eigenvalue, `coherence` the difference of the two.
///
/// Source: Schjøth, Olsen and Sporring 2008, as Frisvad et al. 2014 describe it; the formulas are ours.
template <Vector3 V, Flux F>
class EdgeFinder {
public:
    using T = scalar_t<V>;

    /// @param map    is referred to
    /// @param count  k: photons that a gradient is estimated from, at most
    /// @param range  how far they may lie, world units
    EdgeFinder(const PhotonMap<V, F>& map, std::size_t count, double range)
        : map_(&map), count_(count), range_(range) {}

    /// Two look-ups for every photon.
    /// @return  by slot of the map's tree
    template <class E>
    [[nodiscard]] std::vector<LightEdge<V>> find(E& executor) const {
        std::vector<V> gradients(map_->tree().slots(), zero_vector<V>());
        for_each_photon(executor, [&](std::size_t slot) { gradients[slot] = gradient_at(slot); });
        std::vector<LightEdge<V>> edges(map_->tree().slots(), {zero_vector<V>(), T(0)});
        for_each_photon(executor, [&](std::size_t slot) { edges[slot] = edge_at(slot, gradients); });
        return edges;
    }

private:
    template <class E, class Task>
    void for_each_photon(E& executor, const Task& task) const {
        const auto leaves = map_->tree().leaves();
        executor(leaves.size(), [&](std::size_t number) {
            const TreeLeaf leaf = leaves[number];
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                task(slot);
        });
    }

    /// Calls use(slot, offset in the tangent plane over the radius of the neighbourhood, its square) for the photons
    /// around one.
    template <class Use>
    void for_each_neighbour(std::size_t of, Use&& use) const {
        const V centre = point(*map_, of), normal = map_->normal(of);
        const std::span<Neighbour<T>> room = neighbours<T>((std::min)(count_, map_->tree().slots()));
        const std::size_t found = map_->tree().nearest(centre, room, square(T(range_)),
                                                       [&](std::size_t slot) { return map_->faces(slot, normal); });
        T radius2(0);
        for (std::size_t i = 0; i < found; ++i)
            radius2 = (std::max)(radius2, room[i].distance2);
        if (!(radius2 > T(0)))
            return;
        const T scale = T(1) / sqrt(radius2);
        for (std::size_t i = 0; i < found; ++i) {
            const V offset = scale * (point(*map_, room[i].slot) - centre);
            const V flat = offset - dot(offset, normal) * normal;
            use(std::size_t(room[i].slot), flat, length2(flat));
        }
    }

    /// r ∇E/E, without unit.
    [[nodiscard]] V gradient_at(std::size_t slot) const {
        V slope = zero_vector<V>();
        T level(0);
        for_each_neighbour(slot, [&](std::size_t other, const V& offset, T u2) {
            const T flux = T(flux_traits<F>::power(map_->flux(other))), rest = (std::max)(T(0), T(1) - u2);
            slope = slope + (flux * rest) * offset;
            level = level + flux * rest * rest;
        });
        return level > T(0) ? V(T(4) / level * slope) : zero_vector<V>();
    }

    [[nodiscard]] LightEdge<V> edge_at(std::size_t slot, const std::vector<V>& gradients) const {
        const Frame<V> frame = frame_about(map_->normal(slot));
        T uu(0), uv(0), vv(0), total(0);
        for_each_neighbour(slot, [&](std::size_t other, const V&, T u2) {
            const T weight = square((std::max)(T(0), T(1) - u2));
            const T u = dot(gradients[other], frame.u), v = dot(gradients[other], frame.v);
            uu = uu + weight * u * u;
            uv = uv + weight * u * v;
            vv = vv + weight * v * v;
            total = total + weight;
        });
        const T coherence = total > T(0) ? sqrt(square(uu - vv) + square(T(2) * uv)) / total : T(0);
        if (!(coherence > T(0)))
            return {frame.u, T(0)};
        using std::atan2;
        const T phi = T(0.5) * atan2(T(2) * uv, uu - vv);
        return {cos(phi) * frame.u + sin(phi) * frame.v, coherence};
    }

    const PhotonMap<V, F>* map_;
    std::size_t count_;
    double range_;
};

} // namespace nephroid::detail
