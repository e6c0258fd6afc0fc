// SPDX-License-Identifier: MIT
/// @file  Exact areas of triangles in texels, by their edges: each edge adds what lies to its right, and a running sum
///        along each row makes areas of it.
///
/// Source: Levien 2016, "Inside the fastest font renderer in the world".
#pragma once

#include "nephroid/vector/language.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A point on the raster, in texels from the window's corner.
struct TexelPoint {
    double x, y;
};

/// A window of the raster, to which weighted triangles are added.
class TexelCoverage {
public:
    /// Begins anew. @param columns, rows  of the window
    void reset(std::size_t columns, std::size_t rows) {
        columns_ = columns, rows_ = rows;
        stride_ = columns + 2;
        sums_.assign(stride_ * rows, 0.0);
        points_.assign(columns * rows, 0.0);
    }

    /// Adds an edge. The edges of a triangle, head to tail and with one weight, add weight · area to each texel, where
    /// the area is positive if they run counter-clockwise.
    void add_edge(const TexelPoint& from, const TexelPoint& to, double weight) {
        if (from.y == to.y || weight == 0)
            return;
        const bool is_up = from.y < to.y;
        const TexelPoint a = is_up ? from : to, b = is_up ? to : from;
        const double y0 = (std::max)(a.y, 0.0), y1 = (std::min)(b.y, double(rows_));
        if (!(y0 < y1))
            return;
        const double slope = (b.x - a.x) / (b.y - a.y);
        // An edge that goes up has the inside of a counter-clockwise triangle on its left.
        const double sign = is_up ? -weight : weight;
        const auto last = (std::min)(std::size_t(y1), rows_ - 1);
        for (auto row = std::size_t(y0); row <= last; ++row) {
            const double low = (std::max)(y0, double(row)), high = (std::min)(y1, double(row + 1));
            if (low < high)
                add_in_row(row, a.x + slope * (low - a.y), a.x + slope * (high - a.y), sign * (high - low));
        }
    }

    /// Adds to the texel of a point, without an area.
    void add_point(const TexelPoint& p, double amount) {
        if (p.x >= 0 && p.y >= 0 && p.x < double(columns_) && p.y < double(rows_))
            points_[std::size_t(p.y) * columns_ + std::size_t(p.x)] += amount;
    }

    /// Calls visit(column, row, amount) for each texel that got anything. A running sum leaves 10⁻¹⁶ of a row's
    /// largest edge behind; that is no light.
    template <class Visit>
    void visit(const Visit& visit) const {
        for (std::size_t row = 0; row < rows_; ++row) {
            double sum = 0, largest = 0;
            for (std::size_t column = 0; column < columns_; ++column) {
                const double change = sums_[row * stride_ + column];
                sum += change;
                largest = (std::max)({largest, std::abs(change), std::abs(sum)});
                const double amount = (sum > 1e-13 * largest ? sum : 0) + points_[row * columns_ + column];
                if (amount > 0)
                    visit(column, row, amount);
            }
        }
    }

private:
    /// A piece of an edge within a row, with its height as weight.
    void add_in_row(std::size_t row, double x0, double x1, double weight) {
        if (x0 > x1)
            std::swap(x0, x1);
        const double right = double(columns_);
        double* const sums = sums_.data() + row * stride_;
        if (x1 <= 0) {
            sums[0] += weight;
            return;
        }
        if (x0 >= right)
            return;
        const double per_x = weight / (std::max)(x1 - x0, 1e-300);
        if (x0 < 0) {
            sums[0] += per_x * -x0;
            weight = per_x * x1;
            x0 = 0;
        }
        if (x1 > right) {
            weight = per_x * (right - x0);
            x1 = right;
        }
        const auto first = std::size_t(x0), last = std::size_t(x1);
        if (first == last) {
            const double middle = 0.5 * (x0 + x1) - double(first);
            sums[first] += weight * (1 - middle);
            sums[first + 1] += weight * middle;
            return;
        }
        for (std::size_t column = first; column <= last; ++column) {
            const double low = (std::max)(x0, double(column)), high = (std::min)(x1, double(column + 1));
            const double part = per_x * (high - low), middle = 0.5 * (low + high) - double(column);
            sums[column] += part * (1 - middle);
            sums[column + 1] += part * middle;
        }
    }

    std::size_t columns_ = 0, rows_ = 0, stride_ = 2;
    std::vector<double> sums_, points_;
};

} // namespace nephroid::detail
