// SPDX-License-Identifier: MIT
// expect: vector_traits<V>::make(x, y, z) is missing
#include "nephroid/emission/light/point.hpp"
#include "nephroid/vector/glm.hpp"

struct Mine {
    float x, y, z;
};
template <>
struct nephroid::vector_traits<Mine> {
    using scalar = float;
    static float x(const Mine& v) { return v.x; }
    static float y(const Mine& v) { return v.y; }
    static float z(const Mine& v) { return v.z; }
};

using Wrong = nephroid::PointLight<Mine, float>;
int main() { return int(sizeof(Wrong)); }
