// SPDX-License-Identifier: MIT
/// @file  Free flight: a tangent carried from one surface to the tangent plane of the next.
#pragma once

#include "nephroid/differential/tangent.hpp"

#include <limits>
#include <optional>

namespace nephroid {

/// A flight of known length that ends on a known plane. `transfer` makes it once for each ray; it is then applied to
/// each tangent.
template <Vector3 V>
class Transfer {
public:
    /// @param direction  of the ray, unit
    /// @param distance   flown, world units, >= 0
    /// @param slope      n / (n · direction) for the plane's normal n
    Transfer(const V& direction, scalar_t<V> distance, const V& slope)
        : direction_(direction), slope_(slope), distance_(distance) {}

    /// The tangent at the hit: `d_position` lies in the plane, `d_direction` is unchanged.
    [[nodiscard]] Tangent<V> operator()(const Tangent<V>& tangent) const {
        const V free_flight = tangent.d_position + distance_ * tangent.d_direction;
        // The hit stays on the plane, so the distance changes with the parameter as well.
        const scalar_t<V> d_distance = -dot(slope_, free_flight);
        return {free_flight + d_distance * direction_, tangent.d_direction};
    }

private:
    V direction_;
    V slope_;
    scalar_t<V> distance_;
};

/// Prepares the transfer of a photon's tangents to its next hit.
///
/// @param direction  of the ray, unit
/// @param distance   to the hit, world units, >= 0
/// @param normal     the *geometric* normal there (the hit point moves on the real surface); either side, any
///                   non-zero length
/// @return  nothing if the ray runs parallel to the plane, where its footprint is unbounded: to 1e-12 or less, far
///          below the rounding of a direction
/// Source: Igehy 1999, transfer; Frisvad et al. 2014, eq. 8 and 9, which are this formula for aligned tangents.
template <Vector3 V>
[[nodiscard]] std::optional<Transfer<V>> transfer(const V& direction, scalar_t<V> distance,
                                                  const std::type_identity_t<V>& normal) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    const T cos_hit = dot(direction, normal);
    // Below 2^-40 in float, 2^-338 in double, transferred tangents may overflow.
    constexpr T least = T(1) / detail::power_of_two<T>(std::numeric_limits<T>::max_exponent / 3 - 2);
    if (!(abs(cos_hit) > least * (abs(T(t::x(normal))) + abs(T(t::y(normal))) + abs(T(t::z(normal))))))
        return std::nullopt;
    return Transfer<V>(direction, distance, T(1) / cos_hit * normal);
}

} // namespace nephroid
