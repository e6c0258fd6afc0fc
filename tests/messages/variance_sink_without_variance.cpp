// SPDX-License-Identifier: MIT
// expect: the sink of PassVariance::for_each cannot be called as sink(std::size_t vertex, double mean, double variance)
#include "messages/renderer.hpp"

#include "nephroid/receiver/pass_variance.hpp"

void read(const nephroid::PassVariance<V, float>& variance) {
    variance.for_each([](std::size_t, double) {});
}
