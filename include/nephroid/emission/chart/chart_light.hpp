// SPDX-License-Identifier: MIT
/// @file  A part of a lamp's chart as a light, for the parts of sheets that are splatted as photons instead.
#pragma once

#include "nephroid/emission/chart/emission_chart.hpp"
#include "nephroid/emission/light.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid {

/// A part of a chart: u and v from `begin` to `end`, within the unit square.
struct ChartRectangle {
    double u_begin, u_end, v_begin, v_end;

    [[nodiscard]] double area() const { return (u_end - u_begin) * (v_end - v_begin); }
};

/// The light that leaves a lamp in one rectangle of its chart.
template <Vector3 V, Flux F>
class ChartLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 2};

    ChartLight(EmissionChart<V, F> chart, const ChartRectangle& part) : chart_(std::move(chart)), part_(part) {
        constexpr int n = 16;
        for (int i = 0; i < n * n; ++i) {
            const auto photon = at((T(i % n) + T(0.5)) / T(n), (T(i / n) + T(0.5)) / T(n));
            if (!photon)
                continue;
            power_ += flux_traits<F>::power(photon->flux) * part_.area() / (n * n);
            somewhere_ = photon;
        }
        // Light that all samples missed still gets a few photons.
        power_ = (std::max)(power_, 1e-3 * chart_.power * part_.area());
        const double width = chart_.width * (part_.u_end - part_.u_begin),
                     height = chart_.height * (part_.v_end - part_.v_begin);
        shape_ = T(std::sqrt(height / width));
    }

    template <SampleSource<T> S>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const T u = samples.template next<T>(), v = samples.template next<T>();
        const auto photon = at(u, v);
        if (!photon) {
            const V zero = zero_vector<V>();
            const V up = make_vector<V>(T(0), T(0), T(1));
            return {somewhere_ ? somewhere_->position : zero,
                    somewhere_ ? somewhere_->direction : up,
                    flux_traits<F>::zero(),
                    {}};
        }
        const T across = spread.length(T(1));
        return {photon->position,
                photon->direction,
                static_cast<F>(photon->flux * (T(part_.area()) / spread.photons)),
                {change(*photon, u, v, true, across * shape_), change(*photon, u, v, false, across / shape_)}};
    }

    /// The rectangle's flux, estimated from 256 photons.
    [[nodiscard]] double power() const { return power_; }

private:
    /// The photon at a point of the rectangle, u and v from 0 to 1.
    [[nodiscard]] std::optional<Photon<V, F, 0>> at(T u, T v) const {
        return chart_.emit(T(part_.u_begin + double(u) * (part_.u_end - part_.u_begin)),
                           T(part_.v_begin + double(v) * (part_.v_end - part_.v_begin)));
    }

    /// The change of the ray over a part of the rectangle's side, from the rays at 0.01 of the side before and after.
    ///
    /// @param reach  that part, in sides
    [[nodiscard]] Tangent<V> change(const Photon<V, F, 0>& photon, T u, T v, bool along_u, T reach) const {
        const T step = T(0.01);
        const T here = along_u ? u : v;
        const auto beside = [&](T by) { return along_u ? at(u + by, v) : at(u, v + by); };
        const auto before = here > step ? beside(-step) : std::nullopt,
                   after = here < T(1) - step ? beside(step) : std::nullopt;
        const Photon<V, F, 0>&from = before ? *before : photon, &to = after ? *after : photon;
        const T steps = T(int(before.has_value()) + int(after.has_value()));
        if (!(steps > T(0)))
            return {zero_vector<V>(), zero_vector<V>()};
        const T scale = reach / (steps * step);
        const V turned = scale * (to.direction - from.direction);
        return {scale * (to.position - from.position), turned - dot(turned, photon.direction) * photon.direction};
    }

    EmissionChart<V, F> chart_;
    ChartRectangle part_;
    double power_ = 0;
    T shape_ = T(1); ///< square root of height over width, for tangents of equal length in the chart's own units
    std::optional<Photon<V, F, 0>> somewhere_; ///< any photon of the rectangle; points that do not shine use its ray
};

/// Joins neighbouring rectangles, first along u, then along v.
[[nodiscard]] inline std::vector<ChartRectangle> merged(std::vector<ChartRectangle> parts) {
    const auto merge = [&parts](auto&& comes_before, auto&& joins) {
        std::sort(parts.begin(), parts.end(), comes_before);
        std::vector<ChartRectangle> rows;
        for (const ChartRectangle& part : parts)
            if (rows.empty() || !joins(rows.back(), part))
                rows.push_back(part);
        parts = std::move(rows);
    };
    using R = ChartRectangle;
    merge([](const R& a, const R& b) { return a.v_begin != b.v_begin ? a.v_begin < b.v_begin : a.u_begin < b.u_begin; },
          [](R& row, const R& next) {
              const bool fits = row.v_begin == next.v_begin && row.v_end == next.v_end && row.u_end == next.u_begin;
              row.u_end = fits ? next.u_end : row.u_end;
              return fits;
          });
    merge([](const R& a, const R& b) { return a.u_begin != b.u_begin ? a.u_begin < b.u_begin : a.v_begin < b.v_begin; },
          [](R& column, const R& next) {
              const bool fits =
                  column.u_begin == next.u_begin && column.u_end == next.u_end && column.v_end == next.v_begin;
              column.v_end = fits ? next.v_end : column.v_end;
              return fits;
          });
    return parts;
}

} // namespace nephroid
