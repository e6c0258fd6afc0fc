// SPDX-License-Identifier: MIT
/// @file  Lists the edges of a few neighbouring quads across which the density of light jumps.
#pragma once

#include "nephroid/vector/double3.hpp"
#include "nephroid/sheet/edge_pages.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace nephroid::detail {

/// Up to 4 × 4 quads that lie in one plane, [j][i] by rows along u.
struct QuadGrid {
    static constexpr std::size_t most = 4;

    std::size_t columns = 0, rows = 0;                          ///< of quads
    std::array<std::array<Double3, most + 1>, most + 1> corner; ///< relative to the block's middle, rounded
    std::array<std::array<std::array<double, 2>, most + 1>, most + 1> in_plane; ///< the same along two axes u × v = n
    double share = 0;                                                           ///< of the patch's flux, in each quad
};

/// Makes edges and loose triangles of a grid of quads.
///
/// A quad that is a parallelogram to within a tenth is one piece, any other is two triangles of equal flux. A triangle
/// with too little area for a density goes to `loose`.
template <Scalar T>
class BlockEdges {
public:
    /// @param loose  loose(a, b, c, share): gets such a triangle, by its corners (row and column in the grid) and its
    ///               share of the flux
    template <class Loose>
    BlockEdges(const QuadGrid& grid, double pixel, const Loose& loose) : grid_(grid), pixel_(pixel) {
        for (std::size_t j = 0; j < grid.rows; ++j)
            for (std::size_t i = 0; i < grid.columns; ++i)
                set_densities(j, i, loose);
    }

    /// The largest density of a piece.
    [[nodiscard]] double largest() const { return largest_; }

    /// Appends the edges, eight to a group; the last one is filled up with edges without a jump.
    [[nodiscard]] std::span<const EdgeGroup<T>> append_to(EdgePages<T>& pages) {
        const std::size_t columns = grid_.columns, rows = grid_.rows;
        for (std::size_t j = 0; j <= rows; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                add({j, i}, {j, i + 1}, beside(j, i).below - beside(j - 1, i).above);
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i <= columns; ++i)
                add({j, i}, {j + 1, i}, beside(j, i - 1).right - beside(j, i).left);
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                add({j, is_forward(j, i) ? i : i + 1}, {j + 1, is_forward(j, i) ? i + 1 : i}, beside(j, i).diagonal);
        return written_to(pages);
    }

private:
    using Corner = std::array<std::size_t, 2>; // row, column

    static constexpr std::size_t lanes = EdgeGroup<T>::lanes;
    static constexpr std::size_t most_edges =
        (2 * (QuadGrid::most + 1) * QuadGrid::most + QuadGrid::most * QuadGrid::most + lanes - 1) / lanes * lanes;

    /// Densities beside a quad's sides, and their jump across its diagonal.
    struct Quad {
        double below = 0, right = 0, above = 0, left = 0, diagonal = 0;
    };

    /// A quad, or one of zero density for j or i of −1 or beyond the last.
    [[nodiscard]] const Quad& beside(std::size_t j, std::size_t i) const { return quads_[j + 1][i + 1]; }

    /// Whether a quad is cut from its first corner to the opposite one. Neighbours alternate.
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
    void set_densities(std::size_t j, std::size_t i, const Loose& loose) {
        const Corner a{j, i}, b{j, i + 1}, c{j + 1, i + 1}, d{j + 1, i};
        const std::array<double, 4> corners = {area(a, b, d), area(a, b, c), area(b, c, d), area(a, c, d)};
        const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
        const double smaller = (std::min)(std::abs(*least), std::abs(*most));
        const double larger = (std::max)(std::abs(*least), std::abs(*most));
        Quad& quad = quads_[j + 1][i + 1];
        const auto density = [&](double signed_area, double share, const Corner& p, const Corner& q, const Corner& r) {
            // With less area than this, the rounding of its corners would show in its density.
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
            quad = {w, w, w, w, 0};
        } else if (is_forward(j, i)) {
            const double right = density(corners[1], half, a, b, c), left = density(corners[3], half, a, c, d);
            quad = {right, right, left, left, left - right};
        } else {
            const double left = density(corners[0], half, a, b, d), right = density(corners[2], half, b, c, d);
            quad = {left, right, right, left, left - right};
        }
    }

    /// Lists an edge if the density jumps across it. Written without a branch.
    void add(const Corner& from, const Corner& to, double jump) {
        from_[count_] = number(from);
        to_[count_] = number(to);
        jump_[count_] = T(jump);
        count_ += std::size_t(jump != 0);
    }

    [[nodiscard]] static std::uint8_t number(const Corner& c) {
        return std::uint8_t(c[0] * (QuadGrid::most + 1) + c[1]);
    }

    [[nodiscard]] std::span<const EdgeGroup<T>> written_to(EdgePages<T>& pages) {
        const std::size_t groups = (count_ + lanes - 1) / lanes;
        for (; count_ < groups * lanes; ++count_)
            from_[count_] = to_[count_] = 0, jump_[count_] = T(0);
        constexpr std::size_t side = QuadGrid::most + 1;
        std::array<std::array<T, side * side>, 3> corner{};
        for (std::size_t j = 0; j <= grid_.rows; ++j)
            for (std::size_t i = 0; i <= grid_.columns; ++i) {
                const Double3& c = grid_.corner[j][i];
                corner[0][j * side + i] = T(c.x), corner[1][j * side + i] = T(c.y), corner[2][j * side + i] = T(c.z);
            }
        const std::span<EdgeGroup<T>> room = pages.add(groups);
        for (std::size_t g = 0; g < groups; ++g)
            for (std::size_t i = 0; i < lanes; ++i) {
                const std::size_t from = from_[g * lanes + i], to = to_[g * lanes + i];
                for (std::size_t axis = 0; axis < 3; ++axis)
                    room[g].a[axis][i] = corner[axis][from], room[g].b[axis][i] = corner[axis][to];
                room[g].jump[i] = jump_[g * lanes + i];
            }
        return room;
    }

    const QuadGrid& grid_;
    double pixel_;
    std::array<std::array<Quad, QuadGrid::most + 2>, QuadGrid::most + 2> quads_{}; // a rim of darkness around them
    std::array<std::uint8_t, most_edges + 1> from_, to_;                           // corners of the edges listed
    std::array<T, most_edges + 1> jump_;
    std::size_t count_ = 0;
    double largest_ = 0;
};

} // namespace nephroid::detail
