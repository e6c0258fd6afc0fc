// SPDX-License-Identifier: MIT
/// @file  A photon prepared for splatting: its footprint is filtered, bounded, and converted to a matrix.
#pragma once

#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/splat/splat_policies.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/transport/deposit.hpp"
#include "nephroid/vector/in_place.hpp"

#include <algorithm>
#include <optional>

namespace nephroid {

/// One photon, ready for the inner loop. A point x is inside the splat if |row_a · (x − centre)|² + |row_b · (x
/// − centre)|² < 1 and |row_n · (x − centre)| < 1.
template <Vector3 V, Flux F>
struct Splat {
    V centre;             ///< relative to the map's origin
    V row_a, row_b;       ///< the filter matrix [Frisvad et al. 2014, eq. 12]
    V row_n;              ///< the normal over the largest normal distance, the third row of the matrix
    V normal;             ///< unit, on the side from which the photon came
    V direction;          ///< of flight, unit
    F peak;               ///< flux over the ellipse's area times π: the kernel's value times this is an irradiance
    Box<scalar_t<V>> box; ///< tight around the ellipsoid, relative to the map's origin
};

/// The outcome of `make_splat`: a splat, or why there is none.
template <Vector3 V, Flux F>
struct SplatOutcome {
    std::optional<Splat<V, F>> splat;
    Fate fate = Fate::splatted; ///< why there is no splat, if there is none
    bool bounded = false;       ///< whether a policy changed the footprint
};

namespace detail {
template <class K, class T>
consteval bool explain_kernel_scalar() {
    static_assert(MapsRadius2<K, T>, "nephroid: the kernel policy cannot be called as kernel(radius2) const with the "
                                     "vector's scalar (footprint/kernel.hpp)");
    return false;
}
template <class P, class V>
consteval bool explain_collapse() {
    static_assert(FootprintPolicy<P, V>, "nephroid: the collapse policy cannot be called as policy(ellipse, spacing) "
                                         "const -> Verdict (footprint/policies.hpp)");
    return false;
}
template <class P, class V>
consteval bool explain_excess() {
    static_assert(FootprintPolicy<P, V>, "nephroid: the excess policy cannot be called as policy(ellipse, diagonal) "
                                         "const -> Verdict (footprint/policies.hpp)");
    return false;
}
template <class P, class D, class V>
consteval bool explain_shape() {
    static_assert(!std::same_as<P, DifferentialFootprint> || ShapesFootprint<P, D, V>,
                  "nephroid: these photons carry no differentials to shape footprints by: leave WithoutTangents out, "
                  "or choose FixedFootprint (splat/footprint_shape.hpp)");
    static_assert(ShapesFootprint<P, D, V>, "nephroid: the shape policy cannot be called as shape(deposit) const -> "
                                            "std::optional<Ellipse<V>> (splat/footprint_shape.hpp)");
    return false;
}

/// Policies that can turn such a deposit into a splat; otherwise an error names the one that cannot.
template <class P, class V, class F, std::size_t N>
concept MustSplat = (MapsRadius2<decltype(P::kernel), scalar_t<V>> ||
                     explain_kernel_scalar<decltype(P::kernel), scalar_t<V>>()) &&
                    (FootprintPolicy<decltype(P::collapse), V> || explain_collapse<decltype(P::collapse), V>()) &&
                    (FootprintPolicy<decltype(P::excess), V> || explain_excess<decltype(P::excess), V>()) &&
                    (ShapesFootprint<decltype(P::shape), Deposit<V, F, N>, V> ||
                     explain_shape<decltype(P::shape), Deposit<V, F, N>, V>());
} // namespace detail

/// Turns a photon's deposit into a splat.
template <Vector3 V, Flux F, std::size_t N, class Policies>
    requires detail::MustSplat<Policies, V, F, N>
[[nodiscard]] SplatOutcome<V, F> make_splat(const Deposit<V, F, N>& deposit, const EyePathMap<V>& map,
                                            const Policies& policies) {
    using Filter = std::remove_cvref_t<decltype(policies.filter)>;
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    SplatOutcome<V, F> outcome{}; // every return names this variable, so that it is never copied
    const std::optional<Ellipse<V>> shape = policies.shape(deposit);
    if (!all_finite(deposit.position) || !shape) {
        outcome.fate = Fate::invalid;
        return outcome;
    }
    Ellipse<V> ellipse = *shape;
    const T spacing = map.spacing_at(deposit.position);

    const auto judged = [&](Verdict verdict) {
        outcome.bounded = outcome.bounded || verdict == Verdict::bounded;
        return verdict != Verdict::discarded;
    };
    if (!judged(policies.excess(ellipse, map.diagonal()))) {
        outcome.fate = Fate::excessive;
        return outcome;
    }
    if constexpr (!std::same_as<Filter, NoPixelFilter>)
        ellipse = add_disk(ellipse, T(pixel_filter_width<std::remove_cvref_t<decltype(policies.kernel)>> *
                                      policies.filter.width_scale) *
                                        spacing);
    if (!judged(policies.collapse(ellipse, spacing))) {
        outcome.fate = Fate::collapsed;
        return outcome;
    }

    const T scale = abs(area_scale(ellipse));
    const FilterMatrix<V> filter = filter_matrix(ellipse);
    // The minor radius is at most the square root of the radii's product, so that most footprints do not need it.
    const T normal_distance = T(policies.normal_distance);
    const T thickness = square(normal_distance) * scale < square(spacing)
                            ? spacing
                            : (std::max)(normal_distance * radii(ellipse).minor, spacing);
    const T inverse_thickness = T(1) / thickness, inverse_scale = T(1) / scale;
    const F peak = deposit.flux * inverse_scale;
    if (!all_finite(filter.row_a) || !all_finite(filter.row_b) || !isfinite(inverse_thickness) ||
        !isfinite(double(flux_traits<F>::power(peak)))) {
        outcome.fate = Fate::collapsed;
        return outcome;
    }

    const V centre = map.tree().relative(deposit.position), half = half_extents(ellipse);
    const auto reach = [&](T h, T n) { return h + thickness * abs(n); };
    const T hx = reach(t::x(half), t::x(deposit.normal)), hy = reach(t::y(half), t::y(deposit.normal)),
            hz = reach(t::z(half), t::z(deposit.normal));
    const T cx = t::x(centre), cy = t::y(centre), cz = t::z(centre);
    outcome.splat.emplace(InPlace{[&] {
        return Splat<V, F>{centre,         filter.row_a,
                           filter.row_b,   inverse_thickness * deposit.normal,
                           deposit.normal, deposit.direction,
                           peak,           Box<T>{{cx - hx, cy - hy, cz - hz}, {cx + hx, cy + hy, cz + hz}}};
    }});
    return outcome;
}

} // namespace nephroid
