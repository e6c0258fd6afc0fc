// SPDX-License-Identifier: MIT
/// @file  Fields over photons on a lattice, and what they should be beside borders.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/smoothing/second_order/footprint_field.hpp"

#include "smoothing/second_order/maps.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace nephroid::tests::fields {

using namespace detail;

using Field = FootprintField;

inline constexpr double side = 63, all = side * side; // photons on a lattice: cells of 3 × 3
inline constexpr double unit_per_cell = 3;            // lattice steps, each sqrt(π) units of u0
inline const double step = std::sqrt(pi<double>);

[[nodiscard]] inline FieldOptions stratified() { return {.stratified = true, .photons = all}; }

[[nodiscard]] inline Field field_of(const std::vector<MapPhoton>& photons, const FieldOptions& options) {
    SerialExecutor executor;
    return Field(photons, options, executor);
}

template <class Map>
[[nodiscard]] Field field_of(const Map& map, const FieldOptions& options = stratified()) {
    return field_of(photons_of(map, lattice(std::size_t(side), std::size_t(side))), options);
}

/// What the field says of a photon of the map.
template <class Map>
[[nodiscard]] std::optional<FieldSample> at(const Field& field, const Map& map, double u, double v) {
    const MapPhoton photon = photon_at(map, {u, v}, all);
    return field.at(photon.sample.at, photon.frame, photon.signature);
}

/// S of a map without any bend, by the rule.
[[nodiscard]] inline double straight_radius2(double photons = all, double share = 1,
                                             const SmoothingBounds& bounds = {}) {
    const Symmetric2 s = shape_tensor(log_bending(Symmetric2::isotropic(5 / (pi<double> * photons)), bounds),
                                      {.stratified = true, .share = share}, bounds);
    REQUIRE(s.xx == doctest::Approx(s.yy));
    return s.xx;
}

/// The square of a radius beside a border: (ρ⁻⁴ + d⁻⁴)^(−1/2), d no less than the least radius.
[[nodiscard]] inline double narrowed(double radius2, double distance) {
    const double d2 = square((std::max)(distance, SmoothingBounds{}.least_radius));
    return d2 < 8 * radius2 ? radius2 * d2 / std::hypot(radius2, d2) : radius2;
}

/// The reach towards a border that was found from photons: (4⁴ + (16 d)²)^(1/4).
[[nodiscard]] inline double reach_to_found(double distance) {
    return std::pow(256 + square(16 * (std::max)(distance, 0.0)), 0.25);
}
/// The square of a radius beside such a border.
[[nodiscard]] inline double narrowed_by_group(double radius2, double distance) {
    const double r2 = square(reach_to_found(distance));
    return r2 < 8 * radius2 ? radius2 * r2 / std::hypot(radius2, r2) : radius2;
}

/// The same between two borders `width` apart.
[[nodiscard]] inline double between(double radius2, double distance, double width) {
    return narrowed(narrowed(radius2, distance), width - distance);
}

[[nodiscard]] inline double distance(const Double3& a, const Double3& b) { return std::sqrt(inner(a - b, a - b)); }

inline void check_close(const Symmetric2& a, const Symmetric2& b, double tolerance) {
    CHECK(std::abs(a.xx - b.xx) <= tolerance);
    CHECK(std::abs(a.xy - b.xy) <= tolerance);
    CHECK(std::abs(a.yy - b.yy) <= tolerance);
}

/// Bends more and more along u, and a little along v.
[[nodiscard]] inline Landing curved(double u, double v) {
    const double a = 6 * u, b = 2 * v;
    return {{u + 0.1 * std::sin(a) * std::cos(b), v + 0.2 * u * v, 0},
            {1 + 0.6 * std::cos(a) * std::cos(b), 0.2 * v, 0},
            {-0.2 * std::sin(a) * std::sin(b), 1 + 0.2 * u, 0}};
}

/// Two groups, side by side.
struct TwoGroups {
    double border = 0.5;
    [[nodiscard]] Landing operator()(double u, double v) const {
        Landing landing = affine(u, v);
        landing.signature = u < border ? 1 : 2;
        return landing;
    }
};

} // namespace nephroid::tests::fields
