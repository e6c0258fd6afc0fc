// SPDX-License-Identifier: MIT
/// @file  The chart of a collimated beam: the parallelogram from which its photons start.
#pragma once

#include "nephroid/emission/chart/emission_chart.hpp"

namespace nephroid {

/// Makes the chart of a beam.
///
/// @param direction   of the beam, unit
/// @param corner,edge_u,edge_v  photons start at corner + u edge_u + v edge_v
/// @param flux        through the whole parallelogram
/// @param is_disk     whether only the ellipse inside of the parallelogram emits
template <Vector3 V, Flux F>
[[nodiscard]] EmissionChart<V, F> beam_chart(const V& direction, const V& corner, const V& edge_u, const V& edge_v,
                                             const F& flux, bool is_disk) {
    using T = scalar_t<V>;
    EmissionChart<V, F> chart;
    chart.emit = [=](T u, T v) -> std::optional<Photon<V, F, 0>> {
        if (is_disk && square(T(2) * u - T(1)) + square(T(2) * v - T(1)) > T(1))
            return std::nullopt;
        return Photon<V, F, 0>{corner + (u * edge_u + v * edge_v), direction, flux, {}};
    };
    chart.width = double(length(V(edge_u - dot(direction, edge_u) * direction)));
    chart.height = double(length(V(edge_v - dot(direction, edge_v) * direction)));
    chart.power = flux_traits<F>::power(flux) * (is_disk ? pi<double> / 4 : 1);
    return chart;
}

} // namespace nephroid
