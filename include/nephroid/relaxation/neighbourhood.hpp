// SPDX-License-Identifier: MIT
/// @file  The nearest neighbours of every photon, a leaf of photons at a time.
///
/// The photons of a leaf have much the same neighbours. All photons around the leaf, as far out as its photons'
/// neighbourhoods reached before, are gathered once into arrays that a compiler vectorises over; each photon then only
/// compares distances.
#pragma once

#include "nephroid/relaxation/photon_cloud.hpp"

#include <algorithm>
#include <span>
#include <type_traits>

namespace nephroid::detail {

/// A search for n neighbours on a photon's own surface ends at this many times n photons of any surface: where more
/// photons of other surfaces lie between, it finds fewer.
inline constexpr std::size_t most_candidates = 128;

template <class Cloud>
class Neighbourhood {
public:
    using V = typename Cloud::vector;
    using T = scalar_t<V>;

    /// Calls visit(slot, neighbours) for each photon of a leaf with the photons nearest to it on its surface, without
    /// itself, nearest first: `count` of them, or fewer where they are not among its `most_candidates` · count nearest
    /// of any surface.
    ///
    /// @param radius  by slot: a guess of the distance to the last neighbour; nothing but the order of photons at the
    ///                same distance depends on it
    /// @param visit   may return where it moves the photon: those of the leaf from the next but one on see it there
    template <class Visit>
    void for_each(const Cloud& cloud, std::uint32_t leaf, std::size_t count, std::span<const T> radius, Visit&& visit) {
        const TreeLeaf range = cloud.tree().leaves()[leaf];
        const T reach = reach_of(range, radius);
        gather(cloud, range, count, reach);
        [[maybe_unused]] std::size_t moved_slot = range.first;
        [[maybe_unused]] V moved_to = cloud.position(moved_slot);
        for (std::size_t slot = range.first; slot < range.first + range.size; ++slot) {
            const T guess = slack * radius[slot];
            const bool found = (guess < reach && find(cloud, slot, count, guess)) || find(cloud, slot, count, reach);
            if (!found)
                find_farther(cloud, slot, count);
            const std::span<Neighbour<T>> neighbours(found_);
            if constexpr (std::is_void_v<std::invoke_result_t<Visit&, std::size_t, std::span<Neighbour<T>>>>) {
                visit(slot, neighbours);
            } else {
                const V to = visit(slot, neighbours);
                put(moved_slot, moved_to); // of the photon before, so that no search waits for the last force
                moved_slot = slot, moved_to = to;
            }
        }
    }

    /// Where a photon lies that may belong to the leaf at hand, and so may have moved.
    [[nodiscard]] V position(const Cloud& cloud, std::size_t slot) const {
        if (!in_leaf(slot))
            return cloud.position(slot);
        const std::size_t i = own_ + slot - leaf_.first;
        return make_vector<V>(x_[i], y_[i], z_[i]);
    }

private:
    /// Photons move between two searches, and their neighbourhoods grow a little.
    static constexpr T slack = T(1.15);

    /// How far most photons of the leaf look: a lone one does not make all others look as far.
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
        size_ = own_ = 0;
        leaf_ = range;
        // Photons that coincide have neighbours enough, and those of other leaves are no nearer.
        if (box.low == box.high && range.size > count)
            return append(tree, range, box);
        tree.visit_leaves(box, [&](std::uint32_t leaf) {
            if (tree.leaves()[leaf].first == range.first)
                own_ = size_; // all of its photons lie in the box
            append(tree, tree.leaves()[leaf], box);
        });
    }

    void append(const PointTree<V>& tree, const TreeLeaf& leaf, const Box<T>& box) {
        if (size_ + leaf.size > slots_.size())
            resize(2 * size_ + PointTree<V>::leaf_size);
        std::size_t size = size_;
        for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot) {
            // Written whether it lies in the box or not: cheaper than a branch.
            const T x = tree.x()[slot], y = tree.y()[slot], z = tree.z()[slot];
            x_[size] = x, y_[size] = y, z_[size] = z, slots_[size] = std::uint32_t(slot);
            size += std::size_t(int(x >= box.low[0]) & int(x <= box.high[0]) & int(y >= box.low[1]) &
                                int(y <= box.high[1]) & int(z >= box.low[2]) & int(z <= box.high[2]));
        }
        size_ = size;
    }

    void put(std::size_t slot, const V& position) {
        using t = vector_traits<V>;
        const std::size_t i = own_ + slot - leaf_.first;
        x_[i] = t::x(position), y_[i] = t::y(position), z_[i] = t::z(position);
    }

    void resize(std::size_t size) {
        x_.resize(size);
        y_.resize(size);
        z_.resize(size);
        distance2_.resize(size);
        slots_.resize(size);
        hits_.resize(size);
    }

    /// Finds the neighbours among the gathered photons within a radius, at most the one gathered for.
    /// @return whether all `count` lie there
    [[nodiscard]] bool find(const Cloud& cloud, std::size_t slot, std::size_t count, T radius) {
        const T px = cloud.tree().x()[slot], py = cloud.tree().y()[slot], pz = cloud.tree().z()[slot];
        const T radius2 = radius * radius;
        const T *const x = x_.data(), *const y = y_.data(), *const z = z_.data();
        T* const distance2 = distance2_.data();
        for (std::size_t i = 0; i < size_; ++i)
            distance2[i] = square(x[i] - px) + square(y[i] - py) + square(z[i] - pz);
        std::size_t hits = 0;
        const auto take = [&](std::size_t i) { // whether it lies within or not: cheaper than a branch
            hits_[hits] = std::uint32_t(i);
            hits += distance2[i] <= radius2;
        };
        std::size_t block = 0;
        for (; block + 8 <= size_; block += 8) { // most eights lie outside as a whole
            T least[4];
            for (std::size_t i = 0; i < 4; ++i)
                least[i] = (std::min)(distance2[block + i], distance2[block + 4 + i]);
            if ((std::min)((std::min)(least[0], least[1]), (std::min)(least[2], least[3])) <= radius2)
                for (std::size_t i = 0; i < 8; ++i)
                    take(block + i);
        }
        for (; block < size_; ++block)
            take(block);
        if (hits <= count)
            return false;
        found_.clear();
        for (std::size_t i = 0; i < hits; ++i)
            insert(cloud, slot, count, {distance2[hits_[i]], slots_[hits_[i]]});
        return found_.size() == count;
    }

    /// For lone photons: a search in the tree, which has the leaf's own photons where they were.
    void find_farther(const Cloud& cloud, std::size_t slot, std::size_t count) {
        for (std::size_t times = 2; times <= most_candidates; times *= 4) {
            candidates_.resize(times * count + 1);
            const std::size_t size = cloud.tree().nearest(cloud.position(slot), candidates_);
            found_.clear();
            T farthest2(0);
            for (const Neighbour<T>& candidate : std::span(candidates_).first(size)) {
                farthest2 = (std::max)(farthest2, candidate.distance2);
                if (!in_leaf(candidate.slot))
                    insert(cloud, slot, count, candidate);
            }
            for (std::uint32_t own = leaf_.first; own < leaf_.first + leaf_.size; ++own) {
                const T distance2 = length2(V(position(cloud, own) - cloud.position(slot)));
                if (distance2 <= farthest2 || size < candidates_.size())
                    insert(cloud, slot, count, {distance2, own});
            }
            if (found_.size() == count || size < candidates_.size())
                return;
        }
    }

    [[nodiscard]] bool in_leaf(std::size_t slot) const {
        return slot >= leaf_.first && slot < leaf_.first + leaf_.size;
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

    TreeLeaf leaf_{};
    std::size_t size_ = 0, own_ = 0; ///< photons gathered, and from where on the leaf's own
    std::vector<T> x_, y_, z_, distance2_;
    std::vector<std::uint32_t> slots_, hits_;
    std::vector<Neighbour<T>> found_, candidates_;
};

} // namespace nephroid::detail
