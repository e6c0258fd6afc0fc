// SPDX-License-Identifier: MIT
/// @file  What to do with footprints that are too thin or too long: policies, chosen at compile time.
///
/// A policy is called with the footprint before it is splatted and may change it or ask for its photon to be
/// discarded; both are counted. A policy that is not chosen is not compiled.
#pragma once

#include "nephroid/footprint/ellipse.hpp"

namespace nephroid {

/// What a policy did with a footprint.
enum class Verdict : unsigned char { kept, bounded, discarded };

/// A policy: `policy(ellipse, limit)` may change the ellipse. `limit` is a length from the eye path map in world
/// units: for a collapse policy the local spacing of its vertices, for an excess policy the diagonal of its bounds.
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

/// Discards a footprint without area, as Frisvad et al. do, and keeps all others. With the pixel filter on, nothing
/// ever collapses.
struct DiscardCollapsed {
    template <Vector3 V>
    [[nodiscard]] Verdict operator()(Ellipse<V>& ellipse, scalar_t<V>) const {
        const scalar_t<V> inverse_area = scalar_t<V>(1) / area_scale(ellipse);
        return isfinite(inverse_area) ? Verdict::kept : Verdict::discarded;
    }
};

namespace detail {
/// Shortens the ellipse along its major axis to this radius; the minor one stays, unless it is longer as well.
template <Vector3 V>
void shorten(Ellipse<V>& ellipse, const SingularValues<scalar_t<V>>& sigma, scalar_t<V> bound) {
    using T = scalar_t<V>;
    // The major axis is cos φ a + sin φ b with tan 2φ = 2 a·b / (a² − b²), over the major radius to stay in
    // range.
    const V a = T(1) / sigma.major * ellipse.a, b = T(1) / sigma.major * ellipse.b;
    using std::atan2;
    const T phi = T(0.5) * atan2(T(2) * dot(a, b), length2(a) - length2(b));
    const V axis = normalize(V(cos(phi) * a + sin(phi) * b));
    ellipse.a = bound * axis;
    ellipse.b = (std::min)(sigma.minor, bound) * cross(ellipse.normal, axis);
}
} // namespace detail

/// Bounds the major radius at `diagonals` times the diagonal of the eye path map's bounds: a grazing photon's
/// footprint may reach across the whole scene, but not be endless. Its flux is kept, unless the radius is beyond the
/// scalar's range. The default.
struct BoundMajorRadius {
    double diagonals = 1;
    template <Vector3 V>
    [[nodiscard]] Verdict operator()(Ellipse<V>& ellipse, scalar_t<V> diagonal) const {
        using T = scalar_t<V>;
        const T bound = T(diagonals) * diagonal;
        if (length2(ellipse.a) + length2(ellipse.b) < square(bound)) // as the major radius is no longer than that
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
