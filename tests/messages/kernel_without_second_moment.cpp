// SPDX-License-Identifier: MIT
// expect: nephroid: the kernel lacks `static constexpr double second_moment`
#include "messages/renderer.hpp"

struct Box {
    float operator()(float radius2) const { return radius2 < 1 ? 1 / nephroid::pi<float> : 0; }
};
const auto policies = nephroid::Default{}.with_kernel(Box{});
