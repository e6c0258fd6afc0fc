// SPDX-License-Identifier: MIT
/// @file  A set of lights of any of the library's types.
#pragma once

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/disk.hpp"
#include "nephroid/emission/light/mesh.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/light/quad.hpp"
#include "nephroid/emission/light/sphere.hpp"
#include "nephroid/emission/light/spot.hpp"
#include "nephroid/emission/light_set.hpp"

namespace nephroid {

/// A scene's lights, of any of the library's types. Constructed from a `std::vector` of lights.
template <Vector3 V, Flux F>
using StandardLights = LightSet<PointLight<V, F>, SpotLight<V, F>, DirectionalLight<V, F>, DiskLight<V, F>,
                                QuadLight<V, F>, SphereLight<V, F>, MeshLight<V, F>>;

} // namespace nephroid
