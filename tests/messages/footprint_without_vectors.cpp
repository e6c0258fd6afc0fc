// SPDX-License-Identifier: MIT
// expect: nephroid::EyePathMap: the footprint projection must return a PixelFootprint
#include "messages/renderer.hpp"

struct MyVertex {
    V position, normal;
    float pixel_size;
};

int main() {
    const nephroid::EyePathMap mine(std::vector<MyVertex>(1), &MyVertex::position, &MyVertex::normal,
                                    &MyVertex::pixel_size);
}
