// SPDX-License-Identifier: MIT
#include "nephroid/vector/stable.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

using namespace nephroid;
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

TEST_CASE_TEMPLATE("determinant: is that of the matrix by columns", T, float, double, Wide) {
    CHECK(determinant(Matrix2<T>{T(2), T(3), T(5), T(7)}) == T(-1)); // columns (2, 5) and (3, 7)
}

// The greater root of the characteristic polynomial of Mᵀ M, and |det| over it. In wide precision, where the products
// of two entries are exact (or nearly: the second term) and the discriminant, relative to trace², is good to epsilon,
// its root where it vanishes to sqrt(epsilon).
template <class T>
void check_singular_values(const Matrix2<T>& m) {
    CAPTURE(m.xx);
    CAPTURE(m.xy);
    CAPTURE(m.yx);
    CAPTURE(m.yy);
    const Wide a = m.xx, b = m.xy, c = m.yx, d = m.yy;
    const Wide trace = a * a + b * b + c * c + d * d, det = abs(a * d - b * c);
    const Wide discriminant = trace * trace - Wide(4) * det * det;
    const Wide major = sqrt(Wide(0.5) * (trace + sqrt(discriminant > Wide(0) ? discriminant : Wide(0))));
    const Wide minor = det / major;
    const SingularValues<T> found = singular_values(m);
    CHECK(found.major >= found.minor);
    CHECK(found.minor >= 0);
    // Roundings in halves of epsilon: an entry of `sum` 1, squared 3, added 4, its root 3; summed 4. The minor value
    // adds the determinant's 3 and a quotient. Then the reference's own error.
    const Wide e = std::numeric_limits<T>::epsilon(), reference = sqrt(std::numeric_limits<Wide>::epsilon());
    CHECK(abs(Wide(found.major) - major) <= (Wide(2) * e + reference) * major);
    CHECK(abs(Wide(found.minor) - minor) <= (Wide(4) * e + reference) * minor + reference * reference * major);
}

TEST_CASE_TEMPLATE("singular_values: keep their digits down to the thinnest ellipses", T, float, double) {
    const double thinnest = std::is_same_v<T, float> ? 1e-5 : 1e-12;
    Draws draw(14);
    for (double ratio = 1; ratio >= thinnest; ratio /= 10) {
        for (int i = 0; i < 200; ++i) {
            const double p = draw.in(0, 6.28), q = draw.in(0, 6.28), size = std::exp2(draw.in(-12, 12));
            const double cp = size * std::cos(p), sp = size * std::sin(p), cq = std::cos(q), sq = std::sin(q);
            const double flip = i % 2 == 0 ? ratio : -ratio; // both signs of the determinant
            check_singular_values(Matrix2<T>{T(cp * cq - flip * sp * sq), T(-cp * sq - flip * sp * cq),
                                             T(sp * cq + flip * cp * sq), T(-sp * sq + flip * cp * cq)});
        }
    }
}

TEST_CASE_TEMPLATE("singular_values: of simple matrices are exact", T, float, double) {
    const auto is = [](const Matrix2<T>& m, T major, T minor) {
        const SingularValues<T> found = singular_values(m);
        return found.major == major && found.minor == minor;
    };
    CHECK(is({0, 0, 0, 0}, 0, 0));
    CHECK(is({3, 0, 0, -4}, 4, 3));
    CHECK(is({0, -2, 2, 0}, 2, 2));
    CHECK(is({0, 5, 0, 0}, 5, 0));
    CHECK(is({3, 3, 4, 4}, std::sqrt(T(50)), 0)); // one direction only
}

TEST_CASE_TEMPLATE("singular_values: of a matrix that is not a number are not numbers", T, float, double) {
    const SingularValues<T> found = singular_values(Matrix2<T>{1, 0, std::numeric_limits<T>::quiet_NaN(), 1});
    CHECK(std::isnan(found.major));
    CHECK(std::isnan(found.minor));
}

// |M x| over unit vectors x at the centres of 2 · 4096 arcs is at most the major value, and reaches it to cos(π /
// 4096); likewise from below for the minor one, whose square differs by at most major² sin²(π / 4096).
TEST_CASE("singular_values: bound what the matrix does to unit vectors") {
    const Matrix2<double> m{0.3, -1.7, 0.9, 0.4};
    const SingularValues<double> found = singular_values(m);
    double longest = 0, shortest = 1e9;
    for (int i = 0; i < 4096; ++i) {
        const double x = std::cos(pi<double> * i / 4096), y = std::sin(pi<double> * i / 4096);
        const double stretched = std::hypot(m.xx * x + m.xy * y, m.yx * x + m.yy * y);
        longest = (std::max)(longest, stretched), shortest = (std::min)(shortest, stretched);
    }
    const double arc = pi<double> / 4096, rounding = 1e-15; // eight roundings of a number near one
    CHECK(longest <= found.major * (1 + rounding));
    CHECK(longest >= found.major * std::cos(arc) * (1 - rounding));
    CHECK(shortest >= found.minor * (1 - rounding));
    CHECK(shortest * shortest <= found.minor * found.minor + square(found.major * arc) * (1 + rounding));
}

// Frobenius: the squares sum to the sum of the squared entries. The product is |det|. Twice the relative errors above,
// and those of the sums here.
TEST_CASE_TEMPLATE("singular_values: obey the sum rule and the product rule", T, float, double) {
    const T e = std::numeric_limits<T>::epsilon();
    Draws draw(15);
    for (int i = 0; i < 2000; ++i) {
        const Matrix2<T> m{T(draw.in(-1, 1)), T(draw.in(-1, 1)), T(draw.in(-1, 1)), T(draw.in(-1, 1))};
        const SingularValues<T> s = singular_values(m);
        const T frobenius2 = square(m.xx) + square(m.xy) + square(m.yx) + square(m.yy);
        CHECK(std::abs(square(s.major) + square(s.minor) - frobenius2) <= 16 * e * frobenius2);
        CHECK(std::abs(s.major * s.minor - std::abs(determinant(m))) <= 4 * e * std::abs(determinant(m)));
    }
}

} // namespace
