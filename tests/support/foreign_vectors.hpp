// SPDX-License-Identifier: MIT
/// @file  Vector types as renderers have them, one for each convention, and their traits.
#pragma once

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"
#include "nephroid/vector/traits.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <string>
#include <type_traits>

namespace foreign {

/// Three numbers and nothing else.
template <class T>
struct Plain {
    T x, y, z;
};

/// How often a type's own operators were called: binary + and −, unary −, scalar times vector, and the element-wise
/// product.
struct Calls {
    int plus = 0, minus = 0, negate = 0, scale = 0, elementwise = 0;
};

/// As in shading languages: converts from one number, `*` is element-wise, products are static members.
template <class T>
class Shading {
public:
    inline static Calls calls;

    Shading(T all) : c_{all, all, all} {}
    Shading(T x, T y, T z) : c_{x, y, z} {}

    T operator[](std::size_t i) const { return c_[i]; }
    Shading operator+(const Shading& b) const {
        ++calls.plus;
        return {c_[0] + b[0], c_[1] + b[1], c_[2] + b[2]};
    }
    Shading operator-(const Shading& b) const {
        ++calls.minus;
        return {c_[0] - b[0], c_[1] - b[1], c_[2] - b[2]};
    }
    Shading operator-() const {
        ++calls.negate;
        return {-c_[0], -c_[1], -c_[2]};
    }
    friend Shading operator*(const Shading& a, const Shading& b) {
        ++calls.elementwise;
        return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
    }
    static T dot(const Shading& a, const Shading& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
    static Shading cross(const Shading& a, const Shading& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

private:
    T c_[3];
};

/// As in SIMD libraries: four lanes, aligned, with its own operators and functions in its namespace.
template <class T>
struct alignas(4 * sizeof(T)) Aligned {
    inline static Calls calls;

    T lane[4];

    friend Aligned operator+(const Aligned& a, const Aligned& b) {
        ++calls.plus;
        return {{a.lane[0] + b.lane[0], a.lane[1] + b.lane[1], a.lane[2] + b.lane[2], 0}};
    }
    friend Aligned operator-(const Aligned& a, const Aligned& b) {
        ++calls.minus;
        return {{a.lane[0] - b.lane[0], a.lane[1] - b.lane[1], a.lane[2] - b.lane[2], 0}};
    }
    friend Aligned operator-(const Aligned& a) {
        ++calls.negate;
        return {{-a.lane[0], -a.lane[1], -a.lane[2], 0}};
    }
    friend Aligned operator*(T s, const Aligned& a) {
        ++calls.scale;
        return {{s * a.lane[0], s * a.lane[1], s * a.lane[2], 0}};
    }
    // The same names as the library's with other meanings: the library must not call these.
    friend void dot(const Aligned&, const Aligned&) = delete;
    friend void cross(const Aligned&, const Aligned&) = delete;
    friend void length(const Aligned&) = delete;
    friend void normalize(const Aligned&) = delete;
};

/// Its operators are constrained templates for a family of types, as good a match as the library's: the traits choose.
template <class T>
struct Family {
    inline static Calls calls;
    static constexpr bool in_family = true;

    T x, y, z;
};

template <class V>
concept InFamily = V::in_family;

template <InFamily V>
V operator+(const V& a, const V& b) {
    ++V::calls.plus;
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <InFamily V>
V operator-(const V& a, const V& b) {
    ++V::calls.minus;
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <InFamily V>
V operator-(const V& a) {
    ++V::calls.negate;
    return {-a.x, -a.y, -a.z};
}
template <InFamily V>
V operator*(const decltype(V::x)& s, const V& a) {
    ++V::calls.scale;
    return {s * a.x, s * a.y, s * a.z};
}

} // namespace foreign

namespace nephroid {

template <class T>
struct vector_traits<foreign::Plain<T>> {
    using scalar = T;
    using vector = foreign::Plain<T>;
    static constexpr vector make(T x, T y, T z) { return {x, y, z}; }
    static constexpr T x(const vector& v) { return v.x; }
    static constexpr T y(const vector& v) { return v.y; }
    static constexpr T z(const vector& v) { return v.z; }
};

template <class T>
struct vector_traits<std::array<T, 3>> {
    using scalar = T;
    using vector = std::array<T, 3>;
    static constexpr vector make(T x, T y, T z) { return {x, y, z}; }
    static constexpr T x(const vector& v) { return v[0]; }
    static constexpr T y(const vector& v) { return v[1]; }
    static constexpr T z(const vector& v) { return v[2]; }
};

template <class T>
struct vector_traits<foreign::Shading<T>> {
    using scalar = T;
    using vector = foreign::Shading<T>;
    static vector make(T x, T y, T z) { return {x, y, z}; }
    static T x(const vector& v) { return v[0]; }
    static T y(const vector& v) { return v[1]; }
    static T z(const vector& v) { return v[2]; }
};

template <class T>
struct vector_traits<foreign::Aligned<T>> {
    using scalar = T;
    using vector = foreign::Aligned<T>;
    static vector make(T x, T y, T z) { return {{x, y, z, 0}}; }
    static T x(const vector& v) { return v.lane[0]; }
    static T y(const vector& v) { return v.lane[1]; }
    static T z(const vector& v) { return v.lane[2]; }
};

template <class T>
struct vector_traits<foreign::Family<T>> {
    using scalar = T;
    using vector = foreign::Family<T>;
    static constexpr bool native_operators = true;
    static vector make(T x, T y, T z) { return {x, y, z}; }
    static T x(const vector& v) { return v.x; }
    static T y(const vector& v) { return v.y; }
    static T z(const vector& v) { return v.z; }
};

namespace tests {

/// Calls `test.template operator()<V>()` for each vector type V of scalar T. A built-in T has them all.
template <class T, class F>
void for_each_vector(const F& test) {
    const auto run = [&]<class V>(const std::string& name) {
        INFO("vector type: ", name);
        test.template operator()<V>();
    };
    run.template operator()<foreign::Plain<T>>("a plain struct");
    if constexpr (std::is_floating_point_v<T>) {
        run.template operator()<glm::vec<3, T>>("glm::vec");
        run.template operator()<glm::vec<3, T, glm::lowp>>("glm::vec, lowp");
        run.template operator()<std::array<T, 3>>("std::array");
        run.template operator()<foreign::Shading<T>>("element-wise times");
        run.template operator()<foreign::Aligned<T>>("aligned");
        run.template operator()<foreign::Family<T>>("native operators");
    }
}

} // namespace tests
} // namespace nephroid

TYPE_TO_STRING(nephroid::tests::Wide);
