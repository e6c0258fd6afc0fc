// SPDX-License-Identifier: MIT
/// @file  Policies for footprints that are too thin or too long, chosen at compile time.
///
/// A policy is called with the footprint before it is splatted and may change it or ask for its photon to be
/// discarded; both are counted. A policy that is not chosen is not compiled.
#pragma once

#include "nephroid/footprint/ellipse.hpp"

namespace nephroid {

/// What a policy decided about a footprint.
enum class Verdict : unsigned char { kept, bounded, discarded };

/// A policy: `policy(ellipse, limit)` may change the ellipse. `limit` is a length in world units. A collapse policy
/// gets the local spacing of the eye path vertices, an excess policy the diagonal of their bounds.
///
/// ```cpp
/// struct DiscardNeedles { // an excess policy: no footprint 100 times as long as wide
///     template <nephroid::Vector3 V>
///     nephroid::Verdict operator()(nephroid::Ellipse<V>& ellipse, nephroid::scalar_t<V>) const {
///         return nephroid::axis_ratio(ellipse) < 0.01f ? nephroid::Verdict::discarded : nephroid::Verdict::kept;
///     }
/// };
/// ```
template <class P, class V>
concept FootprintPolicy = Vector3<V> && requires(const P policy, Ellipse<V>& ellipse, scalar_t<V> limit) {
    { policy(ellipse, limit) } -> std::same_as<Verdict>;
};

/// Discards footprints without area, as Frisvad et al. do, and keeps all others. With the pixel filter no footprint
/// collapses.
struct DiscardCollapsed {
    template <Vector3 V>
    [[nodiscard]] Verdict operator()(Ellipse<V>& ellipse, scalar_t<V>) const {
        const scalar_t<V> inverse_area = scalar_t<V>(1) / area_scale(ellipse);
        return isfinite(inverse_area) ? Verdict::kept : Verdict::discarded;
    }
};

namespace detail {
/// Shortens the ellipse's major radius, and its minor radius if that is longer as well.
template <Vector3 V>
void shorten(Ellipse<V>& ellipse, const SingularValues<scalar_t<V>>& sigma, scalar_t<V> bound) {
    using T = scalar_t<V>;
    // The major axis is cos φ a + sin φ b with tan 2φ = 2 a·b / (a² − b²). Lengths are divided by the major
    // radius so that their squares stay in range.
    const V a = T(1) / sigma.major * ellipse.a, b = T(1) / sigma.major * ellipse.b;
    using std::atan2;
    const T phi = T(0.5) * atan2(T(2) * dot(a, b), length2(a) - length2(b));
    const V axis = normalize(V(cos(phi) * a + sin(phi) * b));
    ellipse.a = bound * axis;
    ellipse.b = (std::min)(sigma.minor, bound) * cross(ellipse.normal, axis);
}
} // namespace detail

/// Limits the major radius to `diagonals` times the diagonal of the eye path map's bounds. A grazing photon's footprint
/// may reach across the whole scene, but no further. Its flux is kept, unless the radius exceeds the scalar's range.
/// The default.
struct BoundMajorRadius {
    double diagonals = 1;
    template <Vector3 V>
    [[nodiscard]] Verdict operator()(Ellipse<V>& ellipse, scalar_t<V> diagonal) const {
        using T = scalar_t<V>;
        const T bound = T(diagonals) * diagonal;
        if (length2(ellipse.a) + length2(ellipse.b) < square(bound)) // the major radius is at most the root of this
            return Verdict::kept;
        const auto sigma = radii(ellipse);
        if (sigma.major <= bound || !(bound > T(0)))
            return Verdict::kept;
        if (!isfinite(sigma.major))
            return Verdict::discarded;
        detail::shorten(ellipse, sigma, bound);
        return Verdict::bounded;
    }
};

} // namespace nephroid
