// SPDX-License-Identifier: MIT
/// @file  Objects made where they are to stay.
#pragma once

#include "nephroid/version.hpp"

#include <type_traits>

namespace nephroid {

/// Becomes what `make()` returns: given to an optional's `emplace`, or after std::in_place, it makes the object in
/// there.
///
/// An aggregate that is written member by member and then copied is loaded in wide pieces while its narrow stores are
/// still on their way, which costs a processor as much as the arithmetic of a hit. Not for a type that can be
/// constructed from anything: it would take this object itself. (Compilers without the resolution of CWG 2327 may move
/// what is made, as they would without this.)
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
