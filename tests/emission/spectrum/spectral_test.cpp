// SPDX-License-Identifier: MIT
#include "nephroid/emission/spectrum/spectral.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/light_set.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::spectral_test {

namespace {

using V = glm::vec3;
using Four = Bands<float, 4>;
using Sun = DirectionalLight<V, Four>;

const HaltonSequence halton;

Sun sun() { return Sun({.direction = {0.1f, 0, -1}, .irradiance = Four(2), .patch = BoundingSphere<V>{{0, 0, 1}, 1}}); }

} // namespace

static_assert(Light<Spectral<Sun, EqualBands<4>>>);
static_assert(Flux<Four> && ScalesFlux<Four, float>);
static_assert(DividesSpectrum<EqualBands<3>> && !DividesSpectrum<int>);

TEST_CASE("spectral: photons are the light's own, with a wavelength each and a tangent that is zero") {
    const Spectral light(sun(), EqualBands<4>{380, 780});
    static_assert(decltype(light)::domain.coordinates == 2);
    static_assert(decltype(light)::domain.extras[0] == EmissionExtra::wavelength);
    CHECK(light.exact_domain().kinks == sun().exact_domain().kinks);
    CHECK(light.power() == sun().power());
    const Spread<float> spread{100, 8};
    std::array<int, 4> in_band{};
    for (std::uint64_t i = 0; i < 400; ++i) {
        Sampler own(halton, i), of_sun(halton, i);
        const auto photon = light.emit(own, spread);
        const auto expected = sun().emit(of_sun, spread);
        CHECK(photon.position == expected.position);
        CHECK(photon.direction == expected.direction);
        CHECK(photon.flux == expected.flux);
        for (std::size_t t = 0; t < 2; ++t)
            CHECK(photon.differential[t].d_position == expected.differential[t].d_position);
        CHECK(photon.differential[2].d_position == V(0));
        CHECK(photon.differential[2].d_direction == V(0));
        const double at = photon.parameters.spectrum.coordinate(photon.parameters.wavelength);
        CHECK(photon.parameters.wavelength >= 380);
        CHECK(photon.parameters.wavelength < 780);
        ++in_band[std::size_t(at)];
    }
    for (const int count : in_band) // by the fifth of Halton's bases each quarter of the spectrum gets a quarter
        CHECK(std::abs(count - 100) <= 5);
}

TEST_CASE("spectral: a set of lights stays a set and each of its lights keeps its domain") {
    using Set = LightSet<Sun, PointLight<V, Four>>;
    const Set set({sun(), PointLight<V, Four>({.position = {0, 0, 4}, .intensity = Four(1)})});
    const Spectral light(set, EqualBands<4>{});
    static_assert(Light<Spectral<Set, EqualBands<4>>>);
    static_assert(detail::emission_domains<Spectral<Set, EqualBands<4>>>.two);
    Sampler a(halton, 77), b(halton, 77);
    const auto drawn = detail::draw_point(light, a), of_set = detail::draw_point(set, b);
    CHECK(drawn.light == of_set.light);
    CHECK(drawn.at == of_set.at);
}

TEST_CASE("spectral: a spectrum that does not rise or is not positive is refused") {
    for (const EqualBands<4>& wrong : {EqualBands<4>{700, 400}, EqualBands<4>{0, 700}, EqualBands<4>{400, 400},
                                       EqualBands<4>{400, std::numeric_limits<double>::infinity()}})
        CHECK_THROWS_WITH_AS(Spectral(sun(), wrong), doctest::Contains("wavelengths must be positive"),
                             std::invalid_argument);
}

TEST_CASE("bands: they add and multiply one by one, and their power is the mean") {
    Bands<double, 3> a(2), b(0);
    b[0] = 1, b[1] = 2, b[2] = 6;
    CHECK((a + b)[1] == 4);
    CHECK((a * b)[2] == 12);
    CHECK((b * 0.5)[0] == 0.5);
    CHECK(flux_traits<Bands<double, 3>>::power(b) == 3);
    CHECK(flux_traits<Bands<double, 3>>::zero() == Bands<double, 3>(0));
}

TEST_CASE("equal bands: wavelength and coordinate are inverses, and what lies outside counts as the end") {
    const EqualBands<16> spectrum{400, 700};
    for (double c = 0; c <= 16; c += 0.25)
        CHECK(spectrum.coordinate(spectrum.wavelength(c)) == doctest::Approx(c).epsilon(1e-14));
    CHECK(spectrum.coordinate(100) == 0);
    CHECK(spectrum.coordinate(5000) == 16);
    CHECK(spectrum.wavelength(1) == 418.75);
}

// Exact for Cauchy's index A + B/λ²: the steps times ∂n/∂λ = −2B/λ³ are the indices' difference.
TEST_CASE("wavelength: steps along the tangent are linear in the index") {
    const double b = 15989, from = 480;
    Wavelength<EqualBands<16>> photon{from, {}};
    for (const double to : {400., 479., 480., 600., 700.})
        CHECK(photon.steps_to(to) * (-2 * b / (from * from * from)) ==
              doctest::Approx(b / (to * to) - b / (from * from)).epsilon(1e-13));
    photon.meet_glass(0.5, 1e-3); // no wavelength so short that 500 steps lead to it: 1 − 2 steps/λ is positive
    CHECK(photon.longest == std::numeric_limits<double>::infinity());
    CHECK(photon.shortest == doctest::Approx(from / std::sqrt(1 + 1000 / from)));
    CHECK(photon.steps_to(photon.shortest) == doctest::Approx(-500));
    photon.meet_glass(0.5, -1e-3); // towards red no wavelength is 500 steps away: steps are below λ/2
    CHECK(photon.longest == std::numeric_limits<double>::infinity());
    photon.meet_glass(0.5, 0);
    CHECK(photon.longest == std::numeric_limits<double>::infinity());
    photon.meet_glass(-0.01, 1e-4);
    CHECK(photon.steps_to(photon.longest) == doctest::Approx(100));
}

} // namespace nephroid::tests::spectral_test
