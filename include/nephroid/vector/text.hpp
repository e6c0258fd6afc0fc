// SPDX-License-Identifier: MIT
/// @file  Numbers and vectors as text, for error messages.
#pragma once

#include "nephroid/vector/error.hpp"
#include "nephroid/vector/traits.hpp"

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace nephroid::detail {

/// The standard library writes numbers of this type; emscripten's of 2022 writes integers alone.
template <class D>
concept HasToChars = requires(char* at, D x) {
    std::to_chars(at, at, x).ptr;
};

/// As few digits as read back as the same number, tried one after the other.
template <class D>
[[nodiscard]] NEPHROID_NOINLINE std::string shortest_printed(D x) {
    char digits[32];
    for (int precision = 1; precision <= 17; ++precision) {
        std::snprintf(digits, sizeof digits, "%.*g", precision, x);
        if (!(std::strtod(digits, nullptr) != x))
            break;
    }
    return digits;
}

template <class D>
[[nodiscard]] NEPHROID_NOINLINE std::string shortest_text(D x) {
    if constexpr (HasToChars<D>) {
        char digits[32];
        return std::string(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
    } else {
        return shortest_printed(x);
    }
}

/// The shortest text that reads back as the same number; "nan", "inf".
template <Scalar T>
[[nodiscard]] std::string text_of(const T& x) {
    return shortest_text(static_cast<double>(x));
}

/// (x, y, z)
template <Vector3 V>
[[nodiscard]] NEPHROID_NOINLINE std::string text_of(const V& v) {
    using t = vector_traits<V>;
    std::string text(1, '(');
    text.append(text_of(scalar_t<V>(t::x(v)))).append(", ");
    text.append(text_of(scalar_t<V>(t::y(v)))).append(", ");
    return text.append(text_of(scalar_t<V>(t::z(v)))).append(")");
}

} // namespace nephroid::detail
