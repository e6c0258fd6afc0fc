// SPDX-License-Identifier: MIT
/// @file  Photons of an area light, carried to the plane z = 0 by maps of its four coordinates that are written out.
#pragma once

#include "nephroid/sequence/halton.hpp"
#include "nephroid/smoothing/second_order/area_cells.hpp"
#include "nephroid/smoothing/second_order/emission_cells.hpp"
#include "nephroid/vector/glm.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace nephroid::tests {

using namespace detail;

/// The first samples of a sequence.
template <class Sequence>
[[nodiscard]] std::vector<AreaSample> area_samples(std::size_t count) {
    const Sequence sequence(1);
    std::vector<AreaSample> result(count);
    for (std::size_t i = 0; i < count; ++i)
        for (std::uint32_t axis = 0; axis < 4; ++axis)
            result[i][axis] = sequence.template sample<double>(i, axis);
    return result;
}

using AreaPhoton = TracedPhoton<glm::dvec3, double, 2>;

/// Where a photon lands, and how that changes by place (first two) and direction (last two).
struct AreaLanding {
    glm::dvec3 position;
    std::array<glm::dvec3, 4> slopes;
    std::uint32_t signature = 1;
    bool is_lost = false;
};

/// The light's coordinates are `width` wide, from −width/2 on: its places, and its directions in the unit of 1/100.
struct AreaLamp {
    double width = 1;
    double unit = 0.01; ///< half a tangent's length, in the same coordinates
    double turn = 0;    ///< of the tangents about the ray, radians

    /// @param map  from the four coordinates to an AreaLanding
    template <class Map>
    [[nodiscard]] AreaPhoton photon(const Map& map, const AreaSample& sample) const {
        AreaSample u;
        for (std::size_t i = 0; i < 4; ++i)
            u[i] = width * (sample[i] - 0.5);
        constexpr double per_direction = 0.01;
        const double c = std::cos(turn), s = std::sin(turn);
        const auto tangent = [&](double x, double y) {
            return Tangent<glm::dvec3>{2 * unit * glm::dvec3(x, y, 0), 2 * unit * per_direction * glm::dvec3(x, y, 0)};
        };
        const Photon<glm::dvec3, double> emitted{
            {u[0], u[1], 1}, {per_direction * u[2], per_direction * u[3], -1}, 1, {tangent(c, s), tangent(-s, c)}};
        const AreaLanding landing = map(u);
        const EmissionSample drawn{{sample[0], sample[1]}, 0, 4, {sample[2], sample[3]}};
        if (landing.is_lost)
            return {drawn, EmissionFrame(emitted), landing.signature, std::nullopt};
        const glm::dvec3 along_u = landing.slopes[0] + landing.slopes[2],
                         along_v = landing.slopes[1] + landing.slopes[3];
        return {drawn, EmissionFrame(emitted), landing.signature,
                Deposit<glm::dvec3, double, 2>{
                    landing.position,
                    {0, 0, 1},
                    {0, 0, -1},
                    1,
                    {2 * unit * (c * along_u + s * along_v), 2 * unit * (c * along_v - s * along_u)}}};
    }

    template <class Map>
    [[nodiscard]] std::vector<AreaPhoton> photons(const Map& map, std::size_t count) const {
        std::vector<AreaPhoton> result;
        for (const AreaSample& sample : area_samples<HaltonSequence>(count))
            result.push_back(photon(map, sample));
        return result;
    }
};

/// F = (p_x² + p_y² + d_x², d_y): light from a sphere of emission points meets at each point of the floor, so that
/// the irradiance is 2π sqrt(x), and a constant along y. Its borders are far.
[[nodiscard]] inline AreaLanding spheres(const AreaSample& u) {
    return {{u[0] * u[0] + u[1] * u[1] + u[2] * u[2], u[3], 0},
            {{{2 * u[0], 0, 0}, {2 * u[1], 0, 0}, {2 * u[2], 0, 0}, {0, 1, 0}}}};
}

} // namespace nephroid::tests
