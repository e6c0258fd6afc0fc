// SPDX-License-Identifier: MIT
/// @file  Flat scenes under a lamp over the unit square: still water, and one in which of every fate some photons meet
///        it.
#pragma once

#include "support/brute_force.hpp"
#include "support/vertex.hpp"
#include "transport/tiny_scenes.hpp"

#include "nephroid/emission/flux.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/receiver/eye_path_map.hpp"

#include <cstddef>
#include <limits>
#include <vector>

namespace nephroid::tests {

template <class V>
EyePathMap<V> map_of(const std::vector<Vertex<V>>& vertices) {
    return EyePathMap<V>(vertices, &Vertex<V>::position, &Vertex<V>::normal);
}

template <class Sums>
auto image_of(const Sums& sums) {
    std::vector<typename Sums::flux_type> image;
    sums.for_each([&](std::size_t i, const auto& sum) {
        if (i >= image.size())
            image.resize(i + 1, flux_traits<typename Sums::flux_type>::zero());
        image[i] = sum;
    });
    return image;
}

/// A lamp over the unit square that shines straight down with irradiance 1.
template <class T, class F = T>
DirectionalLight<Vec<T>, F> lamp(T height = 2, F irradiance = F(1)) {
    return DirectionalLight<Vec<T>, F>(
        {{0, 0, -1}, irradiance, Parallelogram<Vec<T>>{{0, 0, height}, {1, 0, 0}, {0, 1, 0}}});
}

/// Still water of index 1.33 over a floor one unit below.
template <class T, class F = T>
SheetScene<T, F> still_water() {
    return {{{{0, 0, 1}, {0, 0, 1}, Event::refract, F(1), 1, T(1.33)}, {{0, 0, 0}, {0, 0, 1}, Event::deposit}}};
}

/// A mirror that throws the lamp's light onto the ceiling, a hole beside it, a black patch, and walls: of every fate
/// some.
struct Untidy : SheetScene<float> {
    template <class Sampler>
    Scattering<float, float> scatter(const SurfaceHit<glm::vec3, Flat>& hit, const glm::vec3& d,
                                     Sampler& sampler) const {
        auto answer = SheetScene<float>::scatter(hit, d, sampler);
        if (hit.surface == 0) { // the patchwork on the ground
            const float x = hit.position.x, y = hit.position.y;
            if (x < 0.2f)
                answer.event = Event::absorb;
            else if (x < 0.4f)
                answer.event = Event::deposit;
            else if (y < 0.1f)
                answer.weight = std::numeric_limits<float>::quiet_NaN();
            else
                answer.weight = 0.25f + 0.5f * sampler.template next<float>();
        }
        return answer;
    }
};

inline Untidy untidy() {
    return {{{{{0.4f, 0.5f, 0}, {0, 0, 1}, Event::reflect, 1.0f, 1, 1, 0.6f},     // patchwork, with corners missing
              {{0.7f, 0.7f, 1.5f}, {0, 0, -1}, Event::reflect, 0.5f, 1, 1, 0.2f}, // a mirror over a part of it
              {{0, 0, 1.9f}, {0, 0, -1}, Event::deposit, 1.0f, 1, 1, 1.2f}}}};    // the ceiling
}

template <class T>
std::vector<Vertex<Vec<T>>> ceiling() {
    std::vector<Vertex<Vec<T>>> vertices;
    add_lattice<T>(vertices, 40, 40, 0.02, {0.2, 0.2, 1.9}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    return vertices;
}

} // namespace nephroid::tests
