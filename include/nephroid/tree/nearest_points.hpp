// SPDX-License-Identifier: MIT
/// @file  Collects the nearest of many points, with some to spare, and discards the furthest when it is full.
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
    T distance2;        ///< to the query point, world units squared
    std::uint32_t slot; ///< in the tree's leaf order
};

/// Accepts every point.
struct AcceptAll {
    [[nodiscard]] constexpr bool operator()(std::size_t) const { return true; }
};

namespace detail {
/// Collects the nearest of the points offered. A heap would be reordered after every point, with an unpredictable
/// branch at each level. Instead, from time to time a distance within which about as many points lie as are wanted is
/// found by counting, and points beyond it are discarded.
template <Scalar T>
class NearestPoints {
public:
    /// @param wanted  number of points, > 0
    /// @param limit2  squared distance within which points count
    /// @param lanes   number of points offered at once
    NearestPoints(std::size_t wanted, T limit2, std::size_t lanes)
        : wanted_(wanted), most_(wanted + (std::max)(wanted, 2 * lanes)), limit2_(limit2),
          unlimited_(!isfinite(limit2)) {
        assert(!is_busy() && "nephroid: accept() looks up nearest points itself");
        is_busy() = true;
        static thread_local std::vector<T> distances2; // kept between look-ups, as large as the largest needed
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
    NearestPoints(const NearestPoints&) = delete; // a thread may have one at a time
    NearestPoints& operator=(const NearestPoints&) = delete;

    /// Whether a point at this distance may be among the nearest.
    [[nodiscard]] bool wants(T distance2) const { return bool(int(distance2 < limit2_) | int(unlimited_)); }

    /// @param distance2  squared distances of the points in slots from `slot` on
    /// @param count      number of these points; `accept` may be called for the slots after them, but they do not count
    /// @param accept     accept(slot) returns whether a point counts
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
        // Without branches, because which points count is unpredictable.
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

    /// Puts the nearest points into `found` in no particular order, and returns their number: all, if there are fewer
    /// than wanted.
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

    /// Keeps the points wanted, and at most `spare` others.
    void thin(std::size_t spare) {
        const T high = unlimited_ ? *std::max_element(distance2_, distance2_ + size_) : limit2_;
        const auto [limit2, at_limit] = limit_of_smallest<T>({distance2_, size_}, wanted_, spare, high);
        keep(limit2, at_limit);
    }

    /// Keeps the points below a limit, and `more` of those at it.
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
    bool unlimited_; ///< whether points at infinite squared distance count: positions may span the scalar's whole range
    T* distance2_;   ///< of the points kept so far
    std::uint32_t* slot_;
};
} // namespace detail

} // namespace nephroid
