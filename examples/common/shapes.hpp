// SPDX-License-Identifier: MIT
/// @file  The shapes of a scene.
#pragma once

#include "common/shapes/cylinder.hpp"
#include "common/shapes/flat.hpp"
#include "common/shapes/mesh.hpp"
#include "common/shapes/sphere.hpp"
#include "common/shapes/wave.hpp"

#include <variant>

namespace nephroid::examples {

/// A shape has `bounds()`, `nearest(ray, t_max)`, which finds its first hit between `ray.t_min` and `t_max`, and
/// `hit(ray, candidate)`, which fills in the rest.
template <class T>
using Shape = std::variant<TriangleMesh<T>, Sphere<T>, Cylinder<T>, SineWave<T>, Floor<T>, Quad<T>, Disk<T>>;

} // namespace nephroid::examples
