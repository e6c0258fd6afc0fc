// SPDX-License-Identifier: MIT
/// @file  Whether photons are splatted to first or to second order, and within which bounds.
#pragma once

#include "nephroid/vector/error.hpp"
#include "nephroid/vector/scalar.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace nephroid {

/// Bounds on what the rule may choose, in units of u0.
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

/// Photons are splatted where they land, all with the same smoothing [Frisvad et al. 2014].
struct FirstOrder {};

/// Photons are splatted where their bias cancels; without a smoothing given (`PhotonPass::smoothing`) each one's
/// footprint is chosen from the photons around it. The default.
struct SecondOrder {
    SmoothingBounds bounds{};
    double largest_shift =
        0.125; ///< of the longer of the footprint's new tangents, halved; longer ones are shortened, and
               ///< counted. Of it, what follows from footprints that change is a quarter at most
    std::uint64_t pilot = 1u << 16; ///< the field is made from the pass's first photons, this many at most, >= 1
    bool domain_repeats = false; ///< the scene repeats over the light's patch (a tile of endless water, say), so that
                                 ///< opposite borders of the patch are neighbours; of no effect on area lights
};

/// s where none is given: of first order, and of photons about which neither their neighbours say nor the others
/// together.
inline constexpr double default_smoothing = 8;

namespace detail {
/// Complains of what cannot be; bounds may be infinite where there is to be none.
///
/// @param who  the caller's name for the message
inline void check(const SecondOrder& order, const char* who) {
    const auto require = [who](bool holds, const char* name, const std::string& value, const char* rule) {
        if (!holds)
            invalid_argument(std::string(who) + ": SecondOrder: " + name + " is " + value + "; " + rule);
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
} // namespace detail

} // namespace nephroid
