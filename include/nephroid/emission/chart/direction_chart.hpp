// SPDX-License-Identifier: MIT
/// @file  Charts of the directions from one point: rectangles in planes in front of the point.
#pragma once

#include "nephroid/emission/chart/emission_chart.hpp"
#include "nephroid/emission/cone.hpp"

#include <algorithm>

namespace nephroid {

/// The chart of one rectangle: directions along axis + x frame.u + y frame.v with |x|, |y| <= slope, inside of the
/// cone.
///
/// @param intensity  intensity(direction) -> flux per steradian, of a unit direction; smooth
template <Vector3 V, Flux F, class Intensity>
[[nodiscard]] EmissionChart<V, F> direction_chart(const V& position, const V& axis, const Frame<V>& frame,
                                                  scalar_t<V> slope, const Cone<V>& cone, const Intensity& intensity) {
    using T = scalar_t<V>;
    EmissionChart<V, F> chart;
    chart.emit = [=](T u, T v) -> std::optional<Photon<V, F, 0>> {
        const T x = slope * (T(2) * u - T(1)), y = slope * (T(2) * v - T(1));
        const T r = T(1) / sqrt(T(1) + x * x + y * y);
        const V direction = r * (x * frame.u + (y * frame.v + axis));
        // 1 − cos without cancellation. The border belongs to the cone.
        if (!cone.is_everything() && T(0.5) * length2(V(direction - cone.axis)) > cone.height)
            return std::nullopt;
        // The solid angle of dx dy is r³ [the plane at distance 1: cos / distance²].
        const T density = square(T(2) * slope) * r * r * r;
        return Photon<V, F, 0>{position, direction, static_cast<F>(intensity(direction) * density), {}};
    };
    constexpr int n = 8;
    for (int i = 0; i < n * n; ++i)
        if (const auto photon = chart.emit((T(i % n) + T(0.5)) / T(n), (T(i / n) + T(0.5)) / T(n)))
            chart.power += flux_traits<F>::power(photon->flux) / (n * n);
    chart.width = chart.height = double(slope);
    return chart;
}

/// Charts of all directions in a cone: one rectangle if its half angle is at most 63°, otherwise the faces of a cube.
template <Vector3 V, Flux F, class Intensity>
[[nodiscard]] EmissionCharts<V, F> cone_charts(const V& position, const Cone<V>& cone, const Intensity& intensity) {
    using T = scalar_t<V>;
    const Frame<V> frame = frame_about(cone.axis);
    const T cosine = T(1) - cone.height;
    constexpr T steepest(2);
    if (cosine > T(0)) {
        const T slope = sqrt(cone.height * (T(2) - cone.height)) / cosine;
        if (slope <= steepest)
            return {direction_chart<V, F>(position, cone.axis, frame,
                                          slope * (T(1) + T(8) * std::numeric_limits<T>::epsilon()), cone, intensity)};
    }
    EmissionCharts<V, F> charts;
    const V axes[3] = {cone.axis, frame.u, frame.v};
    for (std::size_t i = 0; i < 6; ++i) {
        const T side = i % 2 == 0 ? T(1) : T(-1);
        auto chart =
            direction_chart<V, F>(position, V(side * axes[i / 2]),
                                  Frame<V>{axes[(i / 2 + 1) % 3], axes[(i / 2 + 2) % 3]}, T(1), cone, intensity);
        if (chart.power > 0)
            charts.push_back(std::move(chart));
    }
    return charts;
}

} // namespace nephroid
