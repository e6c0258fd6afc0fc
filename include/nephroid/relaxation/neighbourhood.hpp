// SPDX-License-Identifier: MIT
/// @file  The nearest neighbours of every photon, a leaf of photons at a time.
///
/// The photons of a leaf look for much the same neighbours. What lies around the leaf is gathered once into arrays
/// that a compiler vectorises over, as far out as the neighbourhoods reached before; each photon then only compares
/// distances.
#pragma once

#include "nephroid/relaxation/photon_cloud.hpp"

#include <algorithm>
#include <span>

namespace nephroid {

/// A photon's neighbours on its own surface are looked for among at most this many times as many of any surface: where
/// more photons of others lie between them, it has fewer, and the search an end.
inline constexpr std::size_t neighbour_crowd = 128;

template <class Cloud>
class Neighbourhood {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    /// Calls visit(slot, neighbours) for each photon of a leaf with those nearest to it on its surface, itself left
    /// out, nearest first: `count` of them, or fewer where they are not among its `neighbour_crowd` · count nearest of
    /// all.
    ///
    /// @param radius  by slot: a guess of the distance to the last of them; what is found does not depend on it but for
    ///                the order of photons at the same distance
    template <class Visit>
    void for_each(const Cloud& cloud, std::uint32_t leaf, std::size_t count, std::span<const T> radius, Visit&& visit) {
        const TreeLeaf range = cloud.tree().leaves()[leaf];
        const T reach = reach_of(range, radius);
        gather(cloud, range, count, reach);
        for (std::size_t slot = range.first; slot < range.first + range.size; ++slot) {
            const T guess = slack * radius[slot];
            const bool found = (guess < reach && find(cloud, slot, count, guess)) || find(cloud, slot, count, reach);
            if (!found)
                find_farther(cloud, slot, count);
            visit(slot, std::span<Neighbour<T>>(found_));
        }
    }

private:
    /// Photons move between two searches, and their neighbourhoods grow by a little.
    static constexpr T slack = T(1.15);

    /// As far as most photons of the leaf look: one that is by itself is not to make all others look as far.
    [[nodiscard]] static T reach_of(const TreeLeaf& range, std::span<const T> radius) {
        T most(0), sum(0);
        for (std::size_t slot = range.first; slot < range.first + range.size; ++slot) {
            most = (std::max)(most, radius[slot]);
            sum = sum + radius[slot];
        }
        return (std::min)(slack * most, T(2) * sum / T(range.size));
    }

    /// Copies the photons within the leaf's box grown by `reach`.
    void gather(const Cloud& cloud, const TreeLeaf& range, std::size_t count, T reach) {
        const PointTree<V>& tree = cloud.tree();
        Box<T> box;
        const T* const coordinates[3] = {tree.x(), tree.y(), tree.z()};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto [low, high] =
                std::minmax_element(coordinates[axis] + range.first, coordinates[axis] + range.first + range.size);
            box.low[axis] = *low - reach, box.high[axis] = *high + reach;
        }
        size_ = 0;
        // Photons in one place have neighbours enough, and those of other leaves in that place are no nearer.
        if (box.low == box.high && range.size > count)
            return append(tree, range, box);
        tree.visit_leaves(box, [&](std::uint32_t leaf) { append(tree, tree.leaves()[leaf], box); });
    }

    void append(const PointTree<V>& tree, const TreeLeaf& leaf, const Box<T>& box) {
        if (size_ + leaf.size > slots_.size())
            resize(2 * size_ + PointTree<V>::leaf_size);
        std::size_t size = size_;
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
            // Written whether it counts or not: cheaper than a branch that goes either way.
            const T x = tree.x()[slot], y = tree.y()[slot], z = tree.z()[slot];
            x_[size] = x, y_[size] = y, z_[size] = z, slots_[size] = std::uint32_t(slot);
            size += std::size_t(int(x >= box.low[0]) & int(x <= box.high[0]) & int(y >= box.low[1]) &
                                int(y <= box.high[1]) & int(z >= box.low[2]) & int(z <= box.high[2]));
        }
        size_ = size;
    }

    void resize(std::size_t size) {
        for (auto* const coordinate : {&x_, &y_, &z_, &distance2_})
            coordinate->resize(size);
        slots_.resize(size);
        hits_.resize(size);
    }

    /// Whether all `count` neighbours lie within a radius, which is no more than what was gathered for.
    [[nodiscard]] bool find(const Cloud& cloud, std::size_t slot, std::size_t count, T radius) {
        const T px = cloud.tree().x()[slot], py = cloud.tree().y()[slot], pz = cloud.tree().z()[slot];
        const T radius2 = radius * radius;
        const T *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
        T* const distance2 = distance2_.data();
        for (std::size_t i = 0; i < size_; ++i)
            distance2[i] = square(x[i] - px) + square(y[i] - py) + square(z[i] - pz);
        std::size_t hits = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            hits_[hits] = std::uint32_t(i);
            hits += distance2[i] <= radius2;
        }
        if (hits <= count)
            return false;
        found_.clear();
        for (std::size_t i = 0; i < hits; ++i)
            insert(cloud, slot, count, {distance2[hits_[i]], slots_[hits_[i]]});
        return found_.size() == count;
    }

    /// For photons that lie by themselves, by a search of their own.
    void find_farther(const Cloud& cloud, std::size_t slot, std::size_t count) {
        for (std::size_t crowd = 2; crowd <= neighbour_crowd; crowd *= 4) {
            crowd_.resize(crowd * count + 1);
            const std::size_t size = cloud.tree().nearest(cloud.position(slot), crowd_);
            found_.clear();
            for (std::size_t i = 0; i < size; ++i)
                insert(cloud, slot, count, crowd_[i]);
            if (found_.size() == count || size < crowd_.size())
                return;
        }
    }

    void insert(const Cloud& cloud, std::size_t slot, std::size_t count, const Neighbour<T>& neighbour) {
        const bool full = found_.size() == count;
        if ((full && !(neighbour.distance2 < found_.back().distance2)) || neighbour.slot == slot ||
            !cloud.same_surface(slot, neighbour.slot))
            return;
        if (!full)
            found_.push_back(neighbour);
        std::size_t i = found_.size() - 1;
        for (; i > 0 && neighbour.distance2 < found_[i - 1].distance2; --i)
            found_[i] = found_[i - 1];
        found_[i] = neighbour;
    }

    std::size_t size_ = 0;
    std::vector<T> x_, y_, z_, distance2_;
    std::vector<std::uint32_t> slots_, hits_;
    std::vector<Neighbour<T>> found_, crowd_;
};

} // namespace nephroid
