// SPDX-License-Identifier: MIT
/// @file  A random sample of a receiver's leaves, spread evenly over its tree.
#pragma once

#include "nephroid/sequence/hash.hpp"
#include "nephroid/tree/point_tree.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace nephroid::detail {

/// Chooses one leaf out of every few consecutive ones.
class LeafSample {
public:
    /// @param vertices  about how many vertices the chosen leaves should have in all
    template <Vector3 V>
    LeafSample(const PointTree<V>& tree, std::size_t vertices) : leaves_(std::uint32_t(tree.leaves().size())) {
        std::size_t all = 0;
        for (const TreeLeaf& leaf : tree.leaves())
            all += leaf.size;
        every_ = std::uint32_t((std::max<std::size_t>)(1, all / vertices));
    }

    /// Whether a leaf was chosen.
    [[nodiscard]] bool operator()(std::uint32_t leaf) const { return leaf == chosen(leaf / every_); }

    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::uint32_t group = 0; group * every_ < leaves_; ++group)
            if (const std::uint32_t leaf = chosen(group); leaf < leaves_)
                visit(leaf);
    }

private:
    [[nodiscard]] std::uint32_t chosen(std::uint32_t group) const {
        return group * every_ + std::uint32_t(mix_bits(group + 1) % every_);
    }

    std::uint32_t leaves_, every_ = 1;
};

} // namespace nephroid::detail
