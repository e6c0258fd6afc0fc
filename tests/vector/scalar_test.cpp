// SPDX-License-Identifier: MIT
#include "nephroid/vector/scalar.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <complex>
#include <string>

namespace nephroid::tests::scalar_test {

namespace {

using nephroid::Scalar;
using nephroid::tests::Wide;

static_assert(Scalar<float> && Scalar<double> && Scalar<long double>);
static_assert(!Scalar<int> && !Scalar<bool> && !Scalar<char> && !Scalar<std::complex<float>> && !Scalar<std::string>);
static_assert(!Scalar<float&> && !Scalar<float*> && !Scalar<void>);
static_assert(Scalar<Wide>, "a class is a scalar once is_scalar says so");

// Known to 40 digits; the literal's rounding and pi's are half an epsilon each, relative, and agree.
TEST_CASE_TEMPLATE("pi: is the nearest number of its type", T, float, double, long double) {
    CHECK(nephroid::pi<T> == T(3.141592653589793238462643383279502884197L));
}

TEST_CASE("square: is the product with itself also for a scalar that is a class") {
    static_assert(nephroid::square(-3) == 9);
    static_assert(nephroid::square(0.5f) == 0.25f);
    CHECK(nephroid::square(Wide(3)) == Wide(9));
}

// 2 has no exact root; Newton's last step rounds a few times, and squaring doubles a relative error.
TEST_CASE("Wide: the tests' own square root is good to a few roundings") {
    for (const double x : {2.0, 1e-30, 3e17, 1.0}) {
        const Wide root = sqrt(Wide(x));
        CHECK(abs(root * root - Wide(x)) <= Wide(8) * std::numeric_limits<Wide>::epsilon() * Wide(x));
    }
}

TEST_CASE("scalar functions: the library's names reach built-in types and others by their namespace") {
    using namespace nephroid;
    CHECK(abs(-2.5) == 2.5); // not the int abs of C
    CHECK(abs(Wide(-2.5)) == Wide(2.5));
    CHECK(sqrt(2.25f) == 1.5f);
    CHECK(isfinite(1.0f));
    CHECK(!isfinite(std::numeric_limits<double>::infinity()));
    CHECK(!isfinite(Wide(1) / Wide(0)));
}

} // namespace

} // namespace nephroid::tests::scalar_test
