// SPDX-License-Identifier: MIT
/// @file  From the corners of a few neighbouring quads to the edges across which the density of light jumps.
#pragma once

#include "nephroid/sheet/sheet_block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// Up to 4 × 4 quads that lie in one plane, [j][i] by rows along u.
struct QuadGrid {
    static constexpr std::size_t most = 4;

    std::size_t columns = 0, rows = 0;                          ///< of quads
    std::array<std::array<Double3, most + 1>, most + 1> corner; ///< relative to the block's middle, rounded
    std::array<std::array<std::array<double, 2>, most + 1>, most + 1> in_plane; ///< the same along two axes u × v = n
    double share = 0;                                                           ///< of a flux of 1, for each quad
};

/// Makes edges and loose triangles of a grid of quads.
///
/// A quad that is a parallelogram but for a tenth is one piece, any other is two triangles of equal flux. A triangle of
/// too little area for a density goes to `loose`.
template <Scalar T>
class BlockEdges {
public:
    /// @param loose  loose(a, b, c, share): a triangle of this share of the flux, corners as [row, column] of the grid
    template <class Loose>
    BlockEdges(const QuadGrid& grid, double pixel, const Loose& loose) : grid_(grid), pixel_(pixel) {
        for (std::size_t j = 0; j < grid.rows; ++j)
            for (std::size_t i = 0; i < grid.columns; ++i)
                weigh(j, i, loose);
    }

    /// The largest density of a piece.
    [[nodiscard]] double largest() const { return largest_; }

    /// Appends the edges, eight to a group; the last one is filled up with edges without a jump.
    void append_to(std::vector<EdgeGroup<T>>& edges) {
        const std::size_t columns = grid_.columns, rows = grid_.rows;
        for (std::size_t j = 0; j <= rows; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                add(edges, {j, i}, {j, i + 1},
                    (j < rows ? quads_[j][i].side[0] : 0) - (j > 0 ? quads_[j - 1][i].side[2] : 0));
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i <= columns; ++i)
                add(edges, {j, i}, {j + 1, i},
                    (i > 0 ? quads_[j][i - 1].side[1] : 0) - (i < columns ? quads_[j][i].side[3] : 0));
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                if (is_forward(j, i))
                    add(edges, {j, i}, {j + 1, i + 1}, quads_[j][i].diagonal);
                else
                    add(edges, {j, i + 1}, {j + 1, i}, quads_[j][i].diagonal);
    }

private:
    using Corner = std::array<std::size_t, 2>; // row, column

    /// Densities beside a quad's sides, counter-clockwise from the one along u, and their jump across its diagonal.
    struct Quad {
        std::array<double, 4> side{};
        double diagonal = 0;
    };

    /// Whether a quad is cut from its first corner to the opposite one; neighbours take turns.
    [[nodiscard]] static bool is_forward(std::size_t j, std::size_t i) { return ((i + j) & 1) == 0; }

    [[nodiscard]] double area(const Corner& a, const Corner& b, const Corner& c) const {
        const auto &p = grid_.in_plane[a[0]][a[1]], &q = grid_.in_plane[b[0]][b[1]], &r = grid_.in_plane[c[0]][c[1]];
        return 0.5 * ((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]));
    }

    [[nodiscard]] double longest2(const Corner& a, const Corner& b, const Corner& c) const {
        const auto &p = grid_.in_plane[a[0]][a[1]], &q = grid_.in_plane[b[0]][b[1]], &r = grid_.in_plane[c[0]][c[1]];
        const auto distance2 = [](const auto& x, const auto& y) { return square(x[0] - y[0]) + square(x[1] - y[1]); };
        return (std::max)({distance2(p, q), distance2(q, r), distance2(r, p)});
    }

    template <class Loose>
    void weigh(std::size_t j, std::size_t i, const Loose& loose) {
        const Corner a{j, i}, b{j, i + 1}, c{j + 1, i + 1}, d{j + 1, i};
        const std::array<double, 4> corners = {area(a, b, d), area(a, b, c), area(b, c, d), area(a, c, d)};
        const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
        const double smaller = (std::min)(std::abs(*least), std::abs(*most));
        const double larger = (std::max)(std::abs(*least), std::abs(*most));
        Quad& quad = quads_[j][i];
        const auto density = [&](double signed_area, double share, const Corner& p, const Corner& q, const Corner& r) {
            // Below this rounding of its corners would show in its density.
            const double least_area = 2e-4 * pixel_ * (std::max)(pixel_, std::sqrt(longest2(p, q, r)));
            if (!(std::abs(signed_area) >= least_area)) {
                loose(p, q, r, share);
                return 0.0;
            }
            const double w = share / signed_area;
            largest_ = (std::max)(largest_, std::abs(w));
            return w;
        };
        const double half = 0.5 * grid_.share;
        if (*least * *most > 0 && smaller >= 0.9 * larger && smaller > 2e-4 * pixel_ * pixel_ &&
            square(smaller) >= 4e-8 * square(pixel_) * (std::max)(longest2(a, b, c), longest2(a, c, d))) {
            const double w = grid_.share / (corners[1] + corners[3]);
            largest_ = (std::max)(largest_, std::abs(w));
            quad.side = {w, w, w, w};
        } else if (is_forward(j, i)) {
            const double right = density(corners[1], half, a, b, c), left = density(corners[3], half, a, c, d);
            quad = {{right, right, left, left}, left - right};
        } else {
            const double left = density(corners[0], half, a, b, d), right = density(corners[2], half, b, c, d);
            quad = {{left, right, right, left}, left - right};
        }
    }

    void add(std::vector<EdgeGroup<T>>& edges, const Corner& from, const Corner& to, double jump) {
        if (jump == 0)
            return;
        if (lane_ == EdgeGroup<T>::lanes) {
            edges.emplace_back();
            lane_ = 0;
        }
        EdgeGroup<T>& group = edges.back();
        const Double3 &a = grid_.corner[from[0]][from[1]], &b = grid_.corner[to[0]][to[1]];
        group.a[0][lane_] = T(a.x), group.a[1][lane_] = T(a.y), group.a[2][lane_] = T(a.z);
        group.b[0][lane_] = T(b.x), group.b[1][lane_] = T(b.y), group.b[2][lane_] = T(b.z);
        group.jump[lane_++] = T(jump);
    }

    const QuadGrid& grid_;
    double pixel_;
    std::array<std::array<Quad, QuadGrid::most>, QuadGrid::most> quads_;
    double largest_ = 0;
    std::size_t lane_ = EdgeGroup<T>::lanes;
};

} // namespace nephroid::detail
