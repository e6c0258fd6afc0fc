// SPDX-License-Identifier: MIT
// expect: the flux type lacks f * s with the vector's scalar
#include "nephroid/emission/light/point.hpp"
#include "nephroid/vector/glm.hpp"

struct Spectrum {
    float bands[4];
    Spectrum operator+(const Spectrum&) const { return *this; }
    Spectrum operator*(const Spectrum&) const { return *this; }
};

template <>
struct nephroid::flux_traits<Spectrum> {
    static double power(const Spectrum& f) { return f.bands[0]; }
    static Spectrum zero() { return {}; }
};

using Wrong = nephroid::PointLight<glm::vec3, Spectrum>;
int main() { return int(sizeof(Wrong)); }
