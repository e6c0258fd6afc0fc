// SPDX-License-Identifier: MIT
// expect: nephroid: these photons carry no differentials to shape footprints by
#include "messages/renderer.hpp"

void render_bare() {
    auto sums = nephroid::sums<float>(map);
    nephroid::caustics(Scene{}, nephroid::WithoutTangents(sun), sums, {.count = 1});
}
