// SPDX-License-Identifier: MIT
// expect: nephroid::Spectral: the flux of the light has no bands f[i] to read and write
#include "messages/renderer.hpp"

#include "nephroid/emission/spectrum/spectral.hpp"

int main() { (void)nephroid::Spectral(sun, nephroid::EqualBands<16>{}); }
