// SPDX-License-Identifier: MIT
// A second file of the same program, with vectors of its own: with it shows what is defined twice.
#include "nephroid.hpp"

struct Mine {
    float x, y, z;
};

template <>
struct nephroid::vector_traits<Mine> {
    using scalar = float;
    static Mine make(float x, float y, float z) { return {x, y, z}; }
    static float x(const Mine& v) { return v.x; }
    static float y(const Mine& v) { return v.y; }
    static float z(const Mine& v) { return v.z; }
};

nephroid::Sums<Mine, float> make_sums(const nephroid::EyePathMap<Mine>& map) { return nephroid::sums<float>(map); }
