// SPDX-License-Identifier: MIT
/// @file  Waves on water: a height field of a few sines that move, which a ray from above meets once.
#pragma once

#include "geometry.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace nephroid::examples::web {

/// The sine and cosine of a phase in turns. A polynomial, and not the C library's, so that a browser and a processor
/// get the same bits.
struct Turn {
    float sin, cos;

    explicit Turn(float turns) {
        const float part = turns - std::floor(turns + 0.5f); // in [−½, ½)
        sin = sine(part);
        cos = sine(0.25f - std::abs(part));
    }

private:
    /// sin(2π x) for |x| <= ½: Taylor's series about 0, of the nearest x with the same sine.
    [[nodiscard]] static float sine(float x) {
        const float near_zero = std::abs(x) > 0.25f ? std::copysign(0.5f, x) - x : x;
        const float a = 6.2831853f * near_zero, a2 = a * a;
        return a * (1 + a2 * (-1.f / 6 + a2 * (1.f / 120 + a2 * (-1.f / 5040 + a2 * (1.f / 362880 - a2 / 39916800)))));
    }
};

/// z = level + the sum of the waves. Slopes stay below 1/3, so that a lamp's rays, which come down steeply, meet the
/// surface once.
struct Waves {
    struct Wave {
        float amplitude, x, y, speed; ///< world units, turns per unit along x and y, turns per second
    };
    static constexpr std::array<Wave, 4> list = {Wave{0.012f, 0.9f, 0.45f, 0.32f}, Wave{0.009f, -0.7f, 1.5f, 0.38f},
                                                 Wave{0.008f, 2.0f, -1.1f, 0.46f}, Wave{0.0055f, 1.5f, 2.7f, 0.55f}};

    float time = 0; ///< seconds

    struct Local {
        float height, d_x, d_y, d_xx, d_xy, d_yy; ///< above the level, and its derivatives
    };
    [[nodiscard]] Local at(float x, float y) const {
        Local local{};
        for (const Wave& wave : list) {
            constexpr float two_pi = 6.2831853f;
            const Turn turn(wave.x * x + wave.y * y - wave.speed * time);
            const float a = wave.amplitude * turn.sin, b = two_pi * wave.amplitude * turn.cos;
            const float c = -two_pi * two_pi * a;
            local.height += a;
            local.d_x += b * wave.x, local.d_y += b * wave.y;
            local.d_xx += c * wave.x * wave.x, local.d_xy += c * wave.x * wave.y, local.d_yy += c * wave.y * wave.y;
        }
        return local;
    }

    /// Newton's method from the level's plane; rays that start below the crests and go down are under water.
    [[nodiscard]] std::optional<float> nearest(const Ray& ray, float level) const {
        const float above = ray.origin.z - level;
        if (!(ray.direction.z < 0) || above < -crest())
            return std::nullopt;
        if (above < crest() && !(above > at(ray.origin.x, ray.origin.y).height))
            return std::nullopt;
        float t = -above / ray.direction.z;
        for (int i = 0; i < 8; ++i) {
            const Vec p = ray.at(t);
            const Local local = at(p.x, p.y);
            const float step = (p.z - level - local.height) /
                               (ray.direction.z - local.d_x * ray.direction.x - local.d_y * ray.direction.y);
            t -= step;
            if (std::abs(step) < 1e-6f * std::abs(t))
                break;
        }
        return ray.reaches(t) ? std::optional(t) : std::nullopt;
    }

    [[nodiscard]] Hit hit(const Ray& ray, float t, float level, std::size_t surface) const {
        const Vec p = ray.at(t);
        const Local local = at(p.x, p.y);
        const float inverse = 1 / std::sqrt(1 + local.d_x * local.d_x + local.d_y * local.d_y);
        const Vec n(-inverse * local.d_x, -inverse * local.d_y, inverse);
        // dn = −(I − n nᵀ) H dx / |gradient|, H being the height's second derivatives.
        const auto column = [&](float d_x, float d_y) -> Vec {
            const Vec turned(-inverse * d_x, -inverse * d_y, 0);
            return turned - glm::dot(turned, n) * n;
        };
        return make_hit(ray, t, {p.x, p.y, level + local.height}, n,
                        {column(local.d_xx, local.d_xy), column(local.d_xy, local.d_yy), Vec(0)}, surface);
    }

private:
    [[nodiscard]] static constexpr float crest() {
        float sum = 0;
        for (const Wave& wave : list)
            sum += wave.amplitude;
        return sum;
    }
};

} // namespace nephroid::examples::web
