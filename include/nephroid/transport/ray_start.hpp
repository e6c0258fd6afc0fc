// SPDX-License-Identifier: MIT
/// @file  Where a ray begins: off the surface that it leaves by no more than rounding, and back by what the tracer
///        skips.
#pragma once

#include "nephroid/transport/scene.hpp"

#include <algorithm>
#include <limits>

namespace nephroid::detail {

/// How far off a surface the next ray begins, world units: twice the error, once for the point that was hit, once for
/// the next intersection's own rounding. Coordinates are never more exact than a few units in their last place,
/// whatever the hit says of its `position_error`; NaN where that is negative or no number.
///
/// @param position  on the surface
template <class H, Vector3 V>
[[nodiscard]] scalar_t<V> ray_clearance(const H& hit, const V& position) {
    using T = scalar_t<V>;
    const T rounding = T(4) * std::numeric_limits<T>::epsilon() * largest_component(position);
    if constexpr (HasPositionError<H, V>)
        return T(hit.position_error) >= T(0) ? T(2) * (std::max)(rounding, T(hit.position_error))
                                             : std::numeric_limits<T>::quiet_NaN();
    else
        return T(4) * rounding;
}

/// What the scene's tracer skips at the start of every ray, world units.
template <Vector3 V, class S>
[[nodiscard]] scalar_t<V> skipped_by_tracer([[maybe_unused]] const S& scene) {
    if constexpr (HasTracerEpsilon<S, V>)
        return scalar_t<V>(scene.tracer_epsilon);
    else
        return scalar_t<V>(0);
}

} // namespace nephroid::detail
