// SPDX-License-Identifier: MIT
/// @file  Photons as a renderer might store them, and estimates by their definition: every photon, in double.
#pragma once

#include "nephroid/gather/photon_map.hpp"

#include "nephroid/vector/glm.hpp"
#include "support/space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests {

/// A renderer's own photon.
template <class V, class F = scalar_t<V>>
struct Stored {
    F flux;
    V position, normal, direction;
};

template <class V, class F>
[[nodiscard]] PhotonMap<V, F> map_of_stored(const std::vector<Stored<V, F>>& photons) {
    using P = Stored<V, F>;
    return PhotonMap<V, F>(photons, &P::position, &P::normal, &P::direction, &P::flux);
}

/// A photon that fell straight onto z = 0 from above, or from below.
template <class V>
[[nodiscard]] Stored<V> on_floor(double x, double y, double flux, double side = 1, double z = 0) {
    using T = scalar_t<V>;
    return {T(flux), make_vector<V>(T(x), T(y), T(z)), make_vector<V>(T(0), T(0), T(side)),
            make_vector<V>(T(0), T(0), T(-side))};
}

/// Random photons on the unit square, whose fluxes add up to one for irradiance 1. Their coordinates are multiples of
/// 2^-24, which are exact in float.
template <class V>
[[nodiscard]] std::vector<Stored<V>> random_photons(std::size_t count, std::uint32_t seed) {
    Draws draw(seed);
    std::vector<Stored<V>> photons;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = draw.in(0, 1), y = draw.in(0, 1);
        photons.push_back(on_floor<V>(x, y, 1 / double(count)));
    }
    return photons;
}

/// The same of several fluxes, every fifth one on the other side, and some off the plane.
template <class V>
[[nodiscard]] std::vector<Stored<V>> mixed_photons(std::size_t count, std::uint32_t seed) {
    Draws draw(seed);
    std::vector<Stored<V>> photons;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = draw.in(0, 1), y = draw.in(0, 1), flux = draw.in(0.5, 1.5) / double(count);
        photons.push_back(on_floor<V>(x, y, flux, i % 5 == 4 ? -1 : 1, i % 3 == 0 ? draw.in(-0.05, 0.05) : 0));
    }
    return photons;
}

/// A photon relative to a position: squared distance, height above the tangent plane, flux.
struct Seen {
    double distance2, height, flux;
    glm::dvec3 offset;
};

template <class V>
[[nodiscard]] glm::dvec3 wide_of(const V& v) {
    using t = vector_traits<V>;
    return {double(t::x(v)), double(t::y(v)), double(t::z(v))};
}

[[nodiscard]] inline double times(const glm::dvec3& a, const glm::dvec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// All photons that came from the side of a normal, nearest first.
template <class V, class F>
[[nodiscard]] std::vector<Seen> seen_from(const std::vector<Stored<V, F>>& photons, const V& place, const V& normal) {
    std::vector<Seen> seen;
    for (const auto& p : photons) {
        const glm::dvec3 d = wide_of(p.position) - wide_of(place), n = wide_of(normal);
        if (times(wide_of(p.normal), n) > 0)
            seen.push_back({times(d, d), times(d, n), flux_traits<F>::power(p.flux), d});
    }
    std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.distance2 < b.distance2; });
    return seen;
}

/// Σ Φ K(r²/R²)/R², and how far rounding may move it: coordinates are at most 1, so squares of distances are off
/// by a few epsilon of R, relatively by epsilon/R; slopes of the kernels are below 4.
struct Expected {
    double value = 0, tolerance = 0;
};
template <class Kernel>
[[nodiscard]] Expected disk_sum(const std::vector<Seen>& seen, double radius2, const Kernel& kernel, double epsilon,
                                double thickness = std::numeric_limits<double>::infinity()) {
    Expected e;
    double flux = 0;
    for (const Seen& s : seen)
        if (s.distance2 < radius2 && std::abs(s.height) < thickness) {
            e.value += s.flux * kernel(s.distance2 / radius2) / radius2;
            flux += s.flux;
        }
    e.tolerance = 64 * epsilon / std::sqrt(radius2) * flux / radius2;
    return e;
}

template <class Make>
[[nodiscard]] std::string complaint_of(const Make& make) {
    try {
        (void)make();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

} // namespace nephroid::tests
