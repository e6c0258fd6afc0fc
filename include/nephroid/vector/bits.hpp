// SPDX-License-Identifier: MIT
/// @file  A value's bits as another type, also with standard libraries older than std::bit_cast (emscripten's).
#pragma once

#include "nephroid/vector/language.hpp"

#include <bit>

namespace nephroid::detail {

#ifdef __cpp_lib_bit_cast
using std::bit_cast;
#else
/// The compilers knew it before their libraries did.
template <class To, class From>
[[nodiscard]] constexpr To bit_cast(const From& from) noexcept {
    static_assert(sizeof(To) == sizeof(From), "nephroid: bits of a type of another size");
    return __builtin_bit_cast(To, from);
}
#endif

} // namespace nephroid::detail
