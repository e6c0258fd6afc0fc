// SPDX-License-Identifier: MIT
// expect: cross_validated_smoothing scales all tangents
#include "messages/renderer.hpp"

#include "nephroid/emission/spectrum/spectral.hpp"
#include "nephroid/smoothing/cross_validated_smoothing.hpp"

using Sixteen = nephroid::Bands<float, 16>;

struct Glass : Scene {
    nephroid::Scattering<Sixteen, float> scatter(const Hit&, const V&, auto&, const auto&) const { return {}; }
};

int main() {
    const nephroid::DirectionalLight<V, Sixteen> sun16(
        {.direction = V(0, 0, -1), .irradiance = Sixteen(1), .patch = nephroid::BoundingSphere<V>{V(0, 0, 0), 1}});
    const nephroid::Spectral light(sun16, nephroid::EqualBands<16>{});
    auto sums = nephroid::sums<Sixteen>(map);
    (void)nephroid::cross_validated_smoothing(Glass{}, light, sums, {.count = 1});
}
