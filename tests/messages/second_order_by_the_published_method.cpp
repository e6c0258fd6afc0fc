// SPDX-License-Identifier: MIT
// expect: nephroid: splat_caustics splats to first order; call nephroid::caustics
#include "messages/renderer.hpp"

void render_published() {
    auto sums = nephroid::sums<float>(map);
    nephroid::splat_caustics(Scene{}, sun, sums, {.count = 1}, nephroid::Default{});
}
