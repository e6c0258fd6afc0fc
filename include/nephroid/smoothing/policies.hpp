// SPDX-License-Identifier: MIT
/// @file  Splatting to second order, within which bounds: the default policies.
#pragma once

#include "nephroid/splat/splat_policies.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace nephroid {

/// Bounds on the footprints that are chosen, in units of u0, the radius for which they cover the light's domain once.
struct SmoothingBounds {
    double least = 5;           ///< s: smaller footprints show photons
    double least_radius = 2;    ///< along any direction: a sequence is not stratified along thinner ones
    double largest_radius = 32; ///< along any direction: larger ones cost more than they bring. For more than 80,000
                                ///< photons it grows with their root: as large a part of the light's domain
    double stretch = 8;         ///< longest to shortest radius
};

/// The bounds for so many photons. A bound that did not grow with them would leave noise of random photons that more
/// of them do not mend.
[[nodiscard]] inline SmoothingBounds bounds_for(SmoothingBounds bounds, double photons) {
    bounds.largest_radius *= std::sqrt((std::max)(1.0, photons / 80000));
    return bounds;
}

/// Photons are splatted where their bias cancels; without a smoothing given (`PhotonPass::smoothing`) each one's
/// footprint is chosen from the photons around it. The default.
struct SecondOrder {
    static constexpr bool uses_neighbours = true;
    SmoothingBounds bounds{};
    double largest_shift =
        0.125; ///< of the longer of the footprint's new tangents, halved; longer ones are shortened, and
               ///< counted. Of it, what follows from footprints that change is a quarter at most
    std::uint64_t pilot = 1u << 16; ///< the field is made from the pass's first photons, this many at most, >= 1
    bool domain_repeats = false; ///< the scene repeats over the light's patch (a tile of endless water, say), so that
                                 ///< opposite borders of the patch are neighbours; of no effect on area lights
};

/// As SecondOrder, and photons around which the map bends are splatted in seven pieces: for sharp folds, and for scenes
/// where rays cost far more than splats. Who does not use it pays nothing.
struct CurvedFootprints : SecondOrder {
    /// Photons whose footprint bends by less than this part of its minor radius (the norm of the second derivatives
    /// along its semi-axes over that) stay one ellipse, >= 0
    double least_bend = 0.5;
};

/// What `caustics` does unless told otherwise: as `Published`, but to second order.
using Default =
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, DifferentialFootprint, SecondOrder>;

namespace detail {
/// Complains of what cannot be; bounds may be infinite where there is to be none.
///
/// @param caller  its name, for the message
inline void check(const SecondOrder& order, const char* caller) {
    const auto require = [caller](bool holds, const char* name, const std::string& value, const char* rule) {
        if (!holds)
            invalid_argument(std::string(caller) + ": SecondOrder: " + name + " is " + value + "; " + rule);
    };
    const SmoothingBounds& bounds = order.bounds;
    require(bounds.least > 0 && std::isfinite(bounds.least), "bounds.least", text_of(bounds.least),
            "it must be positive and finite");
    require(bounds.least_radius > 0 && std::isfinite(bounds.least_radius), "bounds.least_radius",
            text_of(bounds.least_radius), "it must be positive and finite");
    require(bounds.largest_radius >= bounds.least_radius, "bounds.largest_radius", text_of(bounds.largest_radius),
            "it must be at least bounds.least_radius");
    require(bounds.stretch >= 1, "bounds.stretch", text_of(bounds.stretch), "it must be at least 1");
    require(order.largest_shift >= 0, "largest_shift", text_of(order.largest_shift), "it must not be negative");
    require(order.pilot >= 1, "pilot", std::to_string(order.pilot), "it must be at least 1");
}

inline void check(const CurvedFootprints& order, const char* caller) {
    check(static_cast<const SecondOrder&>(order), caller);
    if (!(order.least_bend >= 0))
        invalid_argument(std::string(caller) + ": CurvedFootprints: least_bend is " + text_of(order.least_bend) +
                         "; it must not be negative");
}
} // namespace detail

} // namespace nephroid
