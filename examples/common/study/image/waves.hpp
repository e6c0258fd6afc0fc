// SPDX-License-Identifier: MIT
/// @file  Water under a few crossing waves that move, over a floor: the smallest scene for tracers without
///        differentials.
#pragma once

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/transport/scattering.hpp"
#include "nephroid/vector/glm.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace nephroid::examples::study::image {

/// amplitude · sin(2π (kx x + ky y) + phase)
struct MovingWave {
    double amplitude, kx, ky, phase = 0, speed = 0; ///< speed: radians a unit of time
};

/// Water of index 1.33 and mean height 1 over the floor z = 0, lit straight from above. Whole numbers of waves make a
/// pattern of period 1.
class WaterWaves {
public:
    static constexpr bool scatters_by_chance = false;
    static constexpr double index = 1.33;

    struct PlainHit {
        float distance;
        glm::vec3 geometric_normal;
        float position_error;
        std::size_t surface;
    };

    /// Height, slopes and second derivatives.
    struct Surface {
        double z = 1, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

        /// The mean of the two curvatures, positive at a crest.
        [[nodiscard]] double mean_curvature() const {
            const double w = 1 + x * x + y * y;
            return -((1 + y * y) * xx - 2 * x * y * xy + (1 + x * x) * yy) / (2 * w * std::sqrt(w));
        }
    };

    explicit WaterWaves(std::vector<MovingWave> waves, double time = 0) : waves_(std::move(waves)) {
        for (MovingWave& wave : waves_)
            wave.phase += wave.speed * time;
    }

    [[nodiscard]] Surface at(double x, double y) const {
        Surface s;
        for (const MovingWave& wave : waves_) {
            const double k = 2 * pi<double>, phase = k * (wave.kx * x + wave.ky * y) + wave.phase,
                         sine = wave.amplitude * std::sin(phase), cosine = wave.amplitude * std::cos(phase);
            s.z += sine;
            s.x += k * wave.kx * cosine, s.y += k * wave.ky * cosine;
            s.xx -= k * k * wave.kx * wave.kx * sine, s.yy -= k * k * wave.ky * wave.ky * sine;
            s.xy -= k * k * wave.kx * wave.ky * sine;
        }
        return s;
    }

    [[nodiscard]] std::optional<PlainHit> intersect(const glm::vec3& o, const glm::vec3& d, float t_min,
                                                    float t_max) const {
        if (d.x == 0 && d.y == 0 && d.z < 0) { // from above it meets the water at its own x and y
            const Surface s = at(double(o.x), double(o.y));
            const auto t = float(double(o.z) - s.z);
            if (t > t_min && t < t_max)
                return PlainHit{t, glm::vec3(glm::normalize(glm::dvec3(-s.x, -s.y, 1))), 1e-6f, 1};
        }
        const float t = -o.z / d.z;
        if (d.z < 0 && t > t_min && t < t_max)
            return PlainHit{t, {0, 0, 1}, 0, 0};
        return std::nullopt;
    }

    [[nodiscard]] Scattering<float, float> scatter(const PlainHit& hit, const glm::vec3&, auto&) const {
        return hit.surface == 1 ? Scattering<float, float>::refract(1, float(1 / index))
                                : Scattering<float, float>::deposit();
    }

private:
    std::vector<MovingWave> waves_;
};

/// Over the unit square, 1 on the ground.
[[nodiscard]] inline DirectionalLight<glm::vec3, float> sun_over_square() {
    return DirectionalLight<glm::vec3, float>({.direction = {0, 0, -1},
                                               .irradiance = 1,
                                               .patch = Parallelogram<glm::vec3>{{0, 0, 1.25f}, {1, 0, 0}, {0, 1, 0}}});
}

} // namespace nephroid::examples::study::image
