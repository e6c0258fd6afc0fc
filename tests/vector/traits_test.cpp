// SPDX-License-Identifier: MIT
#include "nephroid/vector/traits.hpp"

#include "support/foreign_vectors.hpp"

#include <doctest/doctest.h>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <memory>
#include <string>
#include <type_traits>
#include <valarray>

namespace {

using nephroid::scalar_t;
using nephroid::Vector3;
using nephroid::tests::Wide;

struct NoTraits {
    float x, y, z;
};
struct IntegerVector {};
struct ReadsOnly {};
struct MakesOnly {};
struct MovesOnly {
    std::unique_ptr<float> p;
};
struct AlmostTriple {};

} // namespace

template <>
struct nephroid::vector_traits<IntegerVector> {
    using scalar = int;
    static IntegerVector make(int, int, int) { return {}; }
    static int x(IntegerVector) { return 0; }
    static int y(IntegerVector) { return 0; }
    static int z(IntegerVector) { return 0; }
};
template <>
struct nephroid::vector_traits<ReadsOnly> {
    using scalar = float;
    static float x(ReadsOnly) { return 0; }
    static float y(ReadsOnly) { return 0; }
    static float z(ReadsOnly) { return 0; }
};
template <>
struct nephroid::vector_traits<MakesOnly> {
    using scalar = float;
    static MakesOnly make(float, float, float) { return {}; }
    static float x(MakesOnly) { return 0; }
    static float y(MakesOnly) { return 0; }
};
template <>
struct nephroid::vector_traits<MovesOnly> {
    using scalar = float;
    static MovesOnly make(float, float, float) { return {}; }
    static float x(const MovesOnly&) { return 0; }
    static float y(const MovesOnly&) { return 0; }
    static float z(const MovesOnly&) { return 0; }
};
template <>
struct nephroid::vector_traits<AlmostTriple> {
    using scalar = float;
    static AlmostTriple make(float, float) { return {}; }
    static float x(AlmostTriple) { return 0; }
    static float y(AlmostTriple) { return 0; }
    static float z(AlmostTriple) { return 0; }
};

namespace {

// Foreign types: a plain "no", not an error inside.
static_assert(!Vector3<int> && !Vector3<float> && !Vector3<void> && !Vector3<std::string> && !Vector3<NoTraits>);
static_assert(!Vector3<glm::vec2> && !Vector3<glm::vec4> && !Vector3<std::array<float, 2>> &&
              !Vector3<std::array<float, 4>>);
static_assert(!Vector3<std::valarray<float>> && !Vector3<float[3]> && !Vector3<float*>);
static_assert(!Vector3<glm::vec3&> && !Vector3<const glm::vec3> && !Vector3<glm::vec3*>);

// Each part of the concept is asked for.
static_assert(!nephroid::detail::HasScalar<IntegerVector> && !Vector3<IntegerVector>);
static_assert(nephroid::detail::HasComponents<ReadsOnly> && !nephroid::detail::MakesFromComponents<ReadsOnly> &&
              !Vector3<ReadsOnly>);
static_assert(!nephroid::detail::HasComponents<MakesOnly> && nephroid::detail::MakesFromComponents<MakesOnly> &&
              !Vector3<MakesOnly>);
static_assert(nephroid::detail::HasComponents<MovesOnly> && nephroid::detail::MakesFromComponents<MovesOnly> &&
              !Vector3<MovesOnly>);
static_assert(!nephroid::detail::MakesFromComponents<AlmostTriple> && !Vector3<AlmostTriple>);
static_assert(!Vector3<std::array<int, 3>>, "traits for every T do not make a vector of integers");

TEST_CASE_TEMPLATE("vector_traits: make and the components are each other's inverse for every vector type", T, float,
                   double, Wide) {
    nephroid::tests::for_each_vector<T>([]<class V>() {
        static_assert(Vector3<V>);
        static_assert(std::is_same_v<scalar_t<V>, T>);
        using t = nephroid::vector_traits<V>;
        const V v = t::make(T(1.5), T(-2.25), T(4));
        CHECK(t::x(v) == T(1.5));
        CHECK(t::y(v) == T(-2.25));
        CHECK(t::z(v) == T(4));
    });
}

} // namespace
