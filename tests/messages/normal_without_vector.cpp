// SPDX-License-Identifier: MIT
// expect: nephroid::EyePathMap: the normal projection cannot be called with a vertex, or does not return a vector
#include "messages/renderer.hpp"

struct MyVertex {
    V position;
    float tilt;
};

int main() { const nephroid::EyePathMap mine(std::vector<MyVertex>(1), &MyVertex::position, &MyVertex::tilt); }
