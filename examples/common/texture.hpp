// SPDX-License-Identifier: MIT
/// @file  An image on a surface: looked up by texture coordinates, wrapped at its borders, interpolated between texels.
#pragma once

#include "common/image/decode.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nephroid::examples {

/// Linear light from 8 bits of sRGB. Source: IEC 61966-2-1.
[[nodiscard]] inline double linear_from_srgb(std::uint8_t level) {
    static const std::array<double, 256> table = [] {
        std::array<double, 256> result{};
        for (std::size_t i = 0; i < result.size(); ++i) {
            const double value = double(i) / 255;
            result[i] = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        }
        return result;
    }();
    return table[level];
}

/// An image, and how it goes on beyond its borders. Coordinates are glTF's: (0, 0) is the upper left corner, (1, 1) the
/// lower right one. There are no smaller copies of the image for distant surfaces: a pixel's samples average it.
struct Texture {
    enum class Wrap : unsigned char { repeat, mirror, clamp };

    DecodedImage image; ///< with at least one texel
    Wrap wrap_u = Wrap::repeat, wrap_v = Wrap::repeat;
    bool takes_nearest = false; ///< the nearest texel alone, instead of an interpolation between four

    /// Red, green, blue and opacity, each 0 to 1, as the file has them.
    [[nodiscard]] glm::dvec4 data(const glm::dvec2& uv) const { return look_up(uv, &Texture::data_texel); }

    /// The same with the colours decoded from sRGB to linear light, each texel before the interpolation.
    [[nodiscard]] glm::dvec4 color(const glm::dvec2& uv) const { return look_up(uv, &Texture::color_texel); }

    /// What `data` returns, and its derivatives by the coordinates.
    struct Smooth {
        glm::dvec4 value, d_u, d_v;
    };
    /// Interpolates by quadratic splines instead, because the derivative of a normal is a curvature, which should not
    /// jump from texel to texel. Exact where the texels are linear.
    [[nodiscard]] Smooth smooth_data(const glm::dvec2& uv) const {
        const double x = uv.x * double(image.width), y = uv.y * double(image.height); // texel i's middle is at i + 1/2
        const double i = std::floor(x), j = std::floor(y);
        const auto weights = [](double a) {
            return glm::dvec3(0.5 * (1 - a) * (1 - a), 0.5 + a * (1 - a), 0.5 * a * a);
        };
        const auto slopes = [](double a) { return glm::dvec3(a - 1, 1 - 2 * a, a); };
        const glm::dvec3 wx = weights(x - i), wy = weights(y - j), dx = slopes(x - i), dy = slopes(y - j);
        Smooth result{glm::dvec4(0), glm::dvec4(0), glm::dvec4(0)};
        for (int b = 0; b < 3; ++b)
            for (int a = 0; a < 3; ++a) {
                const glm::dvec4 texel = data_texel(i + a - 1, j + b - 1);
                result.value += wx[a] * wy[b] * texel;
                result.d_u += dx[a] * wy[b] * double(image.width) * texel;
                result.d_v += wx[a] * dy[b] * double(image.height) * texel;
            }
        return result;
    }

private:
    [[nodiscard]] glm::dvec4 look_up(const glm::dvec2& uv,
                                     glm::dvec4 (Texture::*texel)(double i, double j) const) const {
        const double x = uv.x * double(image.width), y = uv.y * double(image.height);
        if (takes_nearest)
            return (this->*texel)(std::floor(x), std::floor(y));
        const double i = std::floor(x - 0.5), j = std::floor(y - 0.5), s = x - 0.5 - i, t = y - 0.5 - j;
        const glm::dvec4 upper = (1 - s) * (this->*texel)(i, j) + s * (this->*texel)(i + 1, j);
        const glm::dvec4 lower = (1 - s) * (this->*texel)(i, j + 1) + s * (this->*texel)(i + 1, j + 1);
        return (1 - t) * upper + t * lower;
    }

    [[nodiscard]] glm::dvec4 data_texel(double i, double j) const {
        const std::uint8_t* rgba = at(i, j);
        return glm::dvec4(rgba[0], rgba[1], rgba[2], rgba[3]) / 255.0;
    }
    [[nodiscard]] glm::dvec4 color_texel(double i, double j) const {
        const std::uint8_t* rgba = at(i, j);
        return {linear_from_srgb(rgba[0]), linear_from_srgb(rgba[1]), linear_from_srgb(rgba[2]), rgba[3] / 255.0};
    }

    /// A texel, by whole numbers that may lie beyond the borders.
    [[nodiscard]] const std::uint8_t* at(double i, double j) const {
        const std::size_t x = wrapped(i, image.width, wrap_u), y = wrapped(j, image.height, wrap_v);
        return image.rgba.data() + 4 * (y * image.width + x);
    }

    [[nodiscard]] static std::size_t wrapped(double i, std::size_t count, Wrap wrap) {
        const double n = double(count);
        const auto between_borders = [n](double place) {
            return static_cast<std::size_t>(place >= 0 ? (place <= n - 1 ? place : n - 1) : 0);
        };
        if (wrap == Wrap::clamp)
            return between_borders(i);
        const double period = wrap == Wrap::mirror ? 2 * n : n;
        const double rest = i - period * std::floor(i / period);
        return between_borders(rest < n ? rest : 2 * n - 1 - rest);
    }
};

/// How a material uses a texture.
struct TextureReference {
    std::size_t texture = 0; ///< its index
    std::size_t set = 0;     ///< of texture coordinates: 0 or 1
    /// KHR_texture_transform: the image is looked up at offset + u · column_u + v · column_v.
    glm::dvec2 offset{0}, column_u{1, 0}, column_v{0, 1};

    [[nodiscard]] glm::dvec2 transformed(const glm::dvec2& uv) const { return offset + transformed_change(uv); }
    /// Of a difference between coordinates.
    [[nodiscard]] glm::dvec2 transformed_change(const glm::dvec2& d_uv) const {
        return d_uv.x * column_u + d_uv.y * column_v;
    }
};

} // namespace nephroid::examples
