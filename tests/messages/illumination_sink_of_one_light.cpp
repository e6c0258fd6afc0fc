// SPDX-License-Identifier: MIT
// expect: the sink of Illumination::for_each cannot be called as sink(std::size_t vertex, const F& caustic
#include "messages/renderer.hpp"

#include "nephroid/illuminate.hpp"

void read(const nephroid::Illumination<V, float>& light) {
    light.for_each([](std::size_t, float) {});
}
