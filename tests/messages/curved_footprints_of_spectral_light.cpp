// SPDX-License-Identifier: MIT
// expect: CurvedFootprints splat photons in pieces, and so do lights with a wavelength
#include "messages/spectral.hpp"

int main() {
    auto sums = nephroid::sums<Sixteen>(map);
    nephroid::caustics(Glass{}, spectral_light, sums, {.count = 1},
                       nephroid::Default{}.with_order(nephroid::CurvedFootprints{}));
}
