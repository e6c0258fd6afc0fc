// SPDX-License-Identifier: MIT
#include "common/texture.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <array>
#include <vector>

namespace nephroid::examples::texture_test {

namespace {

using Rgba = std::array<std::uint8_t, 4>;

Texture texture_of(std::size_t width, std::size_t height, const std::vector<Rgba>& texels) {
    Texture texture;
    texture.image.width = width;
    texture.image.height = height;
    for (const Rgba& texel : texels)
        texture.image.rgba.insert(texture.image.rgba.end(), texel.begin(), texel.end());
    return texture;
}

double distance(const glm::dvec4& a, const glm::dvec4& b) { return glm::length(a - b); }

constexpr double few_roundings = 1e-12;

} // namespace

TEST_CASE("texture: the middle of a texel has its value, and values are interpolated between middles") {
    Texture t = texture_of(2, 2, {{255, 0, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 0}, {51, 51, 51, 255}});
    CHECK(distance(t.data({0.25, 0.25}), {1, 0, 0, 1}) < few_roundings); // the upper left one
    CHECK(distance(t.data({0.75, 0.25}), {0, 1, 0, 1}) < few_roundings);
    CHECK(distance(t.data({0.25, 0.75}), {0, 0, 1, 0}) < few_roundings);
    CHECK(distance(t.data({0.5, 0.25}), {0.5, 0.5, 0, 1}) < few_roundings);
    CHECK(distance(t.data({0.5, 0.5}), glm::dvec4(1.2, 1.2, 1.2, 3) / 4.0) < few_roundings);
    t.takes_nearest = true;
    CHECK(distance(t.data({0.49, 0.49}), {1, 0, 0, 1}) < few_roundings);
    CHECK(distance(t.data({0.51, 0.49}), {0, 1, 0, 1}) < few_roundings);
}

TEST_CASE("texture: colours are decoded from sRGB before they are interpolated, opacity and data are not") {
    const Texture t = texture_of(1, 1, {{188, 10, 255, 128}});
    // IEC 61966-2-1: ((188/255 + 0.055)/1.055)^2.4 and 10/255/12.92, to six digits
    CHECK(distance(t.color({0.5, 0.5}), {0.502886, 0.00303527, 1, 128.0 / 255}) < 1e-6);
    CHECK(t.data({0.5, 0.5}).x == doctest::Approx(188.0 / 255));
    const Texture two = texture_of(2, 1, {{0, 0, 0, 255}, {255, 255, 255, 255}});
    CHECK(two.color({0.5, 0.5}).x == doctest::Approx(0.5)); // not sRGB's 0.214
}

TEST_CASE("texture: beyond its borders it is repeated, mirrored or clamped") {
    Texture t = texture_of(4, 1, {{0, 0, 0, 255}, {51, 0, 0, 255}, {102, 0, 0, 255}, {255, 0, 0, 255}});
    const auto red = [&](double u) { return t.data({u, 0.5}).x; };
    CHECK(red(1.125) == doctest::Approx(0));
    CHECK(red(-0.125) == doctest::Approx(1));
    CHECK(red(-2.625) == doctest::Approx(red(0.375)));
    CHECK(red(0) == doctest::Approx(0.5)); // between the last and the first
    t.wrap_u = Texture::Wrap::mirror;
    CHECK(red(1.125) == doctest::Approx(1));
    CHECK(red(1.375) == doctest::Approx(0.4));
    CHECK(red(-0.125) == doctest::Approx(0));
    CHECK(red(2.125) == doctest::Approx(0));
    t.wrap_u = Texture::Wrap::clamp;
    CHECK(red(7) == doctest::Approx(1));
    CHECK(red(-7) == doctest::Approx(0));
    for (const double far : {1e30, -1e30, 1e300})
        for (const auto wrap : {Texture::Wrap::repeat, Texture::Wrap::mirror, Texture::Wrap::clamp}) {
            t.wrap_u = t.wrap_v = wrap;
            CHECK(red(far) >= 0); // some texel, and no crash
            CHECK(red(far) <= 1);
        }
}

TEST_CASE("texture: smooth lookups are exact for a ramp, and their slopes are differences of their values") {
    std::vector<Rgba> ramp, noise;
    for (int i = 0; i < 64; ++i) {
        ramp.push_back(
            {static_cast<std::uint8_t>(10 + 20 * (i % 8)), static_cast<std::uint8_t>(5 + 30 * (i / 8)), 0, 255});
        noise.push_back({static_cast<std::uint8_t>(i * 37 % 256), static_cast<std::uint8_t>(i * 91 % 256), 7, 255});
    }
    const auto smooth = texture_of(8, 8, ramp).smooth_data({0.4, 0.6});
    CHECK(smooth.value.x == doctest::Approx((10 + 20 * (0.4 * 8 - 0.5)) / 255)); // texel i's middle is at (i + 1/2)/8
    CHECK(smooth.d_u.x == doctest::Approx(20.0 * 8 / 255));
    CHECK(smooth.d_v.x == doctest::Approx(0));
    CHECK(smooth.d_v.y == doctest::Approx(30.0 * 8 / 255));
    const Texture rough = texture_of(8, 8, noise);
    for (const glm::dvec2& at : {glm::dvec2(0.3, 0.7), glm::dvec2(0.9, 0.05), glm::dvec2(0.25 + 1e-9, 0.5)}) {
        const double h = 1e-6; // rounding leaves 1e-16/h; where the spline's pieces meet, its third derivative h·8²
        const auto value = [&](double du, double dv) { return rough.smooth_data(at + h * glm::dvec2(du, dv)).value; };
        const auto s = rough.smooth_data(at);
        CHECK(distance(s.d_u, (value(1, 0) - value(-1, 0)) / (2 * h)) < 1e-4);
        CHECK(distance(s.d_v, (value(0, 1) - value(0, -1)) / (2 * h)) < 1e-4);
    }
}

} // namespace nephroid::examples::texture_test
