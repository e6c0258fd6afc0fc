// SPDX-License-Identifier: MIT
// expect: nephroid: the position projection returns a number instead of a vector
#include "messages/renderer.hpp"

struct MyVertex {
    float height;
    V normal;
};

int main() { const nephroid::EyePathMap mine(std::vector<MyVertex>(1), &MyVertex::height, &MyVertex::normal); }
