// SPDX-License-Identifier: MIT
/// @file  Eye path vertices, and what else the camera's rays find.
#pragma once

#include "common/ray.hpp"

#include "nephroid/emission/flux.hpp"
#include "nephroid/receiver/pixel_footprint.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace nephroid::examples {

/// A point of a diffuse surface that a pixel sees. Irradiance there times `weight` is what the pixel gets.
template <class T, Flux F>
struct EyeVertex {
    Vec3<T> position;
    Vec3<T> normal;         ///< geometric, unit, on the side that is seen
    Vec3<T> shading_normal; ///< unit, on the same side
    T position_error;       ///< bound on the distance from the surface
    std::uint32_t pixel;    ///< y * width + x, row 0 at the bottom
    F weight;               ///< throughput of the path from the camera × albedo/π / samples, 1 / steradian
    /// Of the sample's part of the pixel, if the camera sees the vertex directly; unknown through mirrors and glass.
    PixelFootprint<Vec3<T>> footprint{Vec3<T>(T(0)), Vec3<T>(T(0))};
    /// The share of the light here that meets the diffuse part of a mixture. Photons choose that part by chance, so
    /// their light already has this factor; light straight from a lamp does not.
    T diffuse_share = T(1);
};

struct EyePathOptions {
    unsigned samples = 1;       ///< for each pixel, > 0
    unsigned max_depth = 16;    ///< reflections and refractions on one path
    double least_weight = 1e-3; ///< a path with less throughput ends
    std::uint64_t seed = 0;
};

template <class T, Flux F>
struct EyePaths {
    std::vector<EyeVertex<T, F>> vertices; ///< by pixel, in an order that depends only on the arguments
    std::vector<F> emitted;                ///< radiance of emitters, by pixel
    std::size_t rays = 0;
};

/// The radiance of rays that leave the scene, by direction.
template <class T, Flux F>
using Background = std::function<F(const Vec3<T>&)>;

} // namespace nephroid::examples
