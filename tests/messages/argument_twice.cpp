// SPDX-License-Identifier: MIT
// expect: nephroid: of splat policies, sequences and executors there may be one each after the pass
#include "messages/renderer.hpp"

void render_twice() {
    auto sums = nephroid::sums<float>(map);
    nephroid::caustics(Scene{}, sun, sums, {.count = 1}, nephroid::HaltonSequence(1), nephroid::HaltonSequence(2));
}
