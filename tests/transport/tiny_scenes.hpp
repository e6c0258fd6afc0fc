// SPDX-License-Identifier: MIT
/// @file  Scenes of a few planes, written out, for the tests of what a photon meets on its way.
#pragma once

#include "nephroid/transport/walk.hpp"

#include "nephroid/vector/frame.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::tests {

template <class T>
using Vec = glm::vec<3, T>;

/// Draws the same number again and again, and counts.
struct Constant {
    double value = 0.5;
    int drawn = 0;
    template <class T>
    T next() {
        ++drawn;
        return static_cast<T>(value);
    }
};

/// A disk, or a plane, that does one thing.
template <class T, class F = T>
struct Sheet {
    Vec<T> centre, normal;
    Event event = Event::deposit;
    F weight{1};
    T index_in_front = 1, index_behind = 1; ///< of refraction; in front is where the normal points
    T radius = 0;                           ///< 0: without end
};

/// The nearest sheet along a ray, in the plainest way.
template <class T, class F = T>
struct SheetScene {
    using V = Vec<T>;
    std::vector<Sheet<T, F>> sheets;

    [[nodiscard]] std::optional<SurfaceHit<V, Flat>> intersect(const V& o, const V& d, T t_min, T t_max) const {
        std::optional<SurfaceHit<V, Flat>> nearest;
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            const V& n = sheets[i].normal;
            const T distance = dot(n, V(sheets[i].centre - o)) / dot(n, d);
            if (!(distance > t_min && distance < t_max))
                continue;
            const V p = o + distance * d;
            if (sheets[i].radius > T(0) && !(length(V(p - sheets[i].centre)) <= sheets[i].radius))
                continue;
            t_max = distance;
            nearest = {distance, p, n, n, Flat{}, rounding_error(o, distance, p), i};
        }
        return nearest;
    }

    template <class Sampler>
    [[nodiscard]] Scattering<F, T> scatter(const SurfaceHit<V, Flat>& hit, const V& d, Sampler&) const {
        const Sheet<T, F>& sheet = sheets[hit.surface];
        const bool from_front = dot(d, sheet.normal) < T(0);
        const T eta =
            from_front ? sheet.index_in_front / sheet.index_behind : sheet.index_behind / sheet.index_in_front;
        return {sheet.event, sheet.weight, eta};
    }
};

/// A photon of flux 1 with two tangents of unit length across its direction, by position or by direction.
template <class T, class F = T>
[[nodiscard]] Photon<Vec<T>, F> collimated(const Vec<T>& position, const Vec<T>& direction, F flux = F(1)) {
    const Vec<T> d = normalize(direction), zero{0, 0, 0};
    const auto [u, v] = frame_about(d);
    return {position, d, flux, {Tangent<Vec<T>>{u, zero}, Tangent<Vec<T>>{v, zero}}};
}
template <class T, class F = T>
[[nodiscard]] Photon<Vec<T>, F> from_point(const Vec<T>& position, const Vec<T>& direction, F flux = F(1)) {
    const Vec<T> d = normalize(direction), zero{0, 0, 0};
    const auto [u, v] = frame_about(d);
    return {position, d, flux, {Tangent<Vec<T>>{zero, u}, Tangent<Vec<T>>{zero, v}}};
}

template <class V>
void check_close(const V& a, const V& b, double tolerance) {
    CAPTURE(double(a.x));
    CAPTURE(double(a.y));
    CAPTURE(double(a.z));
    CAPTURE(double(b.x));
    CAPTURE(double(b.y));
    CAPTURE(double(b.z));
    CHECK(std::abs(double(a.x) - double(b.x)) <= tolerance);
    CHECK(std::abs(double(a.y) - double(b.y)) <= tolerance);
    CHECK(std::abs(double(a.z) - double(b.z)) <= tolerance);
}

/// Nothing is lost: the flux emitted is that of all fates, and so is the number of photons. What was deposited but not
/// booked yet is passed.
inline void check_balance(const Statistics& account, double deposited_flux = 0, std::uint64_t deposited = 0) {
    CHECK(std::isfinite(account.emitted.flux));
    CHECK(std::abs(account.accounted_flux() + deposited_flux - account.emitted.flux) <= 1e-12 * account.emitted.flux);
    std::uint64_t photons = deposited;
    for (const Tally& tally : account.fates) {
        CHECK(std::isfinite(tally.flux));
        photons += tally.photons;
    }
    CHECK(photons == account.emitted.photons);
}

} // namespace nephroid::tests
