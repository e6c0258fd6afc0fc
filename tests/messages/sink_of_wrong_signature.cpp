// SPDX-License-Identifier: MIT
// expect: the sink cannot be called as sink(std::size_t vertex, const F& value)
#include "messages/renderer.hpp"

int main() {
    nephroid::sums<float>(map).for_each([](Vertex&, float) {});
}
