// SPDX-License-Identifier: MIT
/// @file  Collects the charts of a lamp or of a set of lamps.
#pragma once

#include "nephroid/emission/chart/emission_chart.hpp"
#include "nephroid/emission/emit_at.hpp"
#include "nephroid/emission/light.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <variant>

namespace nephroid {

namespace detail {
/// A lamp with charts of its own: `charts() -> EmissionCharts<V, F>`.
template <class L>
concept HasCharts = requires(const L light) {
    { light.charts() } -> std::convertible_to<EmissionCharts<typename L::vector, typename L::flux_type>>;
};

/// A lamp with an area whose points have charts: `charts_at(u1, u2, share)` returns those of one point, which emits
/// this share of the lamp's flux.
template <class L>
concept HasLampPoints = requires(const L light, scalar_t<typename L::vector> u) {
    { light.charts_at(u, u, u) } -> std::convertible_to<EmissionCharts<typename L::vector, typename L::flux_type>>;
};
} // namespace detail

/// The chart of a lamp whose domain is a chart: it has two coordinates and no kinks.
template <class L>
    requires(coordinates_of<L> == 2)
[[nodiscard]] EmissionChart<typename L::vector, typename L::flux_type> chart_of_domain(const L& light) {
    using V = typename L::vector;
    using F = typename L::flux_type;
    using T = scalar_t<V>;
    EmissionChart<V, F> chart;
    chart.emit = [light](T u, T v) -> std::optional<Photon<V, F, 0>> {
        const auto photon = emit_at(light, {double(u), double(v)}, Spread<T>{T(1), T(1)});
        return Photon<V, F, 0>{photon.position, photon.direction, photon.flux, {}};
    };
    chart.power = double(light.power());
    // The change of the positions, or else of the directions, over the middle half of each coordinate.
    const auto reach = [&](T u, T v) {
        const auto from = chart.emit(T(0.5) - u, T(0.5) - v), to = chart.emit(T(0.5) + u, T(0.5) + v);
        return std::array<double, 2>{double(length(V(to->position - from->position))),
                                     double(length(V(to->direction - from->direction)))};
    };
    const auto across = reach(T(0.25), T(0)), along = reach(T(0), T(0.25));
    for (std::size_t kind = 0; kind < 2; ++kind)
        if (across[kind] > 0 && along[kind] > 0) {
            chart.width = across[kind], chart.height = along[kind];
            break;
        }
    return chart;
}

/// The charts from which sheets can be made, and the power of the lamps that have none.
template <Vector3 V, Flux F>
struct LampCharts {
    EmissionCharts<V, F> charts;
    double power_without = 0; ///< of the lamps without charts: their domain is missing or has kinks
};

/// The charts of a lamp or a set of lamps.
///
/// @param lamp_points  number of points that represent a lamp with an area, >= 1
/// @param first        index of the first point in the R2 lattice; each pass takes other points
/// Source of the lattice: Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences".
template <class L>
[[nodiscard]] LampCharts<typename L::vector, typename L::flux_type> charts_of(const L& light, std::size_t lamp_points,
                                                                              std::size_t first = 0) {
    using T = scalar_t<typename L::vector>;
    LampCharts<typename L::vector, typename L::flux_type> found;
    const auto add = [&found](auto&& charts) {
        std::move(charts.begin(), charts.end(), std::back_inserter(found.charts));
    };
    if constexpr (requires { light.lights(); }) {
        for (const auto& any : light.lights())
            std::visit(
                [&](const auto& one) {
                    auto charts = charts_of(one, lamp_points, first);
                    add(std::move(charts.charts));
                    found.power_without += charts.power_without;
                },
                any);
    } else if constexpr (detail::HasCharts<L>) {
        add(light.charts());
    } else if constexpr (detail::HasLampPoints<L>) {
        for (std::size_t i = 0; i < lamp_points; ++i) {
            const auto fraction = [number = double(first + i)](double step) {
                const double x = 0.5 + number * step;
                return T(x - std::floor(x));
            };
            add(light.charts_at(fraction(0.7548776662466927), fraction(0.5698402909980532), T(1) / T(lamp_points)));
        }
    } else if constexpr (coordinates_of<L> == 2) {
        if (domain_of(light).kinks[0] == Kinks::nowhere)
            found.charts.push_back(chart_of_domain(light));
        else
            found.power_without = double(light.power());
    } else {
        found.power_without = double(light.power());
    }
    return found;
}

} // namespace nephroid
