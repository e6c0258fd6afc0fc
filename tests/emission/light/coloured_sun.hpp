// SPDX-License-Identifier: MIT
/// @file  A renderer's own light that draws a wavelength besides its coordinates, and carries its tangent.
#pragma once

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/photon.hpp"

#include <cstddef>

namespace nephroid::tests {

/// A sun whose flux grows linearly along the spectrum, from zero. Three tangents: the last by wavelength, zero at the
/// lamp.
template <class V>
struct ColouredSun {
    using vector = V;
    using T = scalar_t<V>;
    using flux_type = T;
    static constexpr EmissionDomain domain{.coordinates = 2, .extras = {EmissionExtra::wavelength}};

    DirectionalLight<V, T> sun = above_a_ball();

    // Not as the member's initialiser, about which g++ 12 warns of a pointer that dangles.
    [[nodiscard]] static DirectionalLight<V, T> above_a_ball() {
        const BoundingSphere<V> ball{make_vector<V>(T(0), T(0), T(1.5)), T(1.25)};
        return DirectionalLight<V, T>(
            {.direction = make_vector<V>(T(0.1), T(0), T(-1)), .irradiance = 1, .patch = ball});
    }

    template <class S>
    [[nodiscard]] Photon<V, T, 3> emit(S& samples, const Spread<T>& spread) const {
        const auto photon = sun.emit(samples, spread);
        const T wavelength = samples.template next<T>(); // 0 is one end of the spectrum and 1 the other
        const Tangent<V> none{zero_vector<V>(), zero_vector<V>()};
        return {photon.position,
                photon.direction,
                photon.flux * wavelength,
                {photon.differential[0], photon.differential[1], none}};
    }
    [[nodiscard]] EmissionDomain exact_domain() const {
        EmissionDomain exact = domain_of(sun);
        exact.extras = domain.extras;
        return exact;
    }
    [[nodiscard]] double power() const { return sun.power(); }
};

} // namespace nephroid::tests
