// SPDX-License-Identifier: MIT
/// @file  The test of a ray against the eight boxes of a hierarchy's node.
#pragma once

#include "common/ray.hpp"
#include "common/registers.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

namespace nephroid::examples {

/// A ray prepared for the slab test against eight boxes at once.
template <class T>
class Slabs {
public:
    static constexpr std::size_t width = 8;

    /// The boxes' planes by axis, the lower ones first: x_min, x_max, y_min, ... An absent box is empty.
    using Planes = std::array<std::array<T, width>, 6>;

    explicit Slabs(const Ray<T>& ray) {
        // More than the rounding of (plane − origin) · (1 / direction), so that no box is missed.
        // Source: Ize 2013, "Robust BVH Ray Traversal".
        constexpr T stretch = T(1) + T(4) * std::numeric_limits<T>::epsilon();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const T inverse = T(1) / ray.direction[int(axis)];
            origin_[axis] = Lanes{} + ray.origin[int(axis)];
            inverse_[axis] = Lanes{} + inverse;
            stretched_[axis] = Lanes{} + inverse * stretch;
            near_[axis] = 2 * axis + (inverse < T(0) ? 1 : 0);
        }
    }

    /// Computes where the ray enters each box.
    ///
    /// @return  the boxes that it meets, as bits. 0 · infinity (a ray in a plane and parallel to it) makes every
    ///          comparison false and so bounds nothing.
    [[nodiscard]] unsigned enter(const Planes& planes, T t_min, T t_max, std::array<T, width>& t) const {
        decltype(Lanes{} < Lanes{}) hit{};
        for (std::size_t first = 0; first < width; first += RegisterOf<T>::lanes) {
            Lanes from = Lanes{} + t_min, to = Lanes{} + t_max;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Lanes low, high;
                std::memcpy(&low, &planes[near_[axis]][first], sizeof low);
                std::memcpy(&high, &planes[near_[axis] ^ 1][first], sizeof high);
                const Lanes a = (low - origin_[axis]) * inverse_[axis];
                const Lanes b = (high - origin_[axis]) * stretched_[axis];
                from = a > from ? a : from;
                to = b < to ? b : to;
            }
            std::memcpy(&t[first], &from, sizeof from);
            hit |= bits_from(first, from <= to);
        }
        return all_bits(hit);
    }

private:
    using Lanes = typename RegisterOf<T>::type;

    std::array<Lanes, 3> origin_, inverse_, stretched_;
    std::array<std::size_t, 3> near_;
};

} // namespace nephroid::examples
