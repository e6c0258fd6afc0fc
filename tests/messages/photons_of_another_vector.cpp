// SPDX-License-Identifier: MIT
// expect: nephroid: the photons to splat must be an array of Deposit<V, F, N>
#include "messages/renderer.hpp"

#include "nephroid/splat/splat_photons.hpp"

void splat_doubles(const std::vector<nephroid::Deposit<glm::dvec3, float>>& photons) {
    auto sums = nephroid::sums<float>(map);
    nephroid::splat(photons, sums);
}
