// SPDX-License-Identifier: MIT
/// @file  The nearest of many points: gathered with some to spare, and thinned out whenever there is no more room.
#pragma once

#include "nephroid/tree/smallest.hpp"
#include "nephroid/vector/not_unrolled.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid {

/// A point found by `PointTree::nearest`.
template <Scalar T>
struct Neighbour {
    T distance2;        ///< to the place asked for, world units squared
    std::uint32_t slot; ///< in the tree's leaf order
};

/// Every point counts.
struct AcceptAll {
    [[nodiscard]] constexpr bool operator()(std::size_t) const { return true; }
};

namespace detail {
/// The nearest of the points offered. A heap of them would be put in order after every point, with a branch to guess at
/// each level; here a limit is found now and then that about as many lie within as are wanted, by counting.
template <Scalar T>
class NearestPoints {
public:
    /// @param wanted  how many points, > 0
    /// @param limit2  only points nearer than the root of this count
    /// @param lanes   how many are offered at once
    NearestPoints(std::size_t wanted, T limit2, std::size_t lanes)
        : wanted_(wanted), most_(wanted + (std::max)(wanted, 2 * lanes)), limit2_(limit2),
          unlimited_(!isfinite(limit2)) {
        assert(!is_busy() && "nephroid: accept() looks up nearest points itself");
        is_busy() = true;
        static thread_local std::vector<T> distances2; // these grow to the largest look-up, and stay
        static thread_local std::vector<std::uint32_t> slots;
        const std::size_t room = most_ + lanes;
        if (slots.size() < room) {
            distances2.resize(room);
            slots.resize(room);
        }
        distance2_ = distances2.data();
        slot_ = slots.data();
    }

    ~NearestPoints() { is_busy() = false; }
    NearestPoints(const NearestPoints&) = delete; // one at a time on a thread
    NearestPoints& operator=(const NearestPoints&) = delete;

    /// Whether a point at this distance may be among the nearest.
    [[nodiscard]] bool wants(T distance2) const { return bool(int(distance2 < limit2_) | int(unlimited_)); }

    /// @param distance2  of the points in slots from `slot` on
    /// @param count      how many of them there are; the others may be asked for, but do not count
    /// @param accept     accept(slot): whether a point counts at all
    template <std::size_t N, class Accept>
    void offer(const std::array<T, N>& distance2, std::size_t count, std::uint32_t slot, const Accept& accept) {
        const T limit2 = limit2_;
        const auto all = std::uint32_t(unlimited_);
        std::array<std::uint32_t, N> counts;
        std::uint32_t any = all;
        NEPHROID_NOT_UNROLLED
        for (std::size_t i = 0; i < N; ++i)
            any |= counts[i] = std::uint32_t(distance2[i] < limit2);
        if (any == 0)
            return;
        NEPHROID_NOT_UNROLLED
        for (std::size_t i = 0; i < N; ++i)
            counts[i] = (counts[i] | all) & std::uint32_t(accept(std::size_t(slot) + i));
        // Without a branch, as which points count is anybody's guess.
        std::size_t size = size_;
        for (std::size_t i = 0; i < count; ++i) {
            distance2_[size] = distance2[i];
            slot_[size] = std::uint32_t(slot + i);
            size += counts[i];
        }
        size_ = size;
        if (size > most_)
            thin(wanted_ / 8);
    }

    /// Puts the points wanted, or all there are, into `found`, in no particular order; returns how many.
    std::size_t put(std::span<Neighbour<T>> found) {
        if (size_ > wanted_)
            thin(0);
        for (std::size_t i = 0; i < size_; ++i)
            found[i] = {distance2_[i], slot_[i]};
        return size_;
    }

private:
    [[nodiscard]] static bool& is_busy() {
        static thread_local bool busy = false;
        return busy;
    }

    /// Keeps those wanted and `spare` others at most.
    void thin(std::size_t spare) {
        const T high = unlimited_ ? *std::max_element(distance2_, distance2_ + size_) : limit2_;
        const auto [limit2, at_limit] = limit_of_smallest<T>({distance2_, size_}, wanted_, spare, high);
        keep(limit2, at_limit);
    }

    /// Keeps the points below a limit, and as many more of those at it.
    void keep(T limit2, std::size_t more) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < size_; ++i) {
            const T distance2 = distance2_[i];
            const bool at_limit = more > 0 && distance2 == limit2;
            distance2_[kept] = distance2;
            slot_[kept] = slot_[i];
            kept += std::size_t(int(distance2 < limit2) | int(at_limit));
            more -= std::size_t(at_limit);
        }
        size_ = kept;
        limit2_ = limit2;
        unlimited_ = false;
    }

    std::size_t wanted_, most_, size_ = 0;
    T limit2_;
    bool unlimited_; ///< squared distances may be infinite, where positions span all of a scalar's range
    T* distance2_;   ///< of the points kept so far
    std::uint32_t* slot_;
};
} // namespace detail

} // namespace nephroid
