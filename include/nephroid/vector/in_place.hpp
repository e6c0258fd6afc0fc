// SPDX-License-Identifier: MIT
/// @file  Makes objects in place, without a copy.
#pragma once

#include "nephroid/vector/language.hpp"

#include <type_traits>

namespace nephroid {

/// Converts to what `make()` returns. Given to an optional's `emplace`, or after std::in_place, it constructs the
/// object inside the optional.
///
/// Writing an aggregate member by member and then copying it stalls the processor, because wide loads wait for narrow
/// stores; this takes as long as the arithmetic of a hit. Do not use it for a type that can be constructed from
/// anything, which would take the InPlace object itself. (Compilers without the resolution of CWG 2327 may still move
/// the object.)
///
/// ```cpp
/// std::optional<MyHit> hit(std::in_place, nephroid::InPlace{[&] { return mesh.hit(record); }});
/// ```
template <class Make>
struct InPlace {
    Make make;

    operator std::invoke_result_t<const Make&>() const { return make(); }
};
template <class Make>
InPlace(Make) -> InPlace<Make>;

} // namespace nephroid
