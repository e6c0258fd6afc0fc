// SPDX-License-Identifier: MIT
/// @file  A radius, or a smoothing, that shrinks from pass to pass, so that the mean of all passes converges.
#pragma once

#include "nephroid/gather/check_radius.hpp"

#include <cmath>
#include <string>

namespace nephroid {

namespace detail {
inline void check_alpha(const char* who, double alpha) {
    if (!(alpha > 0 && alpha <= 1))
        invalid_argument(std::string(who) + ": alpha is " + text_of(alpha) + "; it must be in (0, 1], and below 1 " +
                         "for the radius to shrink");
}
} // namespace detail

struct ShrinkingRadiusOptions {
    double radius; ///< of the first pass, > 0: world units, or a smoothing
    /// In (0, 1]: the fraction of a pass's photons that is kept as the radius shrinks. The error falls fastest for 2/3.
    double alpha = 2.0 / 3;
};

/// The radius of each pass, the same for every vertex: r² ← r² (i + α)/(i + 1) after pass i = 1, 2, …, so that
/// r² falls like i^(α−1). The bias of the mean over the passes falls like that too, and its variance like
/// i^(−α).
///
/// With FixedRange, a map for each pass and estimates averaged over the passes, this is progressive photon mapping
/// without statistics [Knaus and Zwicker 2011]. A photon's footprint is as wide as its smoothing s, so the same
/// sequence of s makes photon differential splatting progressive, without any photon map:
///
/// ```cpp
/// nephroid::ShrinkingRadius s({.radius = 10});
/// for (std::uint64_t i = 0; i < passes; ++i, s.advance())
///     nephroid::splat_caustics(scene, light, sums, {.first = i * n, .count = n, .smoothing = s.radius()});
/// // the sums over `passes` are the picture
/// ```
class ShrinkingRadius {
public:
    /// Throws std::invalid_argument for a radius that is not positive and finite and an α outside of (0, 1].
    explicit ShrinkingRadius(ShrinkingRadiusOptions options)
        : radius2_(options.radius * options.radius), alpha_(options.alpha) {
        detail::check_radius<double>("nephroid::ShrinkingRadius", "radius", options.radius, false);
        detail::check_alpha("nephroid::ShrinkingRadius", options.alpha);
    }

    /// Of the current pass.
    [[nodiscard]] double radius() const { return std::sqrt(radius2_); }
    /// Goes on to the next pass.
    void advance() {
        ++pass_;
        radius2_ *= (pass_ + alpha_) / (pass_ + 1);
    }

private:
    double radius2_, alpha_;
    double pass_ = 0; ///< passes done
};

} // namespace nephroid
