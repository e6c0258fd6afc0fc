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
#include <cstdint>
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
        clear();
        columns_ = columns, rows_ = rows;
        stride_ = columns + 2;
        if (sums_.size() < stride_ * rows) {
            sums_.resize(stride_ * rows, 0.0);
            points_.resize(stride_ * rows, 0.0);
        }
        spans_.assign(rows, {});
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
        const bool is_within = (std::min)(a.x, b.x) >= 0 && (std::max)(a.x, b.x) <= double(columns_);
        const auto last = (std::min)(std::size_t(y1), rows_ - 1);
        double low = y0, x = a.x + slope * (low - a.y);
        for (auto row = std::size_t(y0); row <= last; ++row) {
            const double high = (std::min)(y1, double(row + 1));
            if (!(low < high))
                break;
            // The last end is the point itself: rounding could put it beyond the window.
            const double end = high == b.y ? b.x : a.x + slope * (high - a.y);
            if (is_within)
                add_within_row(row, (std::min)(x, end), (std::max)(x, end), sign * (high - low));
            else
                add_in_row(row, (std::min)(x, end), (std::max)(x, end), sign * (high - low));
            low = high, x = end;
        }
    }

    /// Whether two points lie in one texel, of those on the window; it may say so of others, which get nothing.
    [[nodiscard]] static bool share_texel(const TexelPoint& a, const TexelPoint& b) {
        const auto number = [](double x) { // truncation rounds downwards above zero
            return std::int32_t(std::clamp(x, -beyond_windows, beyond_windows) + beyond_windows);
        };
        return number(a.x) == number(b.x) && number(a.y) == number(b.y);
    }

    /// Adds to the texel of a point, without an area.
    void add_point(const TexelPoint& p, double amount) {
        if (p.x >= 0 && p.y >= 0 && p.x < double(columns_) && p.y < double(rows_)) {
            const auto row = std::size_t(p.y), column = std::size_t(p.x);
            points_[row * stride_ + column] += amount;
            spans_[row].include(column, column + 1);
        }
    }

    /// Calls visit(column, row, amount) for each texel that got anything. A running sum leaves 10⁻¹⁶ of a row's
    /// largest edge behind; that is no light.
    template <class Visit>
    void visit(const Visit& visit) const {
        for (std::size_t row = 0; row < rows_; ++row) {
            const double* const sums = sums_.data() + row * stride_;
            const double* const points = points_.data() + row * stride_;
            double sum = 0, largest = 0;
            const std::size_t end = (std::min)(spans_[row].end, columns_);
            for (std::size_t column = spans_[row].first; column < end; ++column) {
                sum += sums[column];
                largest = (std::max)({largest, std::abs(sums[column]), std::abs(sum)});
                const double amount = (sum > 1e-13 * largest ? sum : 0) + points[column];
                if (amount > 0)
                    visit(column, row, amount);
            }
        }
    }

private:
    /// The columns of a row in which anything changes.
    struct Span {
        std::size_t first = std::size_t(-1), end = 0;

        void include(std::size_t from, std::size_t to) {
            first = (std::min)(first, from);
            end = (std::max)(end, to);
        }
    };

    /// Only what was written: most of a window's texels lie beside a slanted patch.
    void clear() {
        for (std::size_t row = 0; row < spans_.size(); ++row)
            if (const Span& span = spans_[row]; span.first < span.end) {
                std::fill(&sums_[row * stride_ + span.first], &sums_[row * stride_] + span.end, 0.0);
                std::fill(&points_[row * stride_ + span.first], &points_[row * stride_] + span.end, 0.0);
            }
    }

    /// A piece of an edge in a row, from x0 to x1 >= x0, with its height as weight.
    void add_in_row(std::size_t row, double x0, double x1, double weight) {
        const double right = double(columns_);
        if (x0 >= right) { // what is open on its left stays so up to the border
            spans_[row].end = stride_;
            return;
        }
        if (x1 <= 0) {
            sums_[row * stride_] += weight;
            spans_[row].include(0, 1);
            return;
        }
        const double per_x = weight / (std::max)(x1 - x0, 1e-300);
        if (x0 < 0) {
            sums_[row * stride_] += per_x * -x0;
            spans_[row].include(0, 1);
            weight = per_x * x1;
            x0 = 0;
        }
        if (x1 > right) {
            spans_[row].end = stride_;
            weight = per_x * (right - x0);
            x1 = right;
        }
        add_within_row(row, x0, x1, weight);
    }

    /// The same for a piece that lies on the window.
    void add_within_row(std::size_t row, double x0, double x1, double weight) {
        double* const sums = sums_.data() + row * stride_;
        const auto first = std::size_t(x0), last = std::size_t(x1);
        spans_[row].include(first, last + 2);
        if (first == last) {
            const double part = weight * (0.5 * (x0 + x1) - double(first));
            sums[first] += weight - part;
            sums[first + 1] += part;
            return;
        }
        const double per_x = weight / (x1 - x0);
        for (std::size_t column = first; column <= last; ++column) {
            const double low = (std::max)(x0, double(column)), high = (std::min)(x1, double(column + 1));
            const double whole = per_x * (high - low), part = whole * (0.5 * (low + high) - double(column));
            sums[column] += whole - part;
            sums[column + 1] += part;
        }
    }

    static constexpr double beyond_windows = 1 << 20; ///< texels: all windows are smaller

    std::size_t columns_ = 0, rows_ = 0, stride_ = 2;
    std::vector<double> sums_, points_;
    std::vector<Span> spans_;
};

} // namespace nephroid::detail
