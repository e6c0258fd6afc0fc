// SPDX-License-Identifier: MIT
#include "nephroid/vector/frame.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::frame_test {

using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

// Each component is a sum of at most two terms of size <= 1 after up to four roundings, so off by 5/2 epsilon at most,
// and n's own length by 2 epsilon, which the terms x² a, y² a inherit. A product of two such vectors doubles that,
// over three components (sqrt 3 each): 2 · sqrt(3) · (5/2 + 2) < 16.
template <class V>
void check_frame(const V& n) {
    using T = scalar_t<V>;
    const Frame<V> frame = frame_about(n);
    const Space u = tests::widen(frame.u), v = tests::widen(frame.v), w = tests::widen(n);
    CAPTURE(double(w.x));
    CAPTURE(double(w.y));
    CAPTURE(double(w.z));
    const Wide tolerance = Wide(16) * Wide(std::numeric_limits<T>::epsilon());
    CHECK(abs(u.dot(u) - Wide(1)) <= tolerance);
    CHECK(abs(v.dot(v) - Wide(1)) <= tolerance);
    CHECK(abs(u.dot(v)) <= tolerance);
    CHECK(abs(u.dot(w)) <= tolerance);
    CHECK(abs(v.dot(w)) <= tolerance);
    CHECK((u.cross(v) - w).length() <= tolerance); // right-handed
}

TEST_CASE_TEMPLATE("frame_about: is orthonormal and right-handed over the whole sphere", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(21);
        for (int i = 0; i < 300; ++i)
            check_frame(tests::narrow<V>(draw.direction()));
    });
}

TEST_CASE_TEMPLATE("frame_about: has no singularity on the axes nor where z changes sign", T, float, double) {
    using V = foreign::Plain<T>;
    for (const T s : {T(1), T(-1)}) {
        check_frame(V{s, 0, 0});
        check_frame(V{0, s, 0});
        check_frame(V{0, 0, s});
        for (const T zero : {T(0), T(-0.0), std::numeric_limits<T>::denorm_min(), -std::numeric_limits<T>::denorm_min(),
                             T(1e-30), T(-1e-30)}) {
            check_frame(V{s, 0, zero});
            check_frame(V{T(0.6), T(0.8) * s, zero});
            check_frame(V{zero, zero, s});
            check_frame(V{zero, s, zero});
        }
    }
}

// Frisvad 2012 lost its digits here: 1 / (1 + z) with z within rounding of −1.
TEST_CASE_TEMPLATE("frame_about: keeps its digits all the way to minus z", T, float, double) {
    using V = foreign::Plain<T>;
    for (int k = 0; k <= 60; ++k) {
        const Wide sine = tests::power_of_two(-k), cosine = sqrt(Wide(1) - sine * sine);
        for (const double angle : {0.0, 0.5, 2.0, 3.5, 5.5}) {
            const Wide c = std::cos(angle), s = sqrt(Wide(1) - c * c);
            check_frame(tests::narrow<V>({sine * c, sine * s, -cosine}));
            check_frame(tests::narrow<V>({sine * c, sine * s, cosine}));
        }
    }
}

// About ±z the frame is (x, ±y), and its rows differ from that by at most sin a + sin² a for a direction at the
// angle a.
TEST_CASE_TEMPLATE("frame_about: turns little when a direction near the axis turns little", T, float, double) {
    using V = foreign::Plain<T>;
    for (const T side : {T(1), T(-1)}) {
        for (int k = 2; k <= 20; ++k) {
            const T sine = std::ldexp(T(1), -k), cosine = std::sqrt(1 - sine * sine);
            const double bound = double(sine + sine * sine + 8 * std::numeric_limits<T>::epsilon());
            for (const T turn : {T(0), T(1)}) {
                const Frame<V> frame = frame_about(V{sine * turn, sine * (1 - turn), side * cosine});
                CHECK(tests::distance(frame.u, Space{1, 0, 0}) <= bound);
                CHECK(tests::distance(frame.v, Space{0, Wide(side), 0}) <= bound);
            }
        }
    }
}

} // namespace

} // namespace nephroid::tests::frame_test
