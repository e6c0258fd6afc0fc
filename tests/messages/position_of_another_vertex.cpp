// SPDX-License-Identifier: MIT
// expect: nephroid: the position projection cannot be called with a vertex
#include "messages/renderer.hpp"

struct MyVertex {
    V position, normal;
};

int main() { const nephroid::EyePathMap mine(vertices, &MyVertex::position, &MyVertex::normal); }
