// SPDX-License-Identifier: MIT
/// @file  Diffusion-based photon mapping: kernels that smooth along the light's edges and not across.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/gather/gather.hpp"
#include "nephroid/vector/frame.hpp"

#include <limits>
#include <type_traits>

namespace nephroid {

struct DiffusionOptions {
    double range; ///< h > 0, world units: the kernels' radius along edges, and everywhere without any
    std::size_t gradient_count = 100; ///< photons that a gradient is estimated from, at most; >= 3
    double gradient_range = std::numeric_limits<double>::infinity(); ///< how far they may lie, world units, > 0
    double diffusivity = 0.4;  ///< C > 0: the square of the coherence from which on kernels narrow
    double least_ratio = 0.05; ///< α in (0, 1]: of the squares of a kernel's axes, where there is a sharp edge
};

/// Estimates irradiance as Σ Φ K(|M d|²) |M| over the photons within h on the side that the normal faces, where d
/// leads to the photon and the matrix M of each photon's own kernel follows from the light around it:
///
/// 1. the gradient of the irradiance E at the photon p, from the k nearest photons, by the derivative of the biweight
///    estimate: with r the distance of the k-th and u = d/r, ∇E ∝ Σ Φ (1 − u²) u and E ∝ Σ Φ (1 −
///    u²)²; g = r ∇E/E, 4 times the ratio of these sums, has no unit;
/// 2. the structure tensor S = Σ w g gᵀ/Σ w, smoothed over the same neighbours with w the biweight kernel, in p's
/// tangent
///    plane; eigenvalues μ₁ >= μ₂, the first one's vector across the edge;
/// 3. the coherence-enhancing diffusion tensor, with eigenvalues α across and α + (1 − α) exp(−C/(μ₁ −
/// μ₂)²) along
///    [Weickert 1999], divided by the latter, so that h alone says how wide kernels are: a disk of radius h where the
///    light is even or has no direction, √α h across a sharp edge;
/// 4. M maps that ellipse to the unit disk. ∫ K(|M d|²) |M| = 1 over the plane: no photon's light is lost.
///
/// At a sharp edge |g| is about 2. For photons at random in even light |g|² is 12/k on average, without a direction,
/// and S is smoothed over k of them: for k = 100 such coherences stay below an eighth, and the kernels near disks.
///
/// The best diffusivity is the scene's: 0.1 where a caustic is all folds and cusps, 1.6 and more (nearly disks) where
/// light changes smoothly, as kernels that narrow on a mere slope gain noise and no sharpness. With 0.4 20,000 random
/// photons are off by 1.1 to 1.2 times the rel of the best of 0.1, 0.4, 1.6 (ring-zoom, wave-prefocal).
///
/// Source: Schjøth, Olsen and Sporring 2008, as Frisvad et al. 2014 describe it (their h, the gradient's radius and
/// number of photons, a diffusivity); the formulas above are nephroid's choice where that description leaves them open.
///
/// ```cpp
/// const nephroid::DiffusionEstimate estimate(map, {.range = 0.02}, nephroid::BiweightKernel{}, executor);
/// const float e = estimate(position, normal);
/// ```
template <Vector3 V, Flux F, class K = BiweightKernel>
    requires Kernel<K, scalar_t<V>>
class DiffusionEstimate {
public:
    using T = scalar_t<V>;

    /// Two look-ups for every photon.
    /// @param map       is referred to, and must outlive the estimate
    /// @param executor  who runs the work; the result does not depend on it
    /// Throws std::invalid_argument for options out of their ranges.
    template <ExecutorArgument E = SerialExecutor>
    DiffusionEstimate(const PhotonMap<V, F>& map, DiffusionOptions options, K kernel = {}, E&& executor = E{})
        : map_(&map), options_(options), kernel_(kernel) {
        check(options);
        std::vector<V> gradients(map.tree().slots(), zero_vector<V>());
        for_each_photon(executor, [&](std::size_t slot) { gradients[slot] = gradient_at(slot); });
        edges_.assign(map.tree().slots(), Edge{zero_vector<V>(), T(0)});
        for_each_photon(executor, [&](std::size_t slot) { edges_[slot] = edge_at(slot, gradients); });
        shape_kernels();
    }
    template <ExecutorArgument E = SerialExecutor>
    DiffusionEstimate(const PhotonMap<V, F>&&, DiffusionOptions, K = {}, E&& = E{}) = delete; // refers to a temporary

    /// Goes on with other kernels along the edges found already, at no look-up: for trying several.
    /// @param options  its range, diffusivity and least_ratio; how gradients are estimated stays as it was
    /// Throws std::invalid_argument for options out of their ranges.
    void retune(const DiffusionOptions& options) {
        check(options);
        options_.range = options.range;
        options_.diffusivity = options.diffusivity;
        options_.least_ratio = options.least_ratio;
        shape_kernels();
    }

    /// The irradiance at a point of a surface; a position or normal that is not finite receives nothing.
    /// @param normal  unit; photons on the other side do not count
    [[nodiscard]] F operator()(const V& position, const V& normal) const {
        return (*this)(position, normal, detail::NoResponse{});
    }

    /// The same with each photon's irradiance times response(direction of flight): the BRDF; the sum is radiance.
    template <class Response>
    [[nodiscard]] F operator()(const V& position, const V& normal, const Response& response) const {
        F sum = flux_traits<F>::zero();
        const T scale = T(1) / square(T(options_.range));
        const V place = map_->tree().relative(position);
        detail::for_each_within(*map_, position, normal, T(options_.range), [&](std::size_t slot, T distance2) {
            const Shape& shape = shapes_[slot];
            const T across = dot(edges_[slot].across, V(point(slot) - place));
            const T radius2 = (distance2 + shape.stretch * across * across) * scale;
            detail::receive(sum, *map_, slot, kernel_(radius2) * shape.density * scale, response);
        });
        return sum;
    }

    /// The ratio of a photon's kernel's axes, across over along the edge, by slot of the map's tree: 1 is a disk.
    [[nodiscard]] T axis_ratio(std::size_t slot) const { return T(1) / shapes_[slot].density; }

private:
    /// What the structure tensor says of the light about a photon.
    struct Edge {
        V across;    ///< unit, in the tangent plane
        T coherence; ///< μ₁ − μ₂
    };
    /// A photon's kernel: |M d|² h² = d² + stretch (across · d)², for d in the tangent plane.
    struct Shape {
        T stretch; ///< 1/ratio − 1, for the ratio of the squares of the axes
        T density; ///< 1/sqrt(ratio): how much a disk's area shrinks by
    };

    static void check(const DiffusionOptions& options) {
        constexpr const char* who = "nephroid::DiffusionEstimate";
        detail::check_length(who, "range", options.range, false);
        detail::check_length(who, "gradient_range", options.gradient_range, true);
        if (options.gradient_count < 3)
            invalid_argument(std::string(who) + ": gradient_count is " + std::to_string(options.gradient_count) +
                             "; it must be at least 3");
        if (!(options.diffusivity > 0))
            invalid_argument(std::string(who) + ": diffusivity is " + detail::text_of(options.diffusivity) +
                             "; it must be positive");
        if (!(options.least_ratio > 0 && options.least_ratio <= 1))
            invalid_argument(std::string(who) + ": least_ratio is " + detail::text_of(options.least_ratio) +
                             "; it must be in (0, 1]");
    }

    template <class E, class Task>
    void for_each_photon(E& executor, const Task& task) const {
        const auto leaves = map_->tree().leaves();
        executor(leaves.size(), [&](std::size_t number) {
            const TreeLeaf leaf = leaves[number];
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                task(slot);
        });
    }

    [[nodiscard]] V point(std::size_t slot) const {
        const PointTree<V>& tree = map_->tree();
        return make_vector<V>(tree.x()[slot], tree.y()[slot], tree.z()[slot]);
    }

    /// Calls use(slot, offset over the radius of the neighbourhood, in the tangent plane, and its square) for the
    /// photons about one.
    template <class Use>
    void for_each_neighbour(std::size_t of, Use&& use) const {
        const V centre = point(of), normal = map_->normal(of);
        const std::span<Neighbour<T>> room =
            detail::neighbours<T>((std::min)(options_.gradient_count, map_->tree().slots()));
        const std::size_t count = map_->tree().nearest(centre, room, square(T(options_.gradient_range)),
                                                       [&](std::size_t slot) { return map_->faces(slot, normal); });
        T radius2(0);
        for (std::size_t i = 0; i < count; ++i)
            radius2 = (std::max)(radius2, room[i].distance2);
        if (!(radius2 > T(0)))
            return;
        const T scale = T(1) / sqrt(radius2);
        for (std::size_t i = 0; i < count; ++i) {
            const V offset = scale * (point(room[i].slot) - centre);
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

    [[nodiscard]] Edge edge_at(std::size_t slot, const std::vector<V>& gradients) const {
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

    void shape_kernels() {
        const T least = T(options_.least_ratio);
        shapes_.clear();
        shapes_.reserve(edges_.size());
        for (const Edge& edge : edges_) {
            using std::exp;
            const T coherence2 = square(edge.coherence);
            const T growth = coherence2 > T(0) ? T(exp(-T(options_.diffusivity) / coherence2)) : T(0);
            const T ratio = least / (least + (T(1) - least) * growth);
            shapes_.push_back({T(1) / ratio - T(1), T(1) / sqrt(ratio)});
        }
    }

    const PhotonMap<V, F>* map_;
    DiffusionOptions options_;
    K kernel_;
    std::vector<Edge> edges_;   // by slot
    std::vector<Shape> shapes_; // by slot
};

} // namespace nephroid
