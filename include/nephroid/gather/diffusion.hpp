// SPDX-License-Identifier: MIT
/// @file  Diffusion-based photon mapping: kernels that smooth along the light's edges and not across.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/gather/gather.hpp"
#include "nephroid/gather/light_edges.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace nephroid {

struct DiffusionOptions {
    double range; ///< h > 0, world units: the kernels' radius along edges, and everywhere without any
    std::size_t gradient_count = 100; ///< photons that a gradient is estimated from, at most; >= 3
    double gradient_range = std::numeric_limits<double>::infinity(); ///< how far they may lie, world units, > 0
    double diffusivity = 0.4;  ///< C > 0: kernels narrow where the square of the coherence is about this or more
    double least_ratio = 0.05; ///< α in (0, 1]: ratio of the squares of a kernel's axes at a sharp edge
};

/// Estimates irradiance as Σ Φ K(|M d|²) |M| over the photons within h on the side that the normal faces, where d
/// leads to the photon and each photon has a matrix M of its own.
///
/// M maps an ellipse to the unit disk: a disk of radius h where the light is even or has no direction, narrowed to
/// √α h across a sharp edge. The squares of its axes have the ratio α/(α + (1 − α) exp(−C/c²)), with c the
/// coherence of the edge at the photon (light_edges.hpp): coherence-enhancing diffusion [Weickert 1999]. ∫ K(|M d|²)
/// |M| = 1 over the plane, so no photon's light is lost.
///
/// The best diffusivity depends on the scene: 0.1 where a caustic is all folds and cusps, 1.6 and more (nearly disks)
/// where light changes smoothly. 0.4 is within 1.2 times the error of the best of these on both kinds.
///
/// Source: Schjøth, Olsen and Sporring 2008, as Frisvad et al. 2014 describe it; the formulas are ours where that
/// description leaves them open [include/nephroid/README.md, "Diffusion"].
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

    /// Takes two look-ups for every photon.
    /// @param map       is referred to, and must outlive the estimate
    /// @param executor  who runs the work; the result does not depend on it
    /// Throws std::invalid_argument for options out of their ranges.
    template <ExecutorArgument E = SerialExecutor>
    DiffusionEstimate(const PhotonMap<V, F>& map, DiffusionOptions options, K kernel = {}, E&& executor = E{})
        : map_(&map), options_(options), kernel_(kernel) {
        check(options);
        edges_ = detail::EdgeFinder<V, F>(map, options.gradient_count, options.gradient_range).find(executor);
        shape_kernels();
    }
    template <ExecutorArgument E = SerialExecutor>
    DiffusionEstimate(const PhotonMap<V, F>&&, DiffusionOptions, K = {}, E&& = E{}) = delete; // refers to a temporary

    /// Changes the kernels and keeps the edges, without any look-up: for trying several.
    /// @param options  its range, diffusivity and least_ratio are used; those of gradients stay as they were
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
        const V relative = map_->tree().relative(position);
        detail::for_each_within(*map_, position, normal, T(options_.range), [&](std::size_t slot, T distance2) {
            const Shape& shape = shapes_[slot];
            const T across = dot(edges_[slot].across, V(detail::point(*map_, slot) - relative));
            const T radius2 = (distance2 + shape.stretch * across * across) * scale;
            detail::receive(sum, *map_, slot, kernel_(radius2) * shape.density * scale, response);
        });
        return sum;
    }

    /// The ratio of the axes of a photon's kernel, across over along the edge, by slot of the map's tree: 1 is a disk.
    [[nodiscard]] T axis_ratio(std::size_t slot) const { return T(1) / shapes_[slot].density; }

private:
    /// A photon's kernel: |M d|² h² = d² + stretch (across · d)², for d in the tangent plane.
    struct Shape {
        T stretch; ///< 1/ratio − 1, for the ratio of the squares of the axes
        T density; ///< 1/sqrt(ratio): the area of the disk over that of the kernel
    };

    static void check(const DiffusionOptions& options) {
        constexpr const char* who = "nephroid::DiffusionEstimate";
        detail::check_radius<T>(who, "range", options.range, false);
        detail::check_radius<T>(who, "gradient_range", options.gradient_range, true);
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

    void shape_kernels() {
        const T least = T(options_.least_ratio);
        shapes_.clear();
        shapes_.reserve(edges_.size());
        for (const detail::LightEdge<V>& edge : edges_) {
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
    std::vector<detail::LightEdge<V>> edges_; // by slot
    std::vector<Shape> shapes_;               // by slot
};

} // namespace nephroid
