// SPDX-License-Identifier: MIT
// expect: nephroid: these photons carry no tangents to widen beams by
#include "messages/renderer.hpp"

#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/ray/splat_rays.hpp"

int main() {
    auto sums = nephroid::sums<float>(map);
    nephroid::splat_rays(Scene{}, nephroid::WithoutTangents(sun), sums, {.count = 1});
}
