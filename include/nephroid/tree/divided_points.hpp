// SPDX-License-Identifier: MIT
/// @file  Points in contiguous memory that are halved recursively, for a tree's lower levels.
#pragma once

#include "nephroid/tree/box.hpp"
#include "nephroid/vector/bits.hpp"
#include "nephroid/vector/not_unrolled.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace nephroid::detail {

/// A point whose index is stored as a fourth coordinate, so that it is moved and compared as a vector of four.
template <Scalar T>
struct IndexedPoint {
    std::array<T, 4> at;

    IndexedPoint(const std::array<T, 3>& position, std::uint32_t index)
        : at{position[0], position[1], position[2], packed(index)} {}
    [[nodiscard]] std::uint32_t index() const {
        if constexpr (std::is_same_v<T, float>)
            return bit_cast<std::uint32_t>(at[3]);
        else
            return static_cast<std::uint32_t>(static_cast<double>(at[3]));
    }

private:
    [[nodiscard]] static T packed(std::uint32_t index) {
        if constexpr (std::is_same_v<T, float>)
            return bit_cast<float>(index);
        else
            return T(index);
    }
};

/// A part of a tree's points, which is sorted into the tree's order by halving it recursively.
template <Scalar T>
class DividedPoints {
public:
    using Point = IndexedPoint<T>;

    /// @param leaf_size  largest number of points in a leaf
    explicit DividedPoints(std::size_t leaf_size) : leaf_size_(leaf_size) {}

    [[nodiscard]] std::size_t size() const { return points_.size(); }
    [[nodiscard]] const Point& operator[](std::size_t i) const { return points_[i]; }
    void clear() { points_.clear(); }
    void add(const std::array<T, 3>& position, std::uint32_t index) { points_.push_back({position, index}); }

    [[nodiscard]] Box<T> bounds(std::size_t begin, std::size_t end) const {
        std::array<T, 4> low = points_[begin].at, high = low; // the fourth component has no meaning
        const Point* const points = points_.data();
        for (std::size_t i = begin + 1; i < end; ++i) {
            NEPHROID_NOT_UNROLLED
            for (std::size_t axis = 0; axis < 4; ++axis) {
                const T x = points[i].at[axis];
                low[axis] = x < low[axis] ? x : low[axis];
                high[axis] = high[axis] < x ? x : high[axis];
            }
        }
        return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    }

    /// Puts the points of the lower half along the longest side of the box first, and returns where the upper half
    /// begins. Large ranges are divided at the box's middle, the last few hundred points so that the leaves become as
    /// full as possible.
    [[nodiscard]] std::size_t halve(std::size_t begin, std::size_t end, const Box<T>& box) {
        std::size_t axis = 0;
        for (std::size_t other = 1; other < 3; ++other)
            if (box.high[other] - box.low[other] > box.high[axis] - box.low[axis])
                axis = other;
        const std::size_t size = end - begin, leaf_count = (size + leaf_size_ - 1) / leaf_size_;
        if (leaf_count > 12) {
            const std::size_t border = partition(axis, begin, end, T(0.5) * box.low[axis] + T(0.5) * box.high[axis]);
            if (border != begin && border != end)
                return border;
        }
        const std::size_t middle = begin + size * (leaf_count / 2) / leaf_count;
        select(axis, begin, end, middle, box.low[axis], box.high[axis]);
        return middle;
    }

private:
    /// Orders points as std::nth_element does. It searches by interpolation: coordinates are usually spread evenly, so
    /// that one pass over all points leaves few candidates. It has no unpredictable branch for each point.
    ///
    /// @param low, high  range of the coordinate
    void select(std::size_t axis, std::size_t begin, std::size_t end, std::size_t middle, T low, T high) {
        constexpr std::size_t few = 32;
        for (int tries = 0; tries < 8 && end - begin > few; ++tries) {
            const T share = T(middle - begin) / T(end - begin), guess = (T(1) - share) * low + share * high;
            const std::size_t border = partition(axis, begin, end, guess);
            if (border == middle)
                return;
            (middle < border ? end : begin) = border;
            (middle < border ? high : low) = guess;
        }
        std::nth_element(points_.begin() + std::ptrdiff_t(begin), points_.begin() + std::ptrdiff_t(middle),
                         points_.begin() + std::ptrdiff_t(end),
                         [axis](const Point& a, const Point& b) { return a.at[axis] < b.at[axis]; });
    }

    /// Puts the points below a border first, and returns where the others begin.
    [[nodiscard]] std::size_t partition(std::size_t axis, std::size_t begin, std::size_t end, T border) {
        Point* const points = points_.data();
        above_.resize(points_.size(), points[begin]);
        Point* const others = above_.data();
        std::size_t below = begin, above = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const Point point = points[i];
            const bool is_below = point.at[axis] < border;
            points[below] = others[above] = point;
            below += std::size_t(is_below);
            above += std::size_t(!is_below);
        }
        std::copy_n(others, above, points + below);
        return below;
    }

    std::size_t leaf_size_;
    std::vector<Point> points_, above_;
};

} // namespace nephroid::detail
