// SPDX-License-Identifier: MIT
#include "nephroid/vector/algebra.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <type_traits>

using nephroid::scalar_t;
using nephroid::tests::Space;
using nephroid::tests::Wide;

// Code of the library lives in this namespace, and so do its expressions.
namespace nephroid::inside {
namespace {

template <Vector3 V>
V linear(scalar_t<V> s, const V& a, const V& b) {
    const V sum = a + s * b;
    return -(sum - b);
}

} // namespace
} // namespace nephroid::inside

namespace {

template <class V>
concept Adds = requires(const V a) {
    a + a;
};
template <class V>
concept Negates = requires(const V a) {
    -a;
};
template <class V>
concept Scales = requires(const V a) {
    scalar_t<V>(2) * a;
};

// Here, outside the library and without `using namespace`, a type has what it brought along.
static_assert(!Adds<foreign::Plain<float>> && !Negates<foreign::Plain<float>> && !Scales<foreign::Plain<float>>);
static_assert(!Adds<std::array<double, 3>> && !Negates<std::array<double, 3>> && !Scales<std::array<double, 3>>);
static_assert(Adds<foreign::Aligned<float>> && Scales<foreign::Aligned<float>>);

template <class V>
bool same(const V& a, double x, double y, double z) {
    const Space w = nephroid::tests::widen(a);
    return w.x == Wide(x) && w.y == Wide(y) && w.z == Wide(z);
}

// Small integers: every operation is exact, whichever operator does it.
TEST_CASE_TEMPLATE("operators: give every vector type the same result", T, float, double, Wide) {
    nephroid::tests::for_each_vector<T>([]<class V>() {
        const V a = nephroid::make_vector<V>(T(1), T(-2), T(3)), b = nephroid::make_vector<V>(T(5), T(7), T(-11));
        CHECK(same(nephroid::inside::linear(T(4), a, b), -16, -19, 30)); // −(a + 4b − b)
        CHECK(same(nephroid::zero_vector<V>(), 0, 0, 0));
        CHECK(nephroid::dot(a, b) == T(5 - 14 - 33));
        CHECK(same(nephroid::cross(a, b), 22 - 21, 15 + 11, 7 + 10));
        CHECK(nephroid::length2(a) == T(14));
        CHECK(nephroid::length(nephroid::make_vector<V>(T(2), T(-3), T(6))) == T(7));
        CHECK(nephroid::all_finite(a));
    });
}

// The same arithmetic in the same order, so the same bits as GLM's, for operands that do round. (With contraction to
// fused multiply-add the order is the compiler's, which may differ: half an epsilon of each of two terms below 8.)
TEST_CASE_TEMPLATE("operators: round as GLM's do", T, float, double) {
    using G = glm::vec<3, T>;
    const G a(T(0.1), T(-0.7), T(1.3)), b(T(0.9), T(0.2), T(-0.4));
    const T s = T(1.7);
    const G expected = -((a + s * b) - b);
    nephroid::tests::for_each_vector<T>([&]<class V>() {
        using t = nephroid::vector_traits<V>;
        const V found = nephroid::inside::linear(s, t::make(a.x, a.y, a.z), t::make(b.x, b.y, b.z));
#if defined(__FP_FAST_FMA) || defined(__FMA__)
        const double tolerance = 8 * double(std::numeric_limits<T>::epsilon());
#else
        const double tolerance = 0;
#endif
        CHECK(nephroid::tests::distance(found, nephroid::tests::widen(expected)) <= tolerance);
    });
}

template <class V>
foreign::Calls calls_of_linear() {
    using T = scalar_t<V>;
    V::calls = {};
    const V v = nephroid::make_vector<V>(T(1), T(2), T(3));
    CHECK(same(nephroid::inside::linear(T(2), v, v), -2, -4, -6));
    return V::calls;
}

TEST_CASE_TEMPLATE("operators: a type's own of exactly this shape run", T, float, double) {
    const foreign::Calls calls = calls_of_linear<foreign::Aligned<T>>();
    CHECK(calls.plus == 1);
    CHECK(calls.minus == 1);
    CHECK(calls.negate == 1);
    CHECK(calls.scale == 1);
}

TEST_CASE_TEMPLATE("operators: own members run but never an element-wise times that would convert", T, float, double) {
    const foreign::Calls calls = calls_of_linear<foreign::Shading<T>>();
    CHECK(calls.plus == 1);
    CHECK(calls.minus == 1);
    CHECK(calls.negate == 1);
    CHECK(calls.elementwise == 0);
}

TEST_CASE_TEMPLATE("operators: traits that say native_operators take the library's out of the running", T, float,
                   double) {
    const foreign::Calls calls = calls_of_linear<foreign::Family<T>>();
    CHECK(calls.plus == 1);
    CHECK(calls.minus == 1);
    CHECK(calls.negate == 1);
    CHECK(calls.scale == 1);
}

// a and b differ in the last digits: the exact product is about epsilon², and a plain a b − c d would be all
// rounding. Each component: 2 epsilon relative (stable_test.cpp). Wide has no such care, and needs none here.
TEST_CASE_TEMPLATE("cross: keeps its digits for nearly parallel vectors", T, float, double) {
    nephroid::tests::for_each_vector<T>([]<class V>() {
        const T e = std::numeric_limits<T>::epsilon();
        const V a = nephroid::make_vector<V>(T(1.1), T(1.3), T(1.7));
        const V b = nephroid::make_vector<V>(T(1.1) + e, T(1.3) - 2 * e, T(1.7) + 4 * e);
        const Space exact = nephroid::tests::widen(a).cross(nephroid::tests::widen(b));
        CHECK(nephroid::tests::magnitude(exact) < 32 * double(e));
        CHECK(nephroid::tests::distance(nephroid::cross(a, b), exact) <=
              2 * double(e) * nephroid::tests::magnitude(exact));
    });
}

// Length: three products, two sums, a root: 2 epsilon relative at most; the reciprocal and the product add one.
TEST_CASE_TEMPLATE("normalize: makes a unit vector of any length of the same direction", T, float, double, Wide) {
    nephroid::tests::for_each_vector<T>([]<class V>() {
        nephroid::tests::Draws draw(31);
        for (int i = 0; i < 100; ++i) {
            const V a = nephroid::tests::narrow<V>(Wide(std::exp2(draw.in(-40, 40))) * draw.direction());
            const V n = nephroid::normalize(a);
            const double tolerance = 3 * double(std::numeric_limits<T>::epsilon());
            CHECK(nephroid::tests::distance(n, nephroid::tests::widen(a).unit()) <= tolerance);
        }
    });
}

TEST_CASE_TEMPLATE("all_finite: notices a bad component wherever it is", T, float, double) {
    nephroid::tests::for_each_vector<T>([]<class V>() {
        for (const T bad : {std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity(),
                            std::numeric_limits<T>::quiet_NaN()}) {
            CHECK(!nephroid::all_finite(nephroid::make_vector<V>(bad, T(0), T(0))));
            CHECK(!nephroid::all_finite(nephroid::make_vector<V>(T(0), bad, T(0))));
            CHECK(!nephroid::all_finite(nephroid::make_vector<V>(T(0), T(0), bad)));
        }
        const T most = (std::numeric_limits<T>::max)();
        CHECK(nephroid::all_finite(nephroid::make_vector<V>(most, -most, T(0))));
    });
}

// The plain struct's algebra is usable in constant expressions but for roots.
static_assert(nephroid::dot(foreign::Plain<float>{1, 2, 3}, {4, 5, 6}) == 32);
static_assert(nephroid::cross(foreign::Plain<float>{1, 0, 0}, {0, 1, 0}).z == 1);

} // namespace
