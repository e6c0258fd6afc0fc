// SPDX-License-Identifier: MIT
/// @file  Points on walls, and what path traced light there may differ by, for tests of light that bounces.
#pragma once

#include "common/eye_vertex.hpp"
#include "common/path_tracer/bounced_paths.hpp"
#include "common/ray.hpp"

#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::examples::testing {

/// A point of a flat wall, as the eye sees it.
template <class T, Flux F>
EyeVertex<T, F> on_wall(const Vec3<T>& position, const Vec3<T>& normal, std::uint32_t pixel = 0, double weight = 1) {
    return {position, normal, normal, position_error(position, 1), pixel, grey<F>(weight)};
}

/// The middles of n × n parts of the parallelogram, whose mean is the pixel's.
template <class T, Flux F>
void add_wall(std::vector<EyeVertex<T, F>>& vertices, const Vec3<T>& corner, const Vec3<T>& u, const Vec3<T>& v, int n,
              std::uint32_t pixel) {
    const Vec3<T> normal = normalize(cross(u, v));
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            vertices.push_back(on_wall<T, F>(corner + (T(i) + T(0.5)) / T(n) * u + (T(j) + T(0.5)) / T(n) * v, normal,
                                             pixel, 1.0 / (n * n)));
}

/// A mean of paths and its standard error.
struct Estimate {
    double mean = 0, error = 0;
};

/// One of the sums of a path's layers, over many paths from one point.
template <class T, Flux F, class Part>
Estimate estimate(const BouncedPaths<T, F>& paths, const EyeVertex<T, F>& vertex, int count, const Part& part) {
    const RandomSequence numbers(11);
    const Medium medium = paths.medium_at(vertex);
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        Sampler<RandomSequence> sampler(numbers, std::uint64_t(i));
        const double found = double(flux_traits<F>::power(part(paths(vertex, medium, sampler))));
        sum += found;
        squares += found * found;
    }
    const double mean = sum / count;
    return {mean, std::sqrt((std::max)(0.0, squares / count - mean * mean) / (count - 1))};
}

inline constexpr auto direct_part = [](const auto& layers) { return layers.direct; };
inline constexpr auto indirect_part = [](const auto& layers) { return layers.indirect; };
inline constexpr auto first_light = [](const auto& layers) { return layers.direct + layers.caustic; };
inline constexpr auto all_light = [](const auto& layers) { return layers.sum(); };

} // namespace nephroid::examples::testing
