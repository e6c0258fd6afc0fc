// SPDX-License-Identifier: MIT
// expect: splat_rays: a Spectral light's photons have all bands at the place of one wavelength
#include "messages/spectral.hpp"

#include "nephroid/ray/splat_rays.hpp"

int main() {
    auto sums = nephroid::sums<Sixteen>(map);
    nephroid::splat_rays(Glass{}, spectral_light, sums, {.count = 1});
}
