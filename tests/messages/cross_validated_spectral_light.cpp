// SPDX-License-Identifier: MIT
// expect: cross_validated_smoothing scales all tangents
#include "messages/spectral.hpp"

#include "nephroid/smoothing/cross_validated_smoothing.hpp"

int main() {
    auto sums = nephroid::sums<Sixteen>(map);
    (void)nephroid::cross_validated_smoothing(Glass{}, spectral_light, sums, {.count = 1});
}
