// SPDX-License-Identifier: MIT
#include "nephroid/emission/flux.hpp"

#include "support/glass_ball.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace {

/// As a renderer writes its colours: not a vector, with a member for its brightness.
struct Colour {
    float r, g, b;

    [[nodiscard]] float luminance() const { return 0.2126f * r + 0.7152f * g + 0.0722f * b; }
    friend Colour operator+(const Colour& x, const Colour& y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
    friend Colour operator*(const Colour& x, const Colour& y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
    friend Colour operator*(const Colour& x, float s) { return {x.r * s, x.g * s, x.b * s}; }
};

/// N bands.
template <std::size_t N>
struct Spectrum {
    std::array<float, N> bands{};

    friend Spectrum operator+(Spectrum a, const Spectrum& b) {
        for (std::size_t i = 0; i < N; ++i)
            a.bands[i] += b.bands[i];
        return a;
    }
    friend Spectrum operator*(Spectrum a, const Spectrum& b) {
        for (std::size_t i = 0; i < N; ++i)
            a.bands[i] *= b.bands[i];
        return a;
    }
    friend Spectrum operator*(Spectrum a, float s) {
        for (float& band : a.bands)
            band *= s;
        return a;
    }
};

struct NotLight {};

} // namespace

template <>
struct nephroid::flux_traits<Colour> {
    static double power(const Colour& c) { return double(c.luminance()); }
    static Colour zero() { return {0, 0, 0}; }
};

template <std::size_t N>
struct nephroid::flux_traits<Spectrum<N>> {
    static double power(const Spectrum<N>& s) {
        double sum = 0;
        for (const float band : s.bands)
            sum += double(band);
        return sum / double(N);
    }
    static Spectrum<N> zero() { return {}; }
};

namespace nephroid::tests::flux_test {
namespace {

static_assert(Flux<float> && Flux<double> && Flux<glm::vec3> && Flux<glm::dvec3> && Flux<Colour> && Flux<Spectrum<31>>);
static_assert(!Flux<int> && !Flux<NotLight> && !Flux<std::string> && !Flux<const float> && !Flux<float&>);
static_assert(ScalesFlux<float, float> && ScalesFlux<Colour, float> && ScalesFlux<Spectrum<4>, float>);
static_assert(!ScalesFlux<NotLight, float>);

using V = glm::vec3;

/// The caustic of glass whose tint is 1 - i/100 in band i, in monochrome.
std::vector<float> band(std::size_t i) {
    return tests::caustic_of(tests::GlassBall<V, float>{.tint = 1 - float(i) / 100}, 1.0f, 12, 300);
}

// Rays do not depend on the flux, and a band's flux goes through the same products and sums in all types; a compiler
// may contract some of them: two roundings in each part of a sum.
constexpr float tolerance = 4 * std::numeric_limits<float>::epsilon();

TEST_CASE("flux: a colour of the renderer's own makes the caustics of its components") {
    const auto coloured =
        tests::caustic_of(tests::GlassBall<V, Colour>{.tint = {1, 0.99f, 0.9f}}, Colour{1, 1, 1}, 12, 300);
    const std::vector<float> red = band(0), green = band(1), blue = band(10);
    float brightest = 0;
    for (std::size_t i = 0; i < coloured.size(); ++i) {
        CHECK(std::abs(coloured[i].r - red[i]) <= tolerance * red[i]);
        CHECK(std::abs(coloured[i].g - green[i]) <= tolerance * green[i]);
        CHECK(std::abs(coloured[i].b - blue[i]) <= tolerance * blue[i]);
        brightest = (std::max)(brightest, red[i]);
    }
    CHECK(brightest > 2);
}

TEST_CASE("flux: a spectrum of 31 bands makes the caustic of each of its bands") {
    using Bands = Spectrum<31>;
    Bands tint, sun;
    for (std::size_t i = 0; i < 31; ++i) {
        tint.bands[i] = 1 - float(i) / 100;
        sun.bands[i] = 1;
    }
    const auto all = tests::caustic_of(tests::GlassBall<V, Bands>{.tint = tint}, sun, 12, 300);
    for (const std::size_t i : std::array<std::size_t, 3>{0, 7, 30}) {
        const std::vector<float> one = band(i);
        for (std::size_t k = 0; k < one.size(); ++k)
            CHECK(std::abs(all[k].bands[i] - one[k]) <= tolerance * one[k]);
    }
}

TEST_CASE("flux: the power of the library's own is their value and their components' mean") {
    CHECK(flux_traits<float>::power(2.5f) == 2.5);
    CHECK(flux_traits<double>::power(flux_traits<double>::zero()) == 0);
    CHECK(flux_traits<glm::vec3>::power({1, 2, 6}) == 3);
    CHECK(flux_traits<glm::dvec3>::zero() == glm::dvec3(0, 0, 0));
}

} // namespace
} // namespace nephroid::tests::flux_test
