// SPDX-License-Identifier: MIT
/// @file  The concept of a vector, and the traits class that a renderer specialises for its own type.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <concepts>
#include <type_traits>

namespace nephroid {

/// Tells the library how to read and make a user's vector. Specialise it for a vector type of three components:
///
/// ```cpp
/// template <> struct nephroid::vector_traits<MyVec3> {
///     using scalar = float;
///     static MyVec3 make(float x, float y, float z) { return {x, y, z}; }
///     static float x(const MyVec3& v) { return v.x; }
///     static float y(const MyVec3& v) { return v.y; }
///     static float z(const MyVec3& v) { return v.z; }
/// };
/// ```
///
/// The type needs no operators (algebra.hpp says when its own are used), and products are computed from the components.
/// If the type's operators are templates that accept anything, they may be ambiguous with the library's;
/// `static constexpr bool native_operators = true;` in the traits then makes the library use the type's operators. The
/// primary template stays undefined, so that a concept answers "no" for a foreign type instead of failing inside.
template <class V>
struct vector_traits;

namespace detail {
template <class V>
concept HasVectorTraits = requires {
    sizeof(vector_traits<V>);
};

template <class V>
concept HasScalar = HasVectorTraits<V> && Scalar<typename vector_traits<V>::scalar>;

template <class V>
concept HasComponents = HasScalar<V> && requires(const V v) {
    { vector_traits<V>::x(v) } -> std::convertible_to<typename vector_traits<V>::scalar>;
    { vector_traits<V>::y(v) } -> std::convertible_to<typename vector_traits<V>::scalar>;
    { vector_traits<V>::z(v) } -> std::convertible_to<typename vector_traits<V>::scalar>;
};

template <class V>
concept MakesFromComponents = HasScalar<V> && requires(const typename vector_traits<V>::scalar s) {
    { vector_traits<V>::make(s, s, s) } -> std::convertible_to<V>;
};
} // namespace detail

/// A vector of three components of one scalar type, described by `vector_traits`.
template <class V>
concept Vector3 = std::copyable<V> && detail::HasVectorTraits<V> && detail::HasScalar<V> && detail::HasComponents<V> &&
    detail::MakesFromComponents<V>;

namespace detail {
/// Says what is missing in the first line of the compiler's message.
template <class V>
consteval bool explain_vector() {
    static_assert(std::copyable<V>, "nephroid: a vector must be copyable, and not const or a reference");
    static_assert(HasVectorTraits<V>,
                  "nephroid: nephroid::vector_traits<V> is missing for this vector type: specialise "
                  "it (vector/traits.hpp), or include nephroid/vector/glm.hpp for GLM's");
    static_assert(HasScalar<V>, "nephroid: vector_traits<V>::scalar is missing or no scalar (vector/scalar.hpp)");
    static_assert(HasComponents<V>, "nephroid: vector_traits<V>::x(v), y(v) or z(v) is missing or not a scalar");
    static_assert(MakesFromComponents<V>, "nephroid: vector_traits<V>::make(x, y, z) is missing or makes no vector");
    return false;
}

/// Vector3, or an error that says why not; for class templates, where a wrong type can only be a mistake.
template <class V>
concept MustBeVector = Vector3<V> || explain_vector<V>();
} // namespace detail

template <Vector3 V>
using scalar_t = typename vector_traits<V>::scalar;

} // namespace nephroid
