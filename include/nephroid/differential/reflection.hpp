// SPDX-License-Identifier: MIT
/// @file  Mirror reflection of a ray and of its tangents.
#pragma once

#include "nephroid/differential/tangent.hpp"

namespace nephroid {

/// A reflection at one surface point: made once for each event, applied to each tangent.
template <Vector3 V>
class Reflection {
public:
    /// @param direction  of the incoming ray, unit
    /// @param normal     the *shading* normal, unit, either side
    Reflection(const V& direction, const V& normal)
        : incoming_(direction), normal_(normal), twice_cosine_(scalar_t<V>(2) * dot(direction, normal)),
          direction_(normalize(direction - twice_cosine_ * normal)) {}

    /// The reflected direction, unit: ω − 2 (ω · n) n.
    [[nodiscard]] const V& direction() const { return direction_; }

    /// The reflected ray's ∂ω/∂p.
    ///
    /// @param d_direction  ∂ω/∂p of the incoming ray
    /// @param d_normal     ∂n/∂p of the same normal: `curvature(tangent.d_position)` (differential/curvature.hpp)
    /// Source: Igehy 1999, reflection.
    [[nodiscard]] V differentiate(const V& d_direction, const V& d_normal) const {
        using T = scalar_t<V>;
        const T d_twice_cosine = T(2) * (dot(d_direction, normal_) + dot(incoming_, d_normal));
        const V d_reflected = d_direction - (d_twice_cosine * normal_ + twice_cosine_ * d_normal);
        // A unit direction's derivative is orthogonal to it: this keeps rounding from growing along the path.
        return d_reflected - dot(direction_, d_reflected) * direction_;
    }

private:
    V incoming_;
    V normal_;
    scalar_t<V> twice_cosine_;
    V direction_;
};

} // namespace nephroid
