// SPDX-License-Identifier: MIT
/// @file  GLM's vec3 and dvec3 as vectors: the library's default, and the only header that names GLM.
#pragma once

#include "nephroid/vector/traits.hpp"

#include <glm/vec3.hpp>

namespace nephroid {

template <class T, glm::qualifier Q>
struct vector_traits<glm::vec<3, T, Q>> {
    using scalar = T;
    using vector = glm::vec<3, T, Q>;

    [[nodiscard]] static constexpr vector make(T x, T y, T z) { return vector(x, y, z); }
    [[nodiscard]] static constexpr T x(const vector& v) { return v.x; }
    [[nodiscard]] static constexpr T y(const vector& v) { return v.y; }
    [[nodiscard]] static constexpr T z(const vector& v) { return v.z; }
};

static_assert(Vector3<glm::vec3> && Vector3<glm::dvec3>);

} // namespace nephroid
