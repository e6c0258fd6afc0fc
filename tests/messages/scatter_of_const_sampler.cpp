// SPDX-License-Identifier: MIT
// expect: the scene's scatter takes its sampler as const, and so can draw no numbers from it
#include "messages/renderer.hpp"

struct Wrong : Scene {
    Scattering scatter(const Hit&, const V&, const auto& random) const {
        return random.template next<float>() < 0.5f ? Scattering::reflect(1) : Scattering::deposit();
    }
};

int main() { render(Wrong{}); }
