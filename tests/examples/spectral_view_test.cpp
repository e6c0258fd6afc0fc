// SPDX-License-Identifier: MIT
#include "common/spectral_view.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <memory>

namespace nephroid::tests::spectral_view_test {

namespace {

using namespace nephroid::examples;
constexpr std::size_t bands = 16;
using Color = glm::vec3;

/// Draws one half.
struct Half {
    template <class T>
    T next() {
        return T(0.5);
    }
};

/// Draws one half, but for the third number, which is the wavelength's.
struct Third {
    double number;
    int drawn = 0;
    template <class T>
    T next() {
        return T(++drawn == 3 ? number : 0.5);
    }
};

void check_near(const Color& a, const Color& b, double tolerance) {
    for (int i = 0; i < 3; ++i)
        CHECK(std::abs(double(a[i]) - double(b[i])) <= tolerance);
}

} // namespace

// The tables of CIE 1931 at these wavelengths; the fit's authors give 0.005 to 0.04 as its largest errors.
TEST_CASE("CIE 1931: the fit is close to the tables") {
    struct Row {
        double wavelength, x, y, z;
    };
    for (const Row& row :
         {Row{450, 0.3362, 0.0380, 1.7721}, Row{500, 0.0049, 0.3230, 0.2720}, Row{555, 0.5121, 1.0000, 0.0057},
          Row{600, 1.0622, 0.6310, 0.0008}, Row{650, 0.2835, 0.1070, 0.0000}}) {
        const glm::dvec3 fit = cie_1931(row.wavelength);
        CHECK(std::abs(fit.x - row.x) <= 0.04);
        CHECK(std::abs(fit.y - row.y) <= 0.02);
        CHECK(std::abs(fit.z - row.z) <= 0.04);
    }
}

TEST_CASE("spectral colour: equal bands are white, and colours that are not too saturated come back") {
    const SpectralColor<bands> colors{EqualBands<bands>{}};
    check_near(colors.color_of(Bands<float, bands>(0.75f)), Color(0.75f), 1e-6);
    for (const Color& color : {Color(1), Color(0.2f), Color(0.8f, 0.6f, 0.5f), Color(0.3f, 0.5f, 0.6f)}) {
        check_near(colors.color_of(colors.bands_of(color)), color, 1e-5);
        for (std::size_t b = 0; b < bands; ++b)
            CHECK(colors.bands_of(color)[b] >= 0);
    }
    for (std::size_t b = 0; b < bands; ++b)
        CHECK(std::abs(colors.bands_of(Color(1))[b] - 1) <= 1e-5f);
    // Blue is at the short end and red at the long one, where green is least.
    Bands<float, bands> blue, red;
    blue[2] = red[13] = 1;
    CHECK(colors.color_of(blue).z > colors.color_of(blue).x);
    CHECK(colors.color_of(red).x > colors.color_of(red).z);
    CHECK(colors.color_of(red).x > colors.color_of(red).y);
}

TEST_CASE("spectral colour: what is outside of sRGB is mixed with grey of its luminance") {
    const Color inside(0.2f, 0, 1), outside(-0.2f, 0.5f, 0.1f);
    CHECK(within_srgb(inside) == inside);
    const Color mixed = within_srgb(outside);
    const auto luminance = [](const Color& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; };
    CHECK(luminance(mixed) == doctest::Approx(luminance(outside)).epsilon(1e-5));
    CHECK(mixed.x >= 0);
    CHECK(mixed.y > mixed.z);
    check_near(within_srgb({-1, -1, -1}), Color(0), 0);
}

TEST_CASE("spectral view: glass bends each photon as its wavelength asks, and colours are in its bands") {
    Material<Color> glass = Material<Color>::dielectric(1.6, false);
    glass.dispersion = 1;
    glass.color = {0.8f, 0.6f, 0.5f};
    const examples::Scene<float, Color> scene({{Floor<float>(0), 0}, {Floor<float>(-1), 1}},
                                              {glass, Material<Color>::diffuse(Color(1))});
    const SpectralColor<bands> colors{EqualBands<bands>{}};
    const SpectralView<bands> view(scene, colors);
    const DirectionalLight<Color, Color> sun(
        {.direction = {1, 0, -1}, .irradiance = Color(2), .patch = BeamDisk<Color>{{-1, 0, 1}, 0.01f}});
    const auto shared = std::make_shared<const SpectralColor<bands>>(colors);
    const Spectral light(InBands<DirectionalLight<Color, Color>, bands>(sun, shared), EqualBands<bands>{});
    CHECK(light.power() == sun.power());
    for (int i = 0; i < 8; ++i) {
        Third sampler{(i + 0.5) / 8};
        auto photon = light.emit(sampler, {1, 1});
        Half half;
        Statistics account;
        const auto deposit = walk(view, photon, half, {}, account);
        REQUIRE(deposit);
        const double n = glass.index_at(photon.parameters.wavelength).value, s = std::sqrt(0.5) / n;
        const double tangent = s / std::sqrt(1 - s * s);
        CHECK(deposit->position.x == doctest::Approx(tangent).epsilon(1e-4));
        // dx/dλ = dx/dn ∂n/∂λ, x = tan asin(s), ds/dn = −s/n.
        const double expected = -s / n / std::pow(1 - s * s, 1.5) * glass.index_at(photon.parameters.wavelength).slope;
        CHECK(deposit->d_position[2].x == doctest::Approx(expected).epsilon(1e-4));
        check_near(colors.color_of(deposit->flux), glass.color * colors.color_of(photon.flux), 1e-3);
    }
}

} // namespace nephroid::tests::spectral_view_test
