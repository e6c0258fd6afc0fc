// SPDX-License-Identifier: MIT
/// @file  Photons of a directional light over a rectangle, carried to the plane z = 0 by maps that are written out.
#pragma once

#include "nephroid/sequence/halton.hpp"
#include "nephroid/smoothing/second_order/emission_cells.hpp"
#include "nephroid/vector/glm.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nephroid::tests {

using namespace detail;

using Samples = std::vector<std::array<double, 2>>;
using MapPhoton = TracedPhoton<glm::dvec3, double, 2>;

/// Where a photon lands, and how that changes with where it was emitted.
struct Landing {
    glm::dvec3 position, d_u, d_v;
    std::uint32_t signature = 1;
};

/// The middles of columns × rows cells.
[[nodiscard]] inline Samples lattice(std::size_t columns, std::size_t rows) {
    Samples samples;
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < columns; ++x)
            samples.push_back({(double(x) + 0.5) / double(columns), (double(y) + 0.5) / double(rows)});
    return samples;
}

[[nodiscard]] inline Samples halton(std::size_t count) {
    const HaltonSequence sequence(1);
    Samples samples;
    for (std::size_t i = 0; i < count; ++i)
        samples.push_back({sequence.sample<double>(i, 0), sequence.sample<double>(i, 1)});
    return samples;
}

/// u0 of N photons over an area.
[[nodiscard]] inline double unit_of(double photons, double area = 1) {
    return std::sqrt(area / (pi<double> * photons));
}

/// A photon as a lamp emits it with smoothing 1 above the point (width · sample 0, sample 1), and as it lands.
///
/// @param photons  emitted in all
/// @param turn     of its tangents, radians: a light may choose any orthogonal pair
template <class Map>
[[nodiscard]] MapPhoton photon_at(const Map& map, const std::array<double, 2>& sample, double photons, double width = 1,
                                  double turn = 0) {
    const double u = width * sample[0], v = sample[1], tangent = 2 * unit_of(photons, width);
    const double c = tangent * std::cos(turn), s = tangent * std::sin(turn);
    const glm::dvec3 zero(0);
    const Photon<glm::dvec3, double> emitted{
        {u, v, 1}, {0, 0, -1}, width / photons, {Tangent<glm::dvec3>{{c, s, 0}, zero}, {{-s, c, 0}, zero}}};
    const Landing landing = map(u, v);
    return {{sample, 0, 2},
            EmissionFrame(emitted),
            landing.signature,
            Deposit<glm::dvec3, double, 2>{landing.position,
                                           {0, 0, 1},
                                           {0, 0, -1},
                                           emitted.flux,
                                           {c * landing.d_u + s * landing.d_v, c * landing.d_v - s * landing.d_u}}};
}

/// The photon as if it had ended on its way.
[[nodiscard]] inline MapPhoton lost(const MapPhoton& photon) {
    return {photon.sample, photon.frame, photon.signature, std::nullopt};
}

/// @param photons  emitted in all; 0: as many as there are samples
template <class Map>
[[nodiscard]] std::vector<MapPhoton> photons_of(const Map& map, const Samples& samples, double photons = 0,
                                                double width = 1) {
    std::vector<MapPhoton> result;
    for (const auto& sample : samples)
        result.push_back(photon_at(map, sample, photons > 0 ? photons : double(samples.size()), width));
    return result;
}

/// A slant and a stretch.
[[nodiscard]] inline Landing affine(double u, double v) {
    return {{2 * u + 0.5 * v + 3, 0.25 * u - v, 0}, {2, 0.25, 0}, {0.5, -1, 0}};
}

/// F_uu = (0.8, −0.2), F_uv = (0.3, 0.1), F_vv = (−0.4, 0.6) everywhere.
[[nodiscard]] inline Landing quadratic(double u, double v) {
    return {{2 * u + 0.4 * u * u + 0.3 * u * v - 0.2 * v * v, 2 * v - 0.1 * u * u + 0.1 * u * v + 0.3 * v * v, 0},
            {2 + 0.8 * u + 0.3 * v, -0.2 * u + 0.1 * v, 0},
            {0.3 * u - 0.4 * v, 2 + 0.1 * u + 0.6 * v, 0}};
}

} // namespace nephroid::tests
