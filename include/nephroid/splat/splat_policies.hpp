// SPDX-License-Identifier: MIT
/// @file  The policies of splatting, chosen at compile time: a preset, or one policy at a time by its name.
///
/// ```cpp
/// const auto policies = nephroid::Published{}.with_kernel(nephroid::EpanechnikovKernel{});
/// ```
#pragma once

#include "nephroid/footprint/kernel.hpp"
#include "nephroid/footprint/policies.hpp"
#include "nephroid/splat/footprint_shape.hpp"

#include <concepts>

namespace nephroid {

/// Adds a pixel's footprint to the photon's, so that no footprint falls between the eye path vertices. The picture then
/// keeps its energy and converges even at folds. On by default.
struct PixelFilter {
    /// Factor of the filter's width (`pixel_filter_width`). With 1 the filter has a pixel box's variance and keeps
    /// folds sharpest; where most light falls into a few pixels, a picture's energy varies by up to 0.7%. With 1.244
    /// the zero of the biweight's Fourier transform is at the pixels' frequency; the energy varies by 0.2%, and folds
    /// are half again as blurred.
    double width_scale = 1;
};

/// Splats the footprint without a pixel filter.
struct NoPixelFilter {};

/// Splats photons where they land, all with the same smoothing [Frisvad et al. 2014].
struct FirstOrder {
    static constexpr bool uses_neighbours = false;
};

namespace detail {
/// PixelFilter, NoPixelFilter, or a type with a member `width_scale`.
template <class P>
concept FiltersPixels = std::same_as<P, NoPixelFilter> || requires(const P filter) {
    { filter.width_scale } -> std::convertible_to<double>;
};

/// A type that says whether splats depend on the photons around them, as with `SecondOrder`
/// (smoothing/second_order/policies.hpp).
template <class P>
concept SplatOrder = requires {
    { P::uses_neighbours } -> std::convertible_to<bool>;
};

template <class K>
concept MapsAnyRadius2 = MapsRadius2<K, float> || MapsRadius2<K, double>;

/// Whether the policies use the kernel's second moment: the pixel filter's width and the second-order shift depend on
/// it.
template <class Filter, class Order>
inline constexpr bool uses_second_moment = !std::same_as<Filter, NoPixelFilter> || Order::uses_neighbours;

template <class K>
consteval bool explain_kernel() {
    static_assert(std::semiregular<K> && MapsAnyRadius2<K>,
                  "nephroid: the kernel policy cannot be called as kernel(radius2) const -> the same scalar "
                  "(footprint/kernel.hpp)");
    return false;
}
template <class K>
consteval bool explain_second_moment() {
    static_assert(HasSecondMoment<K>, "nephroid: the kernel lacks `static constexpr double second_moment`, which the "
                                      "pixel filter and second order need (footprint/kernel.hpp)");
    return false;
}
template <class Filter>
consteval bool explain_filter() {
    static_assert(FiltersPixels<Filter>, "nephroid: the filter policy must be PixelFilter, NoPixelFilter, or a type "
                                         "with a number `width_scale` (splat/splat_policies.hpp)");
    return false;
}
template <class Order>
consteval bool explain_order() {
    static_assert(SplatOrder<Order>,
                  "nephroid: the order policy must be FirstOrder (splat/splat_policies.hpp), SecondOrder or "
                  "CurvedFootprints (smoothing/second_order/policies.hpp)");
    return false;
}

/// Checks what does not depend on the vector type; an error says what is wrong.
template <class K, class Filter, class Order>
concept MustBePolicies = ((std::semiregular<K> && MapsAnyRadius2<K>) || explain_kernel<K>()) &&
                         (FiltersPixels<Filter> || explain_filter<Filter>()) &&
                         (SplatOrder<Order> || explain_order<Order>()) &&
                         (!uses_second_moment<Filter, Order> || HasSecondMoment<K> || explain_second_moment<K>());
} // namespace detail

/// How a photon becomes a splat. The type of every member is a policy. Begin with a preset, `Published` or `Default`
/// (smoothing/second_order/policies.hpp), set its policies' options, and replace the policies that do not suit:
///
/// ```cpp
/// nephroid::Default policies{.filter = {1.244}};
/// const auto bare = nephroid::Published{}.with_filter(nephroid::NoPixelFilter{});
/// ```
template <class K, class Filter, class Collapse, class Excess, class Shape, class Order>
    requires detail::MustBePolicies<K, Filter, Order>
struct SplatPolicies {
    K kernel{};          ///< how a photon's flux is spread over its footprint (footprint/kernel.hpp)
    Filter filter{};     ///< PixelFilter, or NoPixelFilter
    Collapse collapse{}; ///< what to do with footprints without area (footprint/policies.hpp)
    Excess excess{};     ///< what to do with footprints that are too long
    Shape shape{};       ///< DifferentialFootprint, or FixedFootprint (splat/footprint_shape.hpp)
    Order order{};       ///< FirstOrder, SecondOrder or CurvedFootprints (smoothing/second_order/policies.hpp)
    /// Largest distance of a vertex from the photon's tangent plane, in minor radii of the footprint; vertices further
    /// away (and further than the vertices' spacing) receive nothing. It limits topological bias. With a larger value
    /// long footprints follow curved surfaces further, and leak further through thin ones. [Frisvad et al. 2014, after
    /// eq. 12. They use the major radius, with which a long footprint reaches far through a table top]
    double normal_distance = 0.25;

    template <class Other>
    [[nodiscard]] constexpr auto with_kernel(const Other& other) const {
        return SplatPolicies<Other, Filter, Collapse, Excess, Shape, Order>{other, filter, collapse,       excess,
                                                                            shape, order,  normal_distance};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_filter(const Other& other) const {
        return SplatPolicies<K, Other, Collapse, Excess, Shape, Order>{kernel, other, collapse,       excess,
                                                                       shape,  order, normal_distance};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_collapse(const Other& other) const {
        return SplatPolicies<K, Filter, Other, Excess, Shape, Order>{kernel, filter, other,          excess,
                                                                     shape,  order,  normal_distance};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_excess(const Other& other) const {
        return SplatPolicies<K, Filter, Collapse, Other, Shape, Order>{kernel, filter, collapse,       other,
                                                                       shape,  order,  normal_distance};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_shape(const Other& other) const {
        return SplatPolicies<K, Filter, Collapse, Excess, Other, Order>{kernel, filter, collapse,       excess,
                                                                        other,  order,  normal_distance};
    }
    template <class Other>
    [[nodiscard]] constexpr auto with_order(const Other& other) const {
        return SplatPolicies<K, Filter, Collapse, Excess, Shape, Other>{kernel, filter, collapse,       excess,
                                                                        shape,  other,  normal_distance};
    }
    [[nodiscard]] constexpr SplatPolicies with_normal_distance(double other) const {
        SplatPolicies changed = *this;
        changed.normal_distance = other;
        return changed;
    }
};

/// The preset of photon differential splatting as published [Frisvad et al. 2014]: photons are splatted where they
/// land, all with the same smoothing, a biweight kernel, and a pixel filter.
using Published =
    SplatPolicies<BiweightKernel, PixelFilter, DiscardCollapsed, BoundMajorRadius, DifferentialFootprint, FirstOrder>;

namespace detail {
template <class P>
inline constexpr bool is_splat_policies = false;
template <class... Each>
inline constexpr bool is_splat_policies<SplatPolicies<Each...>> = true;
} // namespace detail

} // namespace nephroid
