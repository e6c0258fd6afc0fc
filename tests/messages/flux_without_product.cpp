// SPDX-License-Identifier: MIT
// expect: the flux type lacks a + b or a * b of two fluxes
#include "nephroid/emission/light/point.hpp"
#include "nephroid/vector/glm.hpp"

struct Spectrum {
    float bands[4];
    Spectrum operator+(const Spectrum&) const { return *this; }
    Spectrum operator*(float) const { return *this; }
};

using Wrong = nephroid::PointLight<glm::vec3, Spectrum>;
int main() { return int(sizeof(Wrong)); }
