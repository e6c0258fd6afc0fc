// SPDX-License-Identifier: MIT
// expect: CurvedFootprints splat photons in pieces, and so do lights with a wavelength
#include "messages/renderer.hpp"

#include "nephroid/emission/spectrum/spectral.hpp"

using Sixteen = nephroid::Bands<float, 16>;

struct Glass : Scene {
    nephroid::Scattering<Sixteen, float> scatter(const Hit&, const V&, auto&, const auto&) const { return {}; }
};

int main() {
    const nephroid::DirectionalLight<V, Sixteen> sun16(
        {.direction = V(0, 0, -1), .irradiance = Sixteen(1), .patch = nephroid::BoundingSphere<V>{V(0, 0, 0), 1}});
    auto sums = nephroid::sums<Sixteen>(map);
    nephroid::caustics(Glass{}, nephroid::Spectral(sun16, nephroid::EqualBands<16>{}), sums, {.count = 1},
                       nephroid::Default{}.with_order(nephroid::CurvedFootprints{}));
}
