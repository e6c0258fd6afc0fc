// SPDX-License-Identifier: MIT
/// @file  The nearest neighbours of every photon, a leaf of photons at a time.
///
/// The photons of a leaf have much the same neighbours. All photons around the leaf, as far out as its photons'
/// neighbourhoods reached before, are copied once; each photon then only compares distances.
#pragma once

#include "nephroid/relaxation/leaf_surroundings.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"

#include <algorithm>
#include <span>
#include <type_traits>
#include <vector>

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
        around_.gather(cloud.tree(), range, reach, count);
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
                around_.move(moved_slot, moved_to); // the photon before, so that no search waits for the last force
                moved_slot = slot, moved_to = to;
            }
        }
    }

    /// Where a photon lies by now: those of the leaf at hand may have moved.
    [[nodiscard]] V position(const Cloud& cloud, std::size_t slot) const {
        return around_.in_leaf(slot) ? around_.position(slot) : cloud.position(slot);
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

    /// Finds the neighbours among the photons around the leaf, within a radius of at most the one gathered for.
    /// @return whether all `count` lie there
    [[nodiscard]] bool find(const Cloud& cloud, std::size_t slot, std::size_t count, T radius) {
        const auto hits =
            around_.within(cloud.tree().x()[slot], cloud.tree().y()[slot], cloud.tree().z()[slot], radius);
        if (hits.size() <= count)
            return false;
        found_.clear();
        for (const std::uint32_t number : hits)
            insert(cloud, slot, count, {around_.distance2(number), around_.slot(number)});
        return found_.size() == count;
    }

    /// For lone photons: a search in the tree, which has the leaf's own photons where they were.
    void find_farther(const Cloud& cloud, std::size_t slot, std::size_t count) {
        const TreeLeaf leaf = around_.leaf();
        for (std::size_t times = 2; times <= most_candidates; times *= 4) {
            candidates_.resize(times * count + 1);
            const std::size_t size = cloud.tree().nearest(cloud.position(slot), candidates_);
            found_.clear();
            T farthest2(0);
            for (const Neighbour<T>& candidate : std::span(candidates_).first(size)) {
                farthest2 = (std::max)(farthest2, candidate.distance2);
                if (!around_.in_leaf(candidate.slot))
                    insert(cloud, slot, count, candidate);
            }
            for (std::uint32_t own = leaf.first; own < leaf.first + leaf.size; ++own) {
                const T distance2 = length2(V(around_.position(own) - cloud.position(slot)));
                if (distance2 <= farthest2 || size < candidates_.size())
                    insert(cloud, slot, count, {distance2, own});
            }
            if (found_.size() == count || size < candidates_.size())
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

    LeafSurroundings<V> around_;
    std::vector<Neighbour<T>> found_, candidates_;
};

} // namespace nephroid::detail
