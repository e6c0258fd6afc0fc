// SPDX-License-Identifier: MIT
// expect: nephroid::flux_traits<F> is missing for this flux type, or its power(f) or zero()
#include "messages/renderer.hpp"

struct Spectrum {
    float bands[4];
    Spectrum operator+(const Spectrum&) const { return *this; }
    Spectrum operator*(const Spectrum&) const { return *this; }
    Spectrum operator*(float) const { return *this; }
};

using Wrong = nephroid::Sums<V, Spectrum>;
int main() { return int(sizeof(Wrong)); }
