// SPDX-License-Identifier: MIT
/// @file  Numbers and vectors as text, for error messages.
#pragma once

#include "nephroid/vector/error.hpp"
#include "nephroid/vector/traits.hpp"

#include <charconv>
#include <string>

namespace nephroid::detail {

/// The shortest text that reads back as the same number; "nan", "inf".
template <Scalar T>
[[nodiscard]] NEPHROID_NOINLINE std::string text_of(const T& x) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, static_cast<double>(x)).ptr;
    return std::string(digits, end);
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
