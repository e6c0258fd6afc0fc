// SPDX-License-Identifier: MIT
/// @file  Cameras, and where in a pixel their samples lie.
#pragma once

#include "common/ray.hpp"

#include "nephroid/receiver/pixel_footprint.hpp"
#include "nephroid/sequence/hash.hpp"
#include "nephroid/vector/error.hpp"

#include <cmath>
#include <cstddef>

namespace nephroid::examples {

/// A pinhole or an orthographic camera with a film of square pixels. Film coordinates are in pixels, from the *lower*
/// left corner, as `Image` has its rows.
template <class T>
class Camera {
public:
    struct Pose {
        Vec3<T> position;
        Vec3<T> right, up, forward; ///< unit, orthogonal
    };

    /// @param vertical_angle  that the film's height subtends, radians, in (0, π)
    [[nodiscard]] static Camera perspective(const Pose& pose, T vertical_angle, std::size_t width, std::size_t height) {
        if (!(vertical_angle > T(0) && vertical_angle < pi<T>))
            invalid_argument("Camera: the vertical angle of view must lie between 0 and pi");
        return Camera(pose, true, std::tan(T(0.5) * vertical_angle), width, height);
    }

    /// @param half_height  of the film in world units, > 0
    [[nodiscard]] static Camera orthographic(const Pose& pose, T half_height, std::size_t width, std::size_t height) {
        if (!(half_height > T(0)))
            invalid_argument("Camera: the film's half height must be positive");
        return Camera(pose, false, half_height, width, height);
    }

    [[nodiscard]] std::size_t width() const { return width_; }
    [[nodiscard]] std::size_t height() const { return height_; }

    /// The ray through a point of the film, of unit direction.
    [[nodiscard]] Ray<T> ray(T x, T y) const {
        const T pixel = T(2) * half_height_ / T(height_);
        const T right = (x - T(0.5) * T(width_)) * pixel, up = (y - T(0.5) * T(height_)) * pixel;
        const Vec3<T> offset = right * pose_.right + up * pose_.up;
        if (!is_perspective_)
            return {pose_.position + offset, pose_.forward};
        return {pose_.position, normalize(pose_.forward + offset)};
    }

    /// What a part of the film sees of a surface's tangent plane.
    /// @param x, y           its middle, pixels
    /// @param width, height  of it, pixels
    [[nodiscard]] PixelFootprint<Vec3<T>> footprint(T x, T y, T width, T height, const Vec3<T>& position,
                                                    const Vec3<T>& normal) const {
        const auto at = [&](T right, T up) {
            const Ray<T> side = ray(x + T(0.5) * right * width, y + T(0.5) * up * height);
            return PixelRay<Vec3<T>>{side.origin, side.direction};
        };
        return footprint_from_rays(position, normal, at(T(-1), T(0)), at(T(1), T(0)), at(T(0), T(-1)), at(T(0), T(1)));
    }

private:
    Camera(const Pose& pose, bool is_perspective, T half_height, std::size_t width, std::size_t height)
        : pose_(pose), is_perspective_(is_perspective), half_height_(half_height), width_(width), height_(height) {
        if (width == 0 || height == 0)
            invalid_argument("Camera: a film without pixels");
    }

    Pose pose_;
    bool is_perspective_;
    T half_height_; ///< of the film, at distance 1 for a pinhole camera
    std::size_t width_, height_;
};

/// A place within a pixel, from its lower left corner.
template <class T>
struct PixelOffset {
    T x, y; ///< 0 to 1
};

/// The grid of n cells that a pixel's samples lie in, as square as n allows.
struct PixelGrid {
    unsigned columns, rows;

    /// @param n  > 0
    explicit PixelGrid(unsigned n) {
        rows = static_cast<unsigned>(std::sqrt(double(n)));
        while (n % rows != 0)
            --rows;
        columns = n / rows;
    }
};

/// The k-th of n samples of a pixel: the centre if it is the only one, else jittered within the cells of a grid of
/// n cells. A pure function of its arguments.
template <class T>
[[nodiscard]] PixelOffset<T> pixel_sample(std::uint64_t pixel, unsigned k, unsigned n, std::uint64_t seed) {
    if (n <= 1)
        return {T(0.5), T(0.5)};
    const PixelGrid grid(n);
    const std::uint64_t bits = hash_bits(hash_bits(seed, pixel), k);
    const T jitter_x = uniform_from_bits<T>(static_cast<std::uint32_t>(bits));
    const T jitter_y = uniform_from_bits<T>(static_cast<std::uint32_t>(bits >> 32));
    return {(T(k % grid.columns) + jitter_x) / T(grid.columns), (T(k / grid.columns) + jitter_y) / T(grid.rows)};
}

} // namespace nephroid::examples
