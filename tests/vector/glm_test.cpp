// SPDX-License-Identifier: MIT
#include "nephroid/vector/glm.hpp"

#include "nephroid/vector/algebra.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <type_traits>

namespace {

template <glm::qualifier Q>
using vec3_of = glm::vec<3, float, Q>;

static_assert(nephroid::Vector3<vec3_of<glm::highp>> && nephroid::Vector3<vec3_of<glm::mediump>> &&
              nephroid::Vector3<vec3_of<glm::lowp>>);
static_assert(std::is_same_v<nephroid::scalar_t<glm::vec3>, float> &&
              std::is_same_v<nephroid::scalar_t<glm::dvec3>, double>);
static_assert(!nephroid::Vector3<glm::ivec3> && !nephroid::Vector3<glm::bvec3> && !nephroid::Vector3<glm::vec2> &&
              !nephroid::Vector3<glm::vec4>);

// The traits of a constexpr GLM vector are constant expressions.
static_assert(nephroid::vector_traits<glm::vec3>::y(nephroid::vector_traits<glm::vec3>::make(1, 2, 3)) == 2);

// Components of about one: products and sums of three round four times in GLM; the library's cross product once.
TEST_CASE_TEMPLATE("glm: the library's products agree with GLM's own", T, float, double) {
    using V = glm::vec<3, T>;
    const V a(T(0.3), T(-0.7), T(1.1)), b(T(0.9), T(0.2), T(-0.4));
    const T tolerance = 4 * std::numeric_limits<T>::epsilon();
    CHECK(std::abs(nephroid::dot(a, b) - glm::dot(a, b)) <= tolerance);
    CHECK(glm::length(nephroid::cross(a, b) - glm::cross(a, b)) <= tolerance);
    CHECK(std::abs(nephroid::length(a) - glm::length(a)) <= tolerance);
    CHECK(glm::length(nephroid::normalize(a) - glm::normalize(a)) <= tolerance);
}

} // namespace

// Both names are visible, as in a user's file: nothing is ambiguous, and GLM's operators are the ones that run.
namespace user {
using namespace nephroid;
using namespace glm;

TEST_CASE("glm: operators are not ambiguous beside the library's") {
    const vec3 a(1, 2, 3), b(4, 5, 6);
    CHECK(a + b == vec3(5, 7, 9));
    CHECK(b - a == vec3(3, 3, 3));
    CHECK(-a == vec3(-1, -2, -3));
    CHECK(2.0f * a == vec3(2, 4, 6));
    CHECK(a * b == vec3(4, 10, 18));
}
} // namespace user
