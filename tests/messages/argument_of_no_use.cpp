// SPDX-License-Identifier: MIT
// expect: nephroid: an argument after the pass is none of those that may stand there
#include "messages/renderer.hpp"

void render_with_threads() {
    auto sums = nephroid::sums<float>(map);
    nephroid::caustics(Scene{}, sun, sums, {.count = 1}, 8); // threads? the executor is meant
}
