// SPDX-License-Identifier: MIT
/// @file  Traces the camera's rays to the eye path vertices of a whole film.
#pragma once

#include "common/camera.hpp"
#include "common/eye_path_tracer.hpp"
#include "common/eye_vertex.hpp"
#include "common/scene.hpp"

#include "nephroid/execution/executor.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace nephroid::examples {

/// Follows the camera's rays through the scene. At glass, both branches are followed until their weights are small.
///
/// @param executor    the result does not depend on it
/// @param background  black if empty
template <class T, Flux F, Executor E>
[[nodiscard]] EyePaths<T, F> trace_eye_paths(const Scene<T, F>& scene, const Camera<T>& camera,
                                             const EyePathOptions& options, E&& executor,
                                             const std::type_identity_t<Background<T, F>>& background = {}) {
    constexpr std::size_t chunk = 512; // pixels
    const std::size_t pixels = camera.width() * camera.height();
    const Medium start = scene.media_about(camera.ray(T(camera.width()) / 2, T(camera.height()) / 2).origin);
    std::vector<EyePaths<T, F>> parts((pixels + chunk - 1) / chunk);
    executor(parts.size(), [&](std::size_t part) {
        const std::size_t first = part * chunk, last = (std::min)(first + chunk, pixels);
        parts[part].emitted.resize(last - first, flux_traits<F>::zero());
        detail::EyePathTracer<T, F> tracer(scene, camera, options, start, background, parts[part]);
        for (std::size_t pixel = first; pixel < last; ++pixel)
            for (unsigned k = 0; k < options.samples; ++k) {
                const PixelOffset<T> at = pixel_sample<T>(pixel, k, options.samples, options.seed);
                tracer.trace(T(pixel % camera.width()) + at.x, T(pixel / camera.width()) + at.y,
                             static_cast<std::uint32_t>(pixel), first);
            }
    });

    EyePaths<T, F> all;
    std::size_t vertices = 0;
    for (const auto& part : parts)
        vertices += part.vertices.size();
    all.vertices.reserve(vertices);
    all.emitted.reserve(pixels);
    for (auto& part : parts) {
        all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
        all.emitted.insert(all.emitted.end(), part.emitted.begin(), part.emitted.end());
        all.rays += part.rays;
        part = {};
    }
    return all;
}

} // namespace nephroid::examples
