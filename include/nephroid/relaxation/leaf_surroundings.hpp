// SPDX-License-Identifier: MIT
/// @file  The photons around a leaf of a tree, copied into arrays that a compiler vectorises over.
#pragma once

#include "nephroid/tree/point_tree.hpp"
#include "nephroid/vector/algebra.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Copies of the photons in a leaf and around it; keeps its memory from one leaf to the next. While the leaf's photons
/// move, their copies here move at once, and the tree's stay where they were.
template <Vector3 V>
class LeafSurroundings {
public:
    using T = scalar_t<V>;

    /// Replaces the copies by those of the photons within the leaf's box grown by `reach`.
    ///
    /// @param enough  where more than so many photons make up a leaf and all coincide, they alone are copied: photons
    ///                of other leaves are no nearer to them
    void gather(const PointTree<V>& tree, const TreeLeaf& leaf, T reach, std::size_t enough) {
        Box<T> box;
        const T* const coordinates[3] = {tree.x(), tree.y(), tree.z()};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [low, high] =
                std::minmax_element(coordinates[axis] + leaf.first, coordinates[axis] + leaf.first + leaf.size);
            box.low[axis] = *low - reach, box.high[axis] = *high + reach;
        }
        size_ = leaf_begin_ = 0;
        leaf_ = leaf;
        if (box.low == box.high && leaf.size > enough)
            return append(tree, leaf, box);
        tree.visit_leaves(box, [&](std::uint32_t other) {
            if (tree.leaves()[other].first == leaf.first)
                leaf_begin_ = size_; // all of its photons lie in the box
            append(tree, tree.leaves()[other], box);
        });
    }

    [[nodiscard]] const TreeLeaf& leaf() const { return leaf_; }
    /// Whether the photon in a slot belongs to the leaf.
    [[nodiscard]] bool in_leaf(std::size_t slot) const {
        return slot >= leaf_.first && slot < leaf_.first + leaf_.size;
    }

    /// Where a photon of the leaf lies by now.
    [[nodiscard]] V position(std::size_t slot) const {
        const std::size_t i = leaf_begin_ + slot - leaf_.first;
        return make_vector<V>(x_[i], y_[i], z_[i]);
    }
    /// Moves a photon of the leaf.
    void move(std::size_t slot, const V& position) {
        using t = vector_traits<V>;
        const std::size_t i = leaf_begin_ + slot - leaf_.first;
        x_[i] = t::x(position), y_[i] = t::y(position), z_[i] = t::z(position);
    }

    /// Finds the copies within a radius of a point.
    /// @return  their numbers, ascending, for `slot` and `distance2`; until the next call
    [[nodiscard]] std::span<const std::uint32_t> within(T px, T py, T pz, T radius) {
        const T radius2 = radius * radius;
        const T *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
        T* const distance2 = distance2_.data();
        for (std::size_t i = 0; i < size_; ++i)
            distance2[i] = square(x[i] - px) + square(y[i] - py) + square(z[i] - pz);
        std::size_t hits = 0;
        const auto take = [&](std::size_t i) { // writes each, and counts those within: cheaper than a branch
            hits_[hits] = std::uint32_t(i);
            hits += distance2[i] <= radius2;
        };
        std::size_t block = 0;
        for (; block + 8 <= size_; block += 8) { // most blocks of eight lie outside as a whole
            T least[4];
            for (std::size_t i = 0; i < 4; ++i)
                least[i] = (std::min)(distance2[block + i], distance2[block + 4 + i]);
            if ((std::min)((std::min)(least[0], least[1]), (std::min)(least[2], least[3])) <= radius2)
                for (std::size_t i = 0; i < 8; ++i)
                    take(block + i);
        }
        for (; block < size_; ++block)
            take(block);
        return {hits_.data(), hits};
    }

    /// The slot of a copy, and its squared distance from the point of the last call of `within`.
    [[nodiscard]] std::uint32_t slot(std::uint32_t number) const { return slots_[number]; }
    [[nodiscard]] T distance2(std::uint32_t number) const { return distance2_[number]; }

private:
    void append(const PointTree<V>& tree, const TreeLeaf& leaf, const Box<T>& box) {
        if (size_ + leaf.size > slots_.size())
            resize(2 * size_ + PointTree<V>::leaf_size);
        std::size_t size = size_;
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
            // Writes each photon, and counts those in the box: cheaper than a branch.
            const T x = tree.x()[slot], y = tree.y()[slot], z = tree.z()[slot];
            x_[size] = x, y_[size] = y, z_[size] = z, slots_[size] = std::uint32_t(slot);
            size += std::size_t(int(x >= box.low[0]) & int(x <= box.high[0]) & int(y >= box.low[1]) &
                                int(y <= box.high[1]) & int(z >= box.low[2]) & int(z <= box.high[2]));
        }
        size_ = size;
    }

    void resize(std::size_t size) {
        x_.resize(size);
        y_.resize(size);
        z_.resize(size);
        distance2_.resize(size);
        slots_.resize(size);
        hits_.resize(size);
    }

    TreeLeaf leaf_{};
    std::size_t size_ = 0;       ///< how many copies there are
    std::size_t leaf_begin_ = 0; ///< the first copy of the leaf's own photons, which lie together
    std::vector<T> x_, y_, z_, distance2_;
    std::vector<std::uint32_t> slots_, hits_;
};

} // namespace nephroid::detail
