// SPDX-License-Identifier: MIT
/// @file  A light with a wavelength and a scene that takes it, for the files about what such light is refused by.
#pragma once

#include "messages/renderer.hpp"

#include "nephroid/emission/spectrum/spectral.hpp"

using Sixteen = nephroid::Bands<float, 16>;

struct Glass : Scene {
    nephroid::Scattering<Sixteen, float> scatter(const Hit&, const V&, auto&, const auto&) const { return {}; }
};

inline const nephroid::DirectionalLight<V, Sixteen>
    sun16({.direction = V(0, 0, -1), .irradiance = Sixteen(1), .patch = nephroid::BoundingSphere<V>{V(0, 0, 0), 1}});
inline const nephroid::Spectral spectral_light(sun16, nephroid::EqualBands<16>{});
