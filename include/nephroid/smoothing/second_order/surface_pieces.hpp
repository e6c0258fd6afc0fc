// SPDX-License-Identifier: MIT
/// @file  Sorts points into smooth pieces of surface, from their positions and normals alone. Two neighbours are on one
///        piece if each lies near the other's tangent plane, as near as the turn of the normal between them allows.
///        Across an edge or a step they do not.
#pragma once

#include "nephroid/execution/task_runner.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/tree/point_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A place on a surface, and the unit normal on the side that was met.
struct PlaceOnSurface {
    Double3 position, normal;
};

/// Whether two points may lie on one smooth surface. A point of an arc lies off another point's tangent by half of the
/// angle between the tangents times the distance. Twice as much is allowed, and a tenth of the distance for bumps and
/// facets.
[[nodiscard]] inline bool may_share_surface(const PlaceOnSurface& a, const PlaceOnSurface& b) {
    if (!(inner(a.normal, b.normal) > 0.7)) // an edge of 45 degrees
        return false;
    const Double3 away = b.position - a.position, turn = b.normal - a.normal;
    const double height = (std::max)(std::abs(inner(a.normal, away)), std::abs(inner(b.normal, away)));
    const double rounding = 2e-6 * (std::max)({std::abs(a.position.x), std::abs(a.position.y), std::abs(a.position.z)});
    return height <= std::sqrt(inner(away, away)) * (0.1 + std::sqrt(inner(turn, turn))) + rounding;
}

/// Points sorted into pieces. Two points are on one piece if a chain leads from one to the other in which each point is
/// one of the eight nearest to the one before and may share a surface with it.
template <Vector3 V>
class SurfacePieces {
public:
    using T = scalar_t<V>;
    static constexpr std::uint32_t unknown = (std::numeric_limits<std::uint32_t>::max)();

    /// @param points  finite
    SurfacePieces(std::vector<PlaceOnSurface> points, const TaskRunner& run)
        : points_(std::move(points)),
          tree_(points_.size(), [this](std::size_t i) { return to_world<V>(points_[i].position); }) {
        std::vector<std::array<std::uint32_t, linked>> links(points_.size());
        for_each_index(run, points_.size(), 256, [&](std::size_t i) { links[i] = neighbours_of(i); });
        std::vector<std::uint32_t> parents(points_.size());
        std::iota(parents.begin(), parents.end(), 0u);
        const auto root_of = [&](std::uint32_t i) {
            while (parents[i] != i)
                i = parents[i] = parents[parents[i]];
            return i;
        };
        for (std::uint32_t i = 0; i < points_.size(); ++i)
            for (const std::uint32_t other : links[i])
                if (other != unknown) {
                    const std::uint32_t a = root_of(i), b = root_of(other);
                    parents[(std::max)(a, b)] = (std::min)(a, b);
                }
        number([&](std::uint32_t i) { return root_of(i); });
    }

    /// How many points each piece has, the largest first.
    [[nodiscard]] const std::vector<std::uint32_t>& sizes() const { return sizes_; }
    /// Which piece a point is in.
    [[nodiscard]] std::uint32_t operator[](std::size_t point) const { return pieces_[point]; }

    /// The piece of a further point: that of the nearest point with which it may share a surface; `unknown` if none of
    /// the eight nearest may.
    [[nodiscard]] std::uint32_t piece_at(const PlaceOnSurface& point) const {
        std::array<Neighbour<T>, linked> found;
        const std::size_t count = tree_.nearest(tree_.relative(to_world<V>(point.position)), found);
        double nearest = std::numeric_limits<double>::infinity();
        std::uint32_t piece = unknown;
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t other = tree_.index(found[i].slot);
            if (double(found[i].distance2) < nearest && may_share_surface(point, points_[other])) {
                nearest = double(found[i].distance2);
                piece = pieces_[other];
            }
        }
        return piece;
    }

private:
    static constexpr std::size_t linked = 8; // nearest points; random points of a plane are connected by six

    [[nodiscard]] std::array<std::uint32_t, linked> neighbours_of(std::size_t point) const {
        std::array<Neighbour<T>, linked> found;
        const std::size_t count = tree_.nearest(tree_.relative(to_world<V>(points_[point].position)), found);
        std::array<std::uint32_t, linked> neighbours;
        for (std::size_t i = 0; i < linked; ++i) {
            neighbours[i] = i < count ? tree_.index(found[i].slot) : unknown;
            if (neighbours[i] != unknown && !may_share_surface(points_[point], points_[neighbours[i]]))
                neighbours[i] = unknown;
        }
        return neighbours;
    }

    /// Numbers the pieces by size, the largest first; those of equal size by their first point.
    template <class RootOf>
    void number(const RootOf& root_of) {
        std::vector<std::uint32_t> count(points_.size(), 0), roots;
        pieces_.resize(points_.size());
        for (std::uint32_t i = 0; i < points_.size(); ++i) {
            pieces_[i] = root_of(i);
            if (count[pieces_[i]]++ == 0)
                roots.push_back(pieces_[i]);
        }
        std::stable_sort(roots.begin(), roots.end(), [&](auto a, auto b) { return count[a] > count[b]; });
        std::vector<std::uint32_t> piece_of_root(points_.size(), unknown);
        for (std::uint32_t piece = 0; piece < roots.size(); ++piece) {
            piece_of_root[roots[piece]] = piece;
            sizes_.push_back(count[roots[piece]]);
        }
        for (std::uint32_t& piece : pieces_)
            piece = piece_of_root[piece];
    }

    std::vector<PlaceOnSurface> points_;
    PointTree<V> tree_;
    std::vector<std::uint32_t> pieces_, sizes_;
};

} // namespace nephroid::detail
