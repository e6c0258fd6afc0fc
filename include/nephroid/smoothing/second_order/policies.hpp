// SPDX-License-Identifier: MIT
/// @file  The policies of second-order splatting, with their bounds, and the default preset.
#pragma once

#include "nephroid/splat/splat_policies.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace nephroid {

/// Bounds of the footprints that are chosen, in units of u0. With a radius of u0, all footprints together cover the
/// light's domain once.
struct SmoothingBounds {
    double least = 5;           ///< lower bound of s, > 0: smaller footprints show single photons
    double least_radius = 2;    ///< in any direction, > 0: photons are not stratified across thinner ones
    double largest_radius = 32; ///< in any direction, >= least_radius: larger footprints cost more than they gain. For
                                ///< more than 80,000 photons it grows with their square root, as a constant part of
                                ///< the light's domain
    double stretch = 8;         ///< upper bound of the longest over the shortest radius, >= 1
};

/// The bounds for a number of photons. If `largest_radius` did not grow, the noise of random photons would not fall
/// any further with more of them.
[[nodiscard]] inline SmoothingBounds bounds_for(SmoothingBounds bounds, double photons) {
    bounds.largest_radius *= std::sqrt((std::max)(1.0, photons / 80000));
    return bounds;
}

/// Shifts photons so that their bias cancels. If no smoothing is given (`PhotonPass::smoothing`), it also chooses each
/// photon's footprint from the photons around it. This is the default.
struct SecondOrder {
    static constexpr bool uses_neighbours = true;
    SmoothingBounds bounds{};
    double largest_shift = 0.125; ///< over the longer half tangent of the new footprint, >= 0; longer ones are cut and
                                  ///< counted (`Statistics::bounded_shifts`). The part of the shift due to footprints
                                  ///< that change is limited to a quarter of the footprint as well
    /// How far neighbours may land from where fitted tangents predict, over the distance that the tangents' lengths
    /// predict, >= 0. If many of a path's cells miss by more, as on facets, its photons are splatted as published and
    /// counted (`Statistics::splatted_as_published`). Lamps with area are splatted so too, unless pictures of the pilot
    /// say that other footprints are better. Infinity: never; nor if the pass gives a smoothing or the domain repeats.
    double largest_miss = 0.1;
    /// How many of the pass's first photons the footprints are chosen from, >= 1. For lamps with area as many again are
    /// traced to judge them by, at least 16,384, which are not in the picture.
    std::uint64_t pilot = 1u << 16;
    bool domain_repeats = false; ///< whether the scene repeats over the light's patch (a tile of endless water, say),
                                 ///< so that opposite borders of the patch are neighbours; has no effect on area lights
};

/// As SecondOrder, but photons around which the map bends are splatted in seven pieces: for sharp folds, and for scenes
/// in which rays cost far more than splats. Programs that do not use it do not compile it.
struct CurvedFootprints : SecondOrder {
    /// Footprints stay one ellipse if they bend by less than this part of their minor radius, >= 0. (The bend is the
    /// norm of the second derivatives along the semi-axes.)
    double least_bend = 0.5;
};

/// The preset that `caustics` uses unless another is given: as `Published`, but to second order.
using Default =
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, DifferentialFootprint, SecondOrder>;

namespace detail {
/// Throws std::invalid_argument for options that make no sense. An upper bound may be infinite.
///
/// @param caller  name of the calling function, for the message
NEPHROID_NOINLINE inline void check(const SecondOrder& order, const char* caller) {
    const auto require = [caller](bool holds, const char* name, double value, const char* rule) {
        if (!holds)
            invalid_argument(std::string(caller) + ": SecondOrder: " + name + " is " + text_of(value) + "; " + rule);
    };
    const SmoothingBounds& bounds = order.bounds;
    require(bounds.least > 0 && std::isfinite(bounds.least), "bounds.least", bounds.least,
            "it must be positive and finite");
    require(bounds.least_radius > 0 && std::isfinite(bounds.least_radius), "bounds.least_radius", bounds.least_radius,
            "it must be positive and finite");
    require(bounds.largest_radius >= bounds.least_radius, "bounds.largest_radius", bounds.largest_radius,
            "it must be at least bounds.least_radius");
    require(bounds.stretch >= 1, "bounds.stretch", bounds.stretch, "it must be at least 1");
    require(order.largest_shift >= 0, "largest_shift", order.largest_shift, "it must not be negative");
    require(order.largest_miss >= 0, "largest_miss", order.largest_miss, "it must not be negative");
    require(order.pilot >= 1, "pilot", double(order.pilot), "it must be at least 1");
}

inline void check(const CurvedFootprints& order, const char* caller) {
    check(static_cast<const SecondOrder&>(order), caller);
    if (!(order.least_bend >= 0))
        invalid_argument(std::string(caller) + ": CurvedFootprints: least_bend is " + text_of(order.least_bend) +
                         "; it must not be negative");
}
} // namespace detail

} // namespace nephroid
