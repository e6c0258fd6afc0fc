// SPDX-License-Identifier: MIT
// A whole caustic, from the lamp to the sums, in every vector type, with the library's own being GLM's.
#include "support/eigen_vector.hpp"
#include "support/foreign_vectors.hpp"
#include "support/glass_ball.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace nephroid::tests::whole_caustic_test {

namespace {

template <class V>
std::vector<scalar_t<V>> caustic_in() {
    using T = scalar_t<V>;
    return tests::caustic_of(tests::GlassBall<V, T>{.tint = T(0.9)}, T(1));
}

/// The largest difference, in units of the largest value.
template <class T>
double difference(const std::vector<T>& a, const std::vector<T>& b) {
    REQUIRE(a.size() == b.size());
    double furthest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        furthest = (std::max)(furthest, std::abs(double(a[i]) - double(b[i])));
    return furthest / double(*std::max_element(b.begin(), b.end()));
}

/// The operations are the same in every type, and so are the bits unless a compiler contracts them to fused ones here
/// and not there. Then a photon lands a few dozen roundings elsewhere; the kernel's slope over the least minor
/// radius, a pixel's, is below 40 per unit of length, and the vertices get as many parts of their light anew.
template <class T>
constexpr double rounding = 2000 * double(std::numeric_limits<T>::epsilon());

template <class V>
void check_against(const std::vector<scalar_t<V>>& expected, const std::string& name) {
    INFO("vector type: ", name);
    CHECK(difference(caustic_in<V>(), expected) <= rounding<scalar_t<V>>);
}

} // namespace

// Those of tests/support/foreign_vectors.hpp that differ in kind: each costs a second of compile time.
TEST_CASE_TEMPLATE("a whole caustic: is the same in every vector type as in GLM's", T, float, double) {
    const std::vector<T> expected = caustic_in<glm::vec<3, T>>();
    CHECK(*std::max_element(expected.begin(), expected.end()) > T(2)); // a caustic, not a shadow
    check_against<foreign::Plain<T>>(expected, "a plain struct without operators");
    check_against<std::array<T, 3>>(expected, "std::array");
    check_against<foreign::Shading<T>>(expected, "element-wise times and conversion from a number");
    check_against<foreign::Aligned<T>>(expected, "four aligned lanes");
#if NEPHROID_TESTS_HAVE_EIGEN
    check_against<Eigen::Matrix<T, 3, 1>>(expected, "Eigen");
#else
    MESSAGE("Eigen is not installed: not tried");
#endif
}

} // namespace nephroid::tests::whole_caustic_test
