// SPDX-License-Identifier: MIT
// expect: nephroid: the width policy cannot be called as width(flight, filter_radius)
#include "messages/renderer.hpp"

#include "nephroid/ray/splat_rays.hpp"

struct Wide {
    float operator()(float) const { return 1; }
};

int main() {
    auto sums = nephroid::sums<float>(map);
    nephroid::splat_rays(Scene{}, sun, sums, {.count = 1}, nephroid::Rays{}.with_width(Wide{}));
}
