// SPDX-License-Identifier: MIT
// expect: nephroid::vector_traits<V> is missing for this vector type
#include "messages/renderer.hpp"

struct Mine {
    float x, y, z;
};
struct MyVertex {
    Mine position, normal;
};

int main() { const nephroid::EyePathMap mine(std::vector<MyVertex>(1), &MyVertex::position, &MyVertex::normal); }
