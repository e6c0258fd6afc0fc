// SPDX-License-Identifier: MIT
/// @file  A renderer's own eye path vertex.
#pragma once

#include "nephroid/vector/traits.hpp"

namespace nephroid::tests {

/// Looks up, unless told otherwise.
template <class V>
struct Vertex {
    V position, normal = vector_traits<V>::make(0, 0, 1);
};

} // namespace nephroid::tests
