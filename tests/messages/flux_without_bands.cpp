// SPDX-License-Identifier: MIT
// expect: nephroid: nephroid::flux_bands<F> is missing for this flux type
#include "messages/renderer.hpp"

struct Spectrum {
    float a, b;
    friend Spectrum operator+(Spectrum x, Spectrum y) { return {x.a + y.a, x.b + y.b}; }
    friend Spectrum operator*(Spectrum x, Spectrum y) { return {x.a * y.a, x.b * y.b}; }
    friend Spectrum operator*(Spectrum x, float s) { return {x.a * s, x.b * s}; }
};
template <>
struct nephroid::flux_traits<Spectrum> {
    static double power(const Spectrum& f) { return double(f.a + f.b) / 2; }
    static Spectrum zero() { return {0, 0}; }
};

auto whole = nephroid::sums<Spectrum>(map, nephroid::InWholeNumbers(1));
