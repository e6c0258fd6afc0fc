// SPDX-License-Identifier: MIT
/// @file  The floor's raster, and the two rivals that draw onto it by themselves: plain dots, and disks whose size
///        follows a thin lens [Wyman and Dachsbacher 2008].
#pragma once

#include "lamp.hpp"
#include "scenes.hpp"

#include <nephroid/sequence/r2.hpp>
#include <nephroid/transport/flight.hpp>
#include <nephroid/transport/walk.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::examples::web {

/// The square |x|, |y| <= half of the floor, as size × size pixels of irradiance.
struct Raster {
    std::size_t size;
    float half;
    std::vector<float> pixels;

    Raster(std::size_t pixels_a_side, float half_side) : size(pixels_a_side), half(half_side), pixels(size * size) {}

    [[nodiscard]] float pixel() const { return 2 * half / float(size); }
    /// Where a coordinate lies, in pixels from the border.
    [[nodiscard]] float place(float coordinate) const { return (coordinate + half) / pixel(); }
    [[nodiscard]] Vec middle(std::size_t i, std::size_t j) const {
        return {(float(i) + 0.5f) * pixel() - half, (float(j) + 0.5f) * pixel() - half, 0};
    }

    /// Adds a photon to the pixel that it falls into.
    void dot(const Vec& at, float flux) {
        const float x = std::floor(place(at.x)), y = std::floor(place(at.y)), end = float(size);
        if (x >= 0 && y >= 0 && x < end && y < end)
            pixels[std::size_t(y) * size + std::size_t(x)] += flux / (pixel() * pixel());
    }

    /// Adds a photon as a disk with a biweight profile.
    ///
    /// @param radius  world units, > 0
    void disk(const Vec& at, float radius, float flux) {
        const float x = place(at.x) - 0.5f, y = place(at.y) - 0.5f, r = radius / pixel(), last = float(size) - 1;
        if (!(x + r >= 0 && y + r >= 0 && x - r <= last && y - r <= last))
            return;
        const auto first = [](float from) { return std::size_t(std::ceil((std::max)(from, 0.f))); };
        const auto end = [&](float to) { return std::size_t((std::min)(std::floor(to), last)) + 1; };
        const float inverse2 = 1 / (r * r), peak = flux * 3 / (pi<float> * radius * radius);
        for (std::size_t j = first(y - r); j < end(y + r); ++j) {
            float* const row = pixels.data() + j * size;
            const float dy = float(j) - y, dy2 = dy * dy * inverse2;
            for (std::size_t i = first(x - r); i < end(x + r); ++i) {
                const float dx = float(i) - x, rest = (std::max)(1 - dx * dx * inverse2 - dy2, 0.f);
                row[i] += peak * rest * rest;
            }
        }
    }
};

/// A visitor that notes what the thin lens needs: how far the first surface is, how far the light flies after it, and
/// the power of all surfaces together. Each is taken for a spherical one with the mean of its two curvatures.
struct ThinLens {
    const Scene& scene;
    float front = 0, behind = 0; ///< world units
    float power = 0;             ///< 1 / world unit
    float medium = 1;            ///< the index where the light is

    template <class Flight>
    void flight(const Flight& flight) {
        (flight.specular_events == 0 ? front : behind) += flight.distance;
    }
    void meet(const Hit& hit, bool from_front, bool passed) {
        if (hit.surface == the_floor)
            return;
        const auto& turn = hit.curvature;
        const float mean = 0.5f * (turn.column_x.x + turn.column_y.y + turn.column_z.z);
        const float bulge = from_front ? mean : -mean; // above 0 where the surface bulges towards the light
        const Media media = scene.media(hit.surface);
        const float behind_it = from_front ? media.back : media.front;
        power += passed ? (behind_it - medium) * bulge : -2 * medium * bulge;
        if (passed)
            medium = behind_it;
    }

    /// How much wider the beam is on the floor than at the first surface.
    [[nodiscard]] float widening() const { return std::abs(1 - behind * (power - 1 / front) / medium); }
};

/// Follows the lamp's photons, and calls draw(deposit, lens, half_angle) for each that met a mirror or glass. The half
/// angle is that of the cone that the photon stands for, times the smoothing.
template <class Draw>
void trace_rivals(const Scene& scene, const PointThroughOpenings& lamp, std::uint64_t count, float smoothing,
                  const WalkLimits& limits, Statistics& account, const Draw& draw) {
    const R2Sequence sequence;
    for (std::uint64_t i = 0; i < count; ++i) {
        Sampler<R2Sequence> sampler(sequence, i);
        const auto photon = lamp.emit(sampler, Spread<float>{float(count), smoothing});
        ThinLens lens{scene};
        const auto deposit = walk(scene, Photon<Vec, float, 0>{photon.position, photon.direction, photon.flux, {}},
                                  sampler, limits, account, lens);
        if (deposit)
            draw(*deposit, lens, 0.5f * glm::length(photon.differential[0].d_direction));
    }
}

} // namespace nephroid::examples::web
