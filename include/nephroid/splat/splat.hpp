// SPDX-License-Identifier: MIT
/// @file  A photon made ready to be splatted: its footprint, filtered, bounded, and turned into a matrix.
#pragma once

#include "nephroid/footprint/kernel.hpp"
#include "nephroid/footprint/policies.hpp"
#include "nephroid/footprint/smoothing.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/transport/deposit.hpp"
#include "nephroid/vector/in_place.hpp"

#include <algorithm>
#include <optional>

namespace nephroid {

/// Adds a pixel's footprint to the photon's, so that no footprint falls between the eye path vertices: the image
/// keeps its energy and converges even at folds. On by default.
struct PixelFilter {
    /// Times the kernel's own constant, `pixel_filter_width`. 1 has a pixel box's variance and keeps folds sharpest; a
    /// picture's energy then varies by up to 0.7% where most light falls into a few pixels. 1.244 puts the zero of the
    /// biweight's Fourier transform at the pixels' frequency: energy to 0.2% there, and folds half again as blurred.
    double width_scale = 1;
};

/// Splats the footprint as it is.
struct NoPixelFilter {};

/// One of the two, or a type with a member `width_scale`.
template <class P>
concept FiltersPixels = std::same_as<P, NoPixelFilter> || requires(const P filter) {
    { filter.width_scale } -> std::convertible_to<double>;
};

/// The footprint is the photon differential's [Frisvad et al. 2014]. The default.
struct DifferentialFootprint {
    template <Vector3 V, Flux F, std::size_t N>
        requires(N >= 2)
    [[nodiscard]] std::optional<Ellipse<V>> operator()(const Deposit<V, F, N>& deposit) const {
        if (!std::all_of(deposit.d_position.begin(), deposit.d_position.end(),
                         [](const V& d) { return all_finite(d); }))
            return std::nullopt;
        return footprint(deposit.d_position, deposit.normal);
    }
};

/// The footprint is a disk of this radius, the same for every photon: splatting with a fixed bandwidth, which needs no
/// differentials (`WithoutTangents`).
/// Source: Lavignotte and Paulin 2003, as Frisvad et al. 2014 compare with it.
struct FixedFootprint {
    double radius; ///< world units, > 0
    template <Vector3 V, Flux F, std::size_t N>
    [[nodiscard]] std::optional<Ellipse<V>> operator()(const Deposit<V, F, N>& deposit) const {
        const Frame<V> frame = frame_about(deposit.normal);
        return Ellipse<V>{scalar_t<V>(radius) * frame.u, scalar_t<V>(radius) * frame.v, deposit.normal};
    }
};

/// If this is what the compiler names: the policies shape footprints by photon differentials, and these photons carry
/// none. Leave `WithoutTangents` out, or choose FixedFootprint.
template <class P, class D, class V>
concept ShapesFootprint = requires(const P shape, const D& deposit) {
    { shape(deposit) } -> std::same_as<std::optional<Ellipse<V>>>;
};

/// How a photon becomes a splat. Every member is a policy chosen by its type; the defaults suit most scenes.
template <class K = BiweightKernel, class Filter = PixelFilter, class Collapse = DiscardCollapsed,
          class Excess = BoundMajorRadius, class Shape = DifferentialFootprint, class Order = SecondOrder>
struct SplatPolicies {
    K kernel{};
    Filter filter{};
    Collapse collapse{};
    Excess excess{};
    Shape shape{};
    /// How `splat_caustics` places and sizes footprints: SecondOrder, or FirstOrder.
    Order order{};
    /// Against topological bias: a vertex further from the photon's tangent plane than this many minor radii of the
    /// footprint (and than the spacing of the vertices) does not receive. Larger lets long footprints bend further
    /// around curved surfaces, and leak further through thin ones. [Frisvad et al. 2014, after eq. 12; the minor radius
    /// is nephroid's, as a long footprint would reach far through a table top by its major one]
    double normal_distance = 0.25;
};

/// One photon as the inner loop wants it: x is inside where |row_a · (x − centre)|² + |row_b · (x − centre)|² <
/// 1 and
/// |row_n · (x − centre)| < 1.
template <Vector3 V, Flux F>
struct Splat {
    V centre;             ///< relative to the map's origin
    V row_a, row_b;       ///< the filter matrix [Frisvad et al. 2014, eq. 12]
    V row_n;              ///< the normal over the largest normal distance, the third row of the matrix
    V normal;             ///< unit, towards the side that the photon came from
    V direction;          ///< of flight, unit
    F peak;               ///< flux per unit of the disk's area: times the kernel, an irradiance
    Box<scalar_t<V>> box; ///< tight about the ellipsoid, relative to the map's origin
};

/// The outcome of `make_splat`: a splat, or why there is none.
template <Vector3 V, Flux F>
struct SplatOutcome {
    std::optional<Splat<V, F>> splat;
    Fate fate = Fate::splatted; ///< anything else where there is no splat
    bool bounded = false;       ///< a policy changed the footprint
};

/// Turns a photon's deposit into a splat onto a map.
template <Vector3 V, Flux F, std::size_t N, class K, class Filter, class Collapse, class Excess, class Shape,
          class Order>
    requires Kernel<K, scalar_t<V>> && FiltersPixels<Filter> && FootprintPolicy<Collapse, V> &&
        FootprintPolicy<Excess, V> && ShapesFootprint<Shape, Deposit<V, F, N>, V>
[[nodiscard]] SplatOutcome<V, F> make_splat(const Deposit<V, F, N>& deposit, const EyePathMap<V>& map,
                                            const SplatPolicies<K, Filter, Collapse, Excess, Shape, Order>& policies) {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    SplatOutcome<V, F> outcome{}; // what every return names, so that none of them copies it
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
        ellipse = add_disk(ellipse, T(pixel_filter_width<K> * policies.filter.width_scale) * spacing);
    if (!judged(policies.collapse(ellipse, spacing))) {
        outcome.fate = Fate::collapsed;
        return outcome;
    }

    const T scale = abs(area_scale(ellipse));
    const FilterMatrix<V> filter = filter_matrix(ellipse);
    // The minor radius is no longer than the root of their product: most footprints need not be asked for it.
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
