// SPDX-License-Identifier: MIT
// expect: the light's `vector` and `flux_type` are not those of the sums
#include "messages/renderer.hpp"

int main() {
    const nephroid::DirectionalLight<V, double> wrong(
        {.direction = V(0, 0, -1), .irradiance = 1, .patch = nephroid::BoundingSphere<V>{V(0, 0, 0), 1}});
    render(Scene{}, wrong);
}
