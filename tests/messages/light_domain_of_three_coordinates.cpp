// SPDX-License-Identifier: MIT
// expect: the light's `domain` must be a static constexpr EmissionDomain of 2 or 4 coordinates
#include "messages/renderer.hpp"

struct Wrong : nephroid::DirectionalLight<V, float> {
    static constexpr nephroid::EmissionDomain domain{.coordinates = 3};
};

int main() { render(Scene{}, Wrong{sun}); }
