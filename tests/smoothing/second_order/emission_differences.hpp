// SPDX-License-Identifier: MIT
/// @file  The map from light to surface about one photon, differentiated by differences in wide precision: the whole
///        path is followed again for photons next to it. Shares no formula with the library.
#pragma once

#include "support/space.hpp"

#include "nephroid/emission/photon.hpp"
#include "nephroid/emission/spread.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"

#include <array>
#include <cmath>

namespace nephroid::tests {

using namespace detail;

/// Calls visit(photon, its sampler after emission) for the first of 1000 photons of a light.
template <class L, class Visit>
void for_photons(const L& light, const Visit& visit) {
    const HaltonSequence sequence(1);
    for (std::uint64_t i = 0; i < 8; ++i) {
        Sampler<HaltonSequence> sampler(sequence, i);
        const auto photon = light.emit(sampler, Spread<double>{1000, 1});
        visit(photon, sampler);
    }
}

/// A ray in wide precision.
struct WideRay {
    Space origin, direction;
};

/// The rays of a photon's neighbours at emission: half of each tangent is one unit, directions stay of unit length.
class Neighbours {
public:
    template <Vector3 V, Flux F, std::size_t N>
    explicit Neighbours(const Photon<V, F, N>& photon)
        : origin_(widen(photon.position)), direction_(widen(photon.direction).unit()) {
        for (std::size_t a = 0; a < 2; ++a) {
            d_origin_[a] = Wide(0.5) * widen(photon.differential[a].d_position);
            d_direction_[a] = Wide(0.5) * widen(photon.differential[a].d_direction);
        }
    }

    [[nodiscard]] WideRay at(const Wide& u, const Wide& v) const {
        const Space aside = u * d_direction_[0] + v * d_direction_[1];
        return {origin_ + u * d_origin_[0] + v * d_origin_[1], aside + sqrt(Wide(1) - aside.dot(aside)) * direction_};
    }

private:
    Space origin_, direction_;
    std::array<Space, 2> d_origin_, d_direction_;
};

/// ∂^(nu + nv) F / ∂u^nu ∂v^nv at 0 by central differences of step h, nested: wrong by the order of h² alone,
/// and by 2^-112 / h^(nu + nv) for rounding.
template <class Map>
[[nodiscard]] Space derivative_of(const Map& map, int nu, int nv, const Wide& u = Wide(0), const Wide& v = Wide(0)) {
    const Wide h(1e-5);
    if (nu > 0)
        return Wide(0.5) / h * (derivative_of(map, nu - 1, nv, u + h, v) - derivative_of(map, nu - 1, nv, u - h, v));
    if (nv > 0)
        return Wide(0.5) / h * (derivative_of(map, nu, nv - 1, u, v + h) - derivative_of(map, nu, nv - 1, u, v - h));
    return map(u, v);
}

[[nodiscard]] inline Double3 narrowed(const Space& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// @param end  Space(WideRay): where a ray ends, in wide precision
template <class End>
[[nodiscard]] PathDerivatives derivatives_by_differences(const Neighbours& neighbours, const End& end) {
    const auto by = [&](int nu, int nv) {
        return narrowed(derivative_of([&](const Wide& u, const Wide& v) { return end(neighbours.at(u, v)); }, nu, nv));
    };
    return {{by(1, 0), by(0, 1)}, {by(2, 0), by(1, 1), by(0, 2)}, {by(3, 0), by(2, 1), by(1, 2), by(0, 3)}};
}

/// The largest difference between two sets of derivatives, relative to the largest of the second set.
template <std::size_t N>
[[nodiscard]] double relative_difference(const std::array<Double3, N>& a, const std::array<Double3, N>& b) {
    double furthest = 0, largest = 0;
    for (std::size_t i = 0; i < N; ++i) {
        furthest = (std::max)(furthest, std::sqrt(inner(a[i] - b[i], a[i] - b[i])));
        largest = (std::max)(largest, std::sqrt(inner(b[i], b[i])));
    }
    return furthest / largest;
}

} // namespace nephroid::tests
