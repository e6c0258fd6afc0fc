// SPDX-License-Identifier: MIT
/// @file  Photons to relax, and what the tests of relaxation measure on them.
#pragma once

#include "support/space.hpp"

#include "nephroid/relaxation/relax.hpp"
#include "nephroid/vector/glm.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace nephroid::tests {

/// A photon as a renderer may have it: what relaxation moves is not all there is.
template <Vector3 V, class F = scalar_t<V>>
struct StoredPhoton {
    int number;
    V position;
    V normal;
    F flux;
};

using Stored = StoredPhoton<glm::dvec3>;

template <class P>
[[nodiscard]] auto access_to() {
    return photon_access(&P::position, &P::normal, &P::flux);
}

template <Vector3 V = glm::dvec3>
[[nodiscard]] StoredPhoton<V> floor_photon(double x, double y, int number = 0) {
    using T = scalar_t<V>;
    return {number, make_vector<V>(T(x), T(y), T(0)), make_vector<V>(T(0), T(0), T(1)), T(1)};
}

/// Uniform on the unit square of the plane z = 0.
template <Vector3 V = glm::dvec3>
[[nodiscard]] std::vector<StoredPhoton<V>> random_floor(int count, std::uint32_t seed) {
    Draws draw(seed);
    std::vector<StoredPhoton<V>> photons;
    for (int i = 0; i < count; ++i) {
        const double x = draw.in(0, 1);
        photons.push_back(floor_photon<V>(x, draw.in(0, 1), i));
    }
    return photons;
}

/// `count` photons on the unit square, at x < 0.5 ten times as dense as beyond.
[[nodiscard]] inline std::vector<Stored> stepped_floor(int count, std::uint32_t seed) {
    Draws draw(seed);
    std::vector<Stored> photons;
    for (int i = 0; i < count; ++i) {
        const double share = draw.in(0, 1);
        const double x = share < 10.0 / 11 ? 0.55 * share : 0.5 + 5.5 * (share - 10.0 / 11);
        photons.push_back(floor_photon(x, draw.in(0, 1), i));
    }
    return photons;
}

template <class P>
[[nodiscard]] bool same_positions(const std::vector<P>& a, const std::vector<P>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const P& p, const P& q) {
        return std::memcmp(&p.position, &q.position, sizeof p.position) == 0;
    });
}

/// Distances from one photon to all others with their numbers, ascending as far as the nearest sixteen: brute force.
template <class P>
[[nodiscard]] std::vector<std::pair<double, std::size_t>> distances(const std::vector<P>& photons, std::size_t from) {
    using t = vector_traits<decltype(P::position)>;
    const auto along = [&](const P& a, const P& b) {
        const double x = double(t::x(a.position)) - double(t::x(b.position));
        const double y = double(t::y(a.position)) - double(t::y(b.position));
        const double z = double(t::z(a.position)) - double(t::z(b.position));
        return std::sqrt(x * x + y * y + z * z);
    };
    std::vector<std::pair<double, std::size_t>> result;
    for (std::size_t i = 0; i < photons.size(); ++i)
        if (i != from)
            result.emplace_back(along(photons[i], photons[from]), i);
    const auto sorted = (std::min)(result.size(), std::size_t(16));
    std::partial_sort(result.begin(), result.begin() + std::ptrdiff_t(sorted), result.end());
    return result;
}

} // namespace nephroid::tests
