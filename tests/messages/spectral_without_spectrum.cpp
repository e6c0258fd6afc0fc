// SPDX-License-Identifier: MIT
// expect: nephroid::Spectral: the spectrum lacks count, wavelength(coordinate) or coordinate(wavelength)
#include "messages/renderer.hpp"

#include "nephroid/emission/spectrum/spectral.hpp"

using Sixteen = nephroid::Bands<float, 16>;
using Sun = nephroid::DirectionalLight<V, Sixteen>;

int main() {
    (void)nephroid::Spectral(
        Sun({.direction = V(0, 0, -1), .irradiance = Sixteen(1), .patch = nephroid::BoundingSphere<V>{V(0, 0, 0), 1}}),
        16);
}
