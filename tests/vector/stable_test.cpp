// SPDX-License-Identifier: MIT
#include "nephroid/vector/stable.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

namespace nephroid::tests::stable_test {

using tests::Draws;
using tests::Wide;

namespace {

#if defined(__SIZEOF_FLOAT128__) // else the reference cannot hold a product of two doubles
// Half an epsilon u per rounding. double, by fma or by Dekker: the products' difference, the difference of their errors
// and the sum round once each, and the first two are exact where the products cancel: 3 u at most. float: exact but for
// the rounding of double and the one to float, (1 + 2^-29) u. 2 epsilon covers both, and a plain a b − c d misses it
// by up to the inverse of what is left.
template <class T>
void check_difference_of_products(T a, T b, T c, T d) {
    CAPTURE(a);
    CAPTURE(b);
    CAPTURE(c);
    CAPTURE(d);
    const Wide exact = Wide(a) * Wide(b) - Wide(c) * Wide(d);
    CHECK(abs(Wide(difference_of_products(a, b, c, d)) - exact) <=
          Wide(2 * std::numeric_limits<T>::epsilon()) * abs(exact));
}

TEST_CASE_TEMPLATE("difference_of_products: is accurate to a few roundings when nothing cancels", T, float, double) {
    Draws draw(11);
    for (int i = 0; i < 2000; ++i)
        check_difference_of_products(T(draw.in(-9, 9)), T(draw.in(-9, 9)), T(draw.in(-1e-3, 1e-3)),
                                     T(draw.in(-1e6, 1e6)));
}

// d is the nearest number to a b / c, and its neighbours: what is left is about one rounding of the products.
TEST_CASE_TEMPLATE("difference_of_products: is accurate when all but the last digit cancels", T, float, double) {
    Draws draw(12);
    for (int i = 0; i < 2000; ++i) {
        const T scale = T(std::ldexp(1.0, int(draw.in(-20, 20))));
        const T a = T(std::sqrt(draw.in(1, 4))) * scale, b = -T(std::sqrt(draw.in(1, 4))),
                c = T(std::sqrt(draw.in(1, 4)));
        const T d = a * b / c;
        check_difference_of_products(a, b, c, d);
        check_difference_of_products(a, b, c, std::nextafter(d, T(1e30)));
        check_difference_of_products(a, b, c, std::nextafter(d, T(-1e30)));
    }
}
#endif

// Cassini: F(n−1) F(n+1) − F(n)^2 = (−1)^n. The products differ in their last of up to 48 (float) or 106 (double)
// bits.
TEST_CASE_TEMPLATE("difference_of_products: finds the one that Fibonacci numbers leave", T, float, double) {
    const int last = std::is_same_v<T, float> ? 35 : 77; // F(36) < 2^24, F(78) < 2^53
    std::int64_t before = 0, current = 1;                // F(0), F(1)
    for (int n = 1; n <= last; ++n) {
        const std::int64_t after = before + current;
        CHECK(difference_of_products(T(before), T(after), T(current), T(current)) == (n % 2 == 0 ? 1 : -1));
        before = current, current = after;
    }
}

TEST_CASE_TEMPLATE("difference_of_products: equal products leave exactly zero", T, float, double) {
    Draws draw(13);
    for (int i = 0; i < 1000; ++i) {
        const T a = T(std::sqrt(draw.in(0, 9))), b = T(-std::sqrt(draw.in(0, 9)));
        CHECK(difference_of_products(a, b, a, b) == 0);
        CHECK(difference_of_products(a, b, b, a) == 0);
    }
}

TEST_CASE("difference_of_products: a scalar that is a class takes the plain expression") {
    CHECK(difference_of_products(Wide(3), Wide(5), Wide(7), Wide(2)) == Wide(1));
}

TEST_CASE_TEMPLATE("keep_if: keeps the value bit for bit or leaves zero", T, float, double, long double) {
    const T infinite = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    for (const T value : {T(1.5), T(-0.0), T(0), std::numeric_limits<T>::denorm_min(), infinite, -infinite}) {
        CHECK(keep_if(true, value) == value);
        CHECK(std::signbit(keep_if(true, value)) == std::signbit(value));
        CHECK(keep_if(false, value) == 0);
        CHECK(!std::signbit(keep_if(false, value)));
    }
    CHECK(std::isnan(keep_if(true, nan)));
    CHECK(keep_if(false, nan) == 0); // which a product with zero would not give
    static_assert(keep_if(true, T(2)) == 2 && keep_if(false, T(2)) == 0);
}

TEST_CASE("keep_if: works for a scalar that is a class") {
    CHECK(keep_if(true, Wide(3)) == Wide(3));
    CHECK(keep_if(false, Wide(3)) == Wide(0));
}

} // namespace

} // namespace nephroid::tests::stable_test
