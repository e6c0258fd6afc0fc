// SPDX-License-Identifier: MIT
/// @file  The vector algebra that the library is written in, over any type with `vector_traits`.
#pragma once

#include "nephroid/vector/stable.hpp"
#include "nephroid/vector/traits.hpp"

#include <algorithm>
#include <type_traits>

namespace nephroid {

// Component-wise operators for every vector. Code inside namespace nephroid finds them by ordinary look-up, and the
// type's own by argument-dependent look-up. The type's own operator is used where it takes exactly these arguments
// (GLM, SSE vectors); these are used where it would convert, would build an expression template, or does not exist.
// User code does not see them without `using namespace nephroid`. A member `native_operators = true` of the traits
// removes them.
namespace detail {
template <class V>
concept UsesOurOperators = Vector3<V> && !requires {
    requires vector_traits<V>::native_operators;
};
} // namespace detail

template <detail::UsesOurOperators V>
[[nodiscard]] constexpr V operator+(const V& a, const V& b) {
    using t = vector_traits<V>;
    return t::make(t::x(a) + t::x(b), t::y(a) + t::y(b), t::z(a) + t::z(b));
}

template <detail::UsesOurOperators V>
[[nodiscard]] constexpr V operator-(const V& a, const V& b) {
    using t = vector_traits<V>;
    return t::make(t::x(a) - t::x(b), t::y(a) - t::y(b), t::z(a) - t::z(b));
}

template <detail::UsesOurOperators V>
[[nodiscard]] constexpr V operator-(const V& a) {
    using t = vector_traits<V>;
    return t::make(-t::x(a), -t::y(a), -t::z(a));
}

template <detail::UsesOurOperators V>
[[nodiscard]] constexpr V operator*(const std::type_identity_t<scalar_t<V>>& s, const V& a) {
    using t = vector_traits<V>;
    return t::make(s * t::x(a), s * t::y(a), s * t::z(a));
}

// The functions below are objects, so that an unqualified call inside the library is never a candidate for
// argument-dependent look-up in the vector's own namespace (glm::dot, Eigen's, ...).

/// Makes a vector from its components: make_vector<V>(x, y, z).
template <Vector3 V>
[[nodiscard]] constexpr V make_vector(scalar_t<V> x, scalar_t<V> y, scalar_t<V> z) {
    return vector_traits<V>::make(x, y, z);
}

template <Vector3 V>
[[nodiscard]] constexpr V zero_vector() {
    return make_vector<V>(scalar_t<V>(0), scalar_t<V>(0), scalar_t<V>(0));
}

namespace detail {
struct Dot {
    template <Vector3 V>
    [[nodiscard]] constexpr scalar_t<V> operator()(const V& a, const std::type_identity_t<V>& b) const {
        using t = vector_traits<V>;
        return t::x(a) * t::x(b) + t::y(a) * t::y(b) + t::z(a) * t::z(b);
    }
};

struct Cross {
    template <Vector3 V>
    [[nodiscard]] constexpr V operator()(const V& a, const std::type_identity_t<V>& b) const {
        using t = vector_traits<V>;
        return t::make(difference_of_products<scalar_t<V>>(t::y(a), t::z(b), t::z(a), t::y(b)),
                       difference_of_products<scalar_t<V>>(t::z(a), t::x(b), t::x(a), t::z(b)),
                       difference_of_products<scalar_t<V>>(t::x(a), t::y(b), t::y(a), t::x(b)));
    }
};

struct Length2 {
    template <Vector3 V>
    [[nodiscard]] constexpr scalar_t<V> operator()(const V& a) const {
        return Dot{}(a, a);
    }
};

struct Length {
    template <Vector3 V>
    [[nodiscard]] scalar_t<V> operator()(const V& a) const {
        return sqrt(Dot{}(a, a));
    }
};

struct Normalize {
    template <Vector3 V>
    [[nodiscard]] V operator()(const V& a) const {
        return scalar_t<V>(1) / Length{}(a)*a;
    }
};

struct LargestComponent {
    template <Vector3 V>
    [[nodiscard]] scalar_t<V> operator()(const V& a) const {
        using t = vector_traits<V>;
        using T = scalar_t<V>;
        return (std::max)({T(abs(T(t::x(a)))), T(abs(T(t::y(a)))), T(abs(T(t::z(a))))});
    }
};

struct DirectionOf {
    template <Vector3 V>
    [[nodiscard]] V operator()(const V& a) const {
        using t = vector_traits<V>;
        const scalar_t<V> largest = LargestComponent{}(a);
        return Normalize{}(t::make(t::x(a) / largest, t::y(a) / largest, t::z(a) / largest));
    }
};

struct AllFinite {
    template <Vector3 V>
    [[nodiscard]] bool operator()(const V& a) const {
        using t = vector_traits<V>;
        return isfinite(t::x(a)) && isfinite(t::y(a)) && isfinite(t::z(a));
    }
};
} // namespace detail

inline constexpr detail::Dot dot{};                            ///< a · b
inline constexpr detail::Cross cross{};                        ///< a × b, each component free of cancellation
inline constexpr detail::Length2 length2{};                    ///< |a|²
inline constexpr detail::Length length{};                      ///< |a|
inline constexpr detail::Normalize normalize{};                ///< a / |a|; a must not be zero
inline constexpr detail::LargestComponent largest_component{}; ///< the largest |aᵢ|
/// a / |a| for a of any length but zero, also where |a|² would underflow or overflow.
inline constexpr detail::DirectionOf direction_of{};
inline constexpr detail::AllFinite all_finite{}; ///< no component is NaN or infinite

} // namespace nephroid
