// SPDX-License-Identifier: MIT
// expect: photons of Spectral and Extended lights are not the same without tangents
#include "messages/renderer.hpp"

#include "nephroid/emission/spectrum/spectral.hpp"
#include "nephroid/emission/without_tangents.hpp"

using Sixteen = nephroid::Bands<float, 16>;

struct Glass : Scene {
    nephroid::Scattering<Sixteen, float> scatter(const Hit&, const V&, auto&, const auto&) const { return {}; }
};

int main() {
    const nephroid::DirectionalLight<V, Sixteen> sun16(
        {.direction = V(0, 0, -1), .irradiance = Sixteen(1), .patch = nephroid::BoundingSphere<V>{V(0, 0, 0), 1}});
    const nephroid::Spectral light(sun16, nephroid::EqualBands<16>{});
    (void)nephroid::WithoutTangents(light);
}
