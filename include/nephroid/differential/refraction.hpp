// SPDX-License-Identifier: MIT
/// @file  Refraction of a ray and of its tangents, dispersion included.
#pragma once

#include "nephroid/differential/tangent.hpp"

#include <algorithm>
#include <optional>

namespace nephroid {

/// A refraction at one surface point. `refraction` makes it once for each event; it is then applied to each tangent.
/// With c = −ω·n and c' the cosine of the refracted angle, ω' = η ω + μ n where μ = η c − c'.
template <Vector3 V>
class Refraction {
public:
    using T = scalar_t<V>;

    /// @param direction       of the incoming ray, unit
    /// @param normal          unit, against the ray
    /// @param eta             n₁/n₂, > 0
    /// @param cos_incident    c, in (0, 1]
    /// @param cos_refracted   c', in (0, 1]
    Refraction(const V& direction, const V& normal, T eta, T cos_incident, T cos_refracted)
        : incoming_(direction), normal_(normal), eta_(eta), cos_incident_(cos_incident), cos_refracted_(cos_refracted),
          mu_(eta * cos_incident - cos_refracted), direction_(normalize(eta * direction + mu_ * normal)) {}

    /// The refracted direction, unit.
    [[nodiscard]] const V& direction() const { return direction_; }

    /// The cosine of the angle between the refracted ray and the normal, in (0, 1].
    [[nodiscard]] T cos_refracted() const { return cos_refracted_; }

    /// The refracted ray's ∂ω/∂p.
    ///
    /// @param d_direction  ∂ω/∂p of the incoming ray
    /// @param d_normal     ∂n/∂p of the same normal: `curvature(tangent.d_position)`
    /// Near the critical angle the derivative grows like 1/c', as the true one does; splatting bounds the footprint and
    /// counts it (footprint/policies.hpp).
    /// Source: Igehy 1999, refraction.
    [[nodiscard]] V differentiate(const V& d_direction, const V& d_normal) const {
        const T d_mu = (eta_ - eta_ * eta_ * cos_incident_ / cos_refracted_) * d_cosine(d_direction, d_normal);
        return tangential(eta_ * d_direction + (d_mu * normal_ + mu_ * d_normal));
    }

    /// The same for a parameter that changes the index as well: a wavelength tangent.
    ///
    /// @param d_eta  ∂η/∂p, η = n₁/n₂
    /// Source: Elek et al. 2014, spectral ray differentials.
    [[nodiscard]] V differentiate(const V& d_direction, const V& d_normal, T d_eta) const {
        const T sin2_incident = (T(1) - cos_incident_) * (T(1) + cos_incident_);
        const T d_mu = (cos_incident_ + eta_ * sin2_incident / cos_refracted_) * d_eta;
        return differentiate(d_direction, d_normal) + tangential(d_eta * incoming_ + d_mu * normal_);
    }

private:
    [[nodiscard]] T d_cosine(const V& d_direction, const V& d_normal) const {
        return -(dot(d_direction, normal_) + dot(incoming_, d_normal));
    }

    // A unit direction's derivative is orthogonal to it: this keeps rounding from growing along the path.
    [[nodiscard]] V tangential(const V& d_refracted) const {
        return d_refracted - dot(direction_, d_refracted) * direction_;
    }

    V incoming_;
    V normal_;
    T eta_;
    T cos_incident_;
    T cos_refracted_;
    T mu_;
    V direction_;
};

/// Prepares the refraction of a ray and its tangents.
///
/// @param direction  of the incoming ray, unit
/// @param normal     the *shading* normal, unit, against the ray: direction · normal < 0
/// @param eta        n₁/n₂: the index of the medium the ray is in over that of the one it enters, > 0
/// @return  nothing at and beyond the critical angle (total internal reflection), and where the ray does not run
///          against the normal
template <Vector3 V>
[[nodiscard]] std::optional<Refraction<V>> refraction(const V& direction, const std::type_identity_t<V>& normal,
                                                      scalar_t<V> eta) {
    using T = scalar_t<V>;
    // Rounding can make the cosine of two unit vectors exceed one. (This order of arguments keeps NaN.)
    const T cos_incident = (std::min)(-dot(direction, normal), T(1));
    if (!(cos_incident > T(0)))
        return std::nullopt;
    // 1 − η² sin² in a form that does not cancel for η <= 1, and for η > 1 only near the critical angle: nearly
    // equal indices keep their digits at grazing incidence.
    const T cos2_refracted = square(eta * cos_incident) - (eta - T(1)) * (eta + T(1));
    if (!(cos2_refracted > T(0)))
        return std::nullopt;
    return Refraction<V>(direction, normal, eta, cos_incident, (std::min)(T(1), sqrt(cos2_refracted)));
}

} // namespace nephroid
