// SPDX-License-Identifier: MIT
/// @file  Where to split the primitives of a bounding volume hierarchy.
#pragma once

#include "common/ray.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace nephroid::examples {

/// A primitive of the hierarchy while it is built.
template <class T>
struct BvhPrimitive {
    Box<T> box;
    std::uint32_t index;
};

/// Splits ranges of primitives in two.
template <class T>
class BvhSplit {
public:
    using Primitive = BvhPrimitive<T>;

    /// @param leaf_size  largest number of primitives in a leaf, >= 1
    explicit BvhSplit(std::size_t leaf_size) : leaf_size_(leaf_size) {}

    [[nodiscard]] static Box<T> bounds_of(std::span<const Primitive> primitives) {
        Box<T> box;
        for (const Primitive& primitive : primitives)
            box.add(primitive.box);
        return box;
    }

    /// Reorders primitives by the cheapest split between bins, by the surface area heuristic.
    ///
    /// @return  the size of the lower part, never 0 or all
    std::size_t partition(std::span<Primitive> primitives) const {
        struct Bin {
            Box<T> box;
            std::size_t count = 0;
        };
        Box<T> centres;
        for (const Primitive& primitive : primitives)
            centres.add(centre(primitive));

        T least_cost = std::numeric_limits<T>::infinity();
        int best_axis = -1, best_split = 0;
        const auto bin_of = [&](const Primitive& primitive, int axis) {
            const T scale = T(bin_count) / (centres.max[axis] - centres.min[axis]);
            return (std::min)(int((centre(primitive)[axis] - centres.min[axis]) * scale), bin_count - 1);
        };
        for (int axis = 0; axis < 3; ++axis) {
            // Also false where a scale would overflow.
            if (!(centres.max[axis] - centres.min[axis] > T(bin_count) * (std::numeric_limits<T>::min)()))
                continue;
            std::array<Bin, bin_count> bins;
            for (const Primitive& primitive : primitives) {
                Bin& bin = bins[static_cast<std::size_t>(bin_of(primitive, axis))];
                bin.box.add(primitive.box);
                ++bin.count;
            }
            std::array<T, bin_count> cost_above{};
            Box<T> box;
            std::size_t count = 0;
            for (std::size_t i = bin_count - 1; i > 0; --i) {
                box.add(bins[i].box);
                count += bins[i].count;
                cost_above[i] = count == 0 ? std::numeric_limits<T>::infinity() : box.half_area() * leaves_for(count);
            }
            box = {};
            count = 0;
            for (std::size_t i = 1; i < bin_count; ++i) {
                box.add(bins[i - 1].box);
                count += bins[i - 1].count;
                const T cost = box.half_area() * leaves_for(count) + cost_above[i];
                if (count > 0 && cost < least_cost) {
                    least_cost = cost;
                    best_axis = axis;
                    best_split = int(i);
                }
            }
        }
        if (best_axis < 0) // all centres coincide
            return primitives.size() / 2;
        const auto above = std::partition(primitives.begin(), primitives.end(), [&](const Primitive& primitive) {
            return bin_of(primitive, best_axis) < best_split;
        });
        return static_cast<std::size_t>(above - primitives.begin());
    }

    /// Reorders primitives into equal halves along their longest extent.
    ///
    /// @return  the size of the lower half
    static std::size_t halve(std::span<Primitive> primitives) {
        Box<T> centres;
        for (const Primitive& primitive : primitives)
            centres.add(centre(primitive));
        const Vec3<T> d = centres.max - centres.min;
        const int axis = d.x >= d.y && d.x >= d.z ? 0 : d.y >= d.z ? 1 : 2;
        const auto middle = primitives.begin() + static_cast<std::ptrdiff_t>(primitives.size() / 2);
        std::nth_element(primitives.begin(), middle, primitives.end(),
                         [axis](const Primitive& a, const Primitive& b) { return centre(a)[axis] < centre(b)[axis]; });
        return primitives.size() / 2;
    }

private:
    static constexpr int bin_count = 16;

    /// Twice the centre, which is only compared.
    static Vec3<T> centre(const Primitive& primitive) { return primitive.box.min + primitive.box.max; }

    [[nodiscard]] T leaves_for(std::size_t count) const { return T((count + leaf_size_ - 1) / leaf_size_); }

    std::size_t leaf_size_;
};

} // namespace nephroid::examples
