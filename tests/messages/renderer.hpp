// SPDX-License-Identifier: MIT
/// @file  A renderer that fits, of which each file here breaks one part: as short as it can be.
#pragma once

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/vector/glm.hpp"

#include <optional>
#include <vector>

using V = glm::vec3;
using Hit = nephroid::SurfaceHit<V, nephroid::Flat>;
using Scattering = nephroid::Scattering<float, float>;

struct Vertex {
    V position, normal;
};

struct Scene {
    std::optional<Hit> intersect(const V&, const V&, float, float) const { return std::nullopt; }
    Scattering scatter(const Hit&, const V&, auto&) const { return {}; }
};

inline const std::vector<Vertex> vertices(1, {V(0, 0, 0), V(0, 0, 1)});
inline const nephroid::EyePathMap<V> map(vertices, &Vertex::position, &Vertex::normal);
inline const nephroid::DirectionalLight<V, float>
    sun({.direction = V(0, 0, -1), .irradiance = 1, .patch = nephroid::BoundingSphere<V>{V(0, 0, 0), 1}});

template <class S = Scene, class L = nephroid::DirectionalLight<V, float>, class Q = nephroid::HaltonSequence>
void render(const S& scene = {}, const L& light = sun, const Q& sequence = Q{}) {
    auto sums = nephroid::sums<float>(map);
    nephroid::caustics(scene, light, sums, {.count = 1}, sequence);
}
