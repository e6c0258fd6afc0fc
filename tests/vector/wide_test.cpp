// SPDX-License-Identifier: MIT
#include "nephroid/vector/wide.hpp"

#include "nephroid/vector/glm.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <type_traits>

namespace nephroid::tests::wide_test {

using tests::Space;
using tests::Wide;

namespace {

template <class W>
std::array<Wide, 3> components(const std::array<W, 3>& a) {
    return {Wide(a[0]), Wide(a[1]), Wide(a[2])};
}

} // namespace

#if defined(__SIZEOF_FLOAT128__) // else the reference cannot hold a product of two doubles
// Products of floats are exact in double, and their difference rounds once: half an epsilon of double. Of doubles the
// difference of products is within two epsilons. Both of each component, though all but a millionth of the terms
// cancels.
TEST_CASE_TEMPLATE("wide: a cross product of vectors that are nearly parallel keeps its digits", T, float, double) {
    using V = glm::vec<3, T>;
    tests::Draws draw(5);
    for (int i = 0; i < 5000; ++i) {
        const Space direction = draw.direction();
        const auto a = tests::narrow<V>(Wide(draw.in(0.1, 10)) * direction);
        const auto b = tests::narrow<V>(Wide(draw.in(0.1, 10)) * (direction + Wide(1e-6) * draw.in_cube()));
        const Space cross = tests::widen(a).cross(tests::widen(b));
        const auto found = components(detail::wide_cross<V>(detail::widened(a), detail::widened(b)));
        const std::array<Wide, 3> exact{cross.x, cross.y, cross.z};
        const double epsilons = std::is_same_v<T, float> ? 0.5 : 2;
        for (std::size_t axis = 0; axis < 3; ++axis)
            CHECK(abs(found[axis] - exact[axis]) <=
                  Wide(epsilons * std::numeric_limits<double>::epsilon()) * abs(exact[axis]));
    }
}
#endif

TEST_CASE("wide: products of the largest and the smallest floats neither overflow nor vanish") {
    constexpr float large = 3e38f, small = 1e-38f;
    const glm::vec3 a(large, 0, small), b(0, large, small);
    const auto wide_a = detail::widened(a), wide_b = detail::widened(b);
    CHECK(detail::wide_dot(wide_a, wide_a) == double(large) * double(large) + double(small) * double(small));
    const auto cross = detail::wide_cross<glm::vec3>(wide_a, wide_b);
    CHECK(cross[0] == -double(small) * double(large));
    CHECK(cross[1] == -double(large) * double(small));
    CHECK(cross[2] == double(large) * double(large));
}

TEST_CASE_TEMPLATE("wide: narrowing scales and rounds each component once more", T, float, double) {
    using W = wider_t<T>;
    const std::array<W, 3> a{W(1), W(-2), W(1) / W(3)};
    const auto found = detail::narrowed<glm::vec<3, T>>(W(0.5), a);
    CHECK(found.x == T(0.5));
    CHECK(found.y == T(-1));
    CHECK(found.z == T(W(1) / W(6))); // halving is exact
}

} // namespace nephroid::tests::wide_test
