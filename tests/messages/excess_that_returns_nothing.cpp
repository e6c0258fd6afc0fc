// SPDX-License-Identifier: MIT
// expect: nephroid: the excess policy cannot be called as policy(ellipse, diagonal)
#include "messages/renderer.hpp"

struct Halve {
    void operator()(nephroid::Ellipse<V>& ellipse, float) const { ellipse.a *= 0.5f; }
};
void render_halved() {
    auto sums = nephroid::sums<float>(map);
    nephroid::caustics(Scene{}, sun, sums, {.count = 1}, nephroid::Default{}.with_excess(Halve{}));
}
