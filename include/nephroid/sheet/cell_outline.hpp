// SPDX-License-Identifier: MIT
/// @file  The parts of a cell that are covered by a sheet which ends within it: polygons, found by marching squares.
#pragma once

#include "nephroid/sheet/node_lattice.hpp"

#include <array>
#include <cstddef>

namespace nephroid::detail {

/// A corner of such a polygon.
template <Vector3 V, Flux F>
struct OutlinePoint {
    double u, v; ///< in the cell, 0 to 1
    NodeEnd<V, F> node;
};

/// One connected part: up to four corners of the cell, and where the sheet ends on two of its sides.
template <Vector3 V, Flux F>
struct CellOutline {
    std::array<OutlinePoint<V, F>, 6> points;
    std::size_t size = 0;

    void add(const OutlinePoint<V, F>& point) { points[size++] = point; }

    /// The area of a triangle of its points, as a part of the cell's.
    [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
        const auto &p = points[a], &q = points[b], &r = points[c];
        return 0.5 * ((q.u - p.u) * (r.v - p.v) - (r.u - p.u) * (q.v - p.v));
    }

    [[nodiscard]] double area() const {
        double sum = 0;
        for (std::size_t i = 1; i + 1 < size; ++i)
            sum += area(0, i, i + 1);
        return sum;
    }
};

/// Finds where sheets end within cells.
///
/// @tparam Nodes  has `at(place)`: NodeCache
template <Vector3 V, Flux F, class Nodes, class Pixel>
class OutlineFinder {
public:
    using Node = NodeEnd<V, F>;

    /// @param halvings  how often a cell's side is halved at most, to find where on it a sheet ends
    OutlineFinder(Nodes& nodes, const Pixel& pixel, unsigned halvings)
        : nodes_(nodes), pixel_(pixel), halvings_(halvings) {}

    /// Calls visit(outline) for each part of the cell that is covered by the sheet of one signature.
    ///
    /// @param place     of the cell's first corner
    /// @param step      of its sides
    /// @param corner    its corners' ends with the signature, counter-clockwise from the first; null if a corner
    ///                  has none
    /// @param is_joined whether corners k and k + 1 are neighbours on one sheet
    template <class Visit>
    void visit_pieces(const LatticePlace& place, std::int64_t step, const std::array<const Node*, 4>& corner,
                      const std::array<bool, 4>& is_joined, const Visit& visit) {
        for (std::size_t first = 0; first < 4; ++first) {
            if (!corner[first] || is_joined[(first + 3) % 4])
                continue;
            std::size_t count = 1;
            while (count < 4 && is_joined[(first + count - 1) % 4])
                ++count;
            CellOutline<V, F> outline;
            add_border(outline, place, step, first, (first + 3) % 4, *corner[first]);
            for (std::size_t k = 0; k < count; ++k)
                outline.add({unit(first + k)[0], unit(first + k)[1], *corner[(first + k) % 4]});
            const std::size_t last = (first + count - 1) % 4;
            add_border(outline, place, step, last, (last + 1) % 4, *corner[last]);
            visit(outline);
        }
    }

private:
    /// Where corner k of a cell lies in it.
    [[nodiscard]] static std::array<double, 2> unit(std::size_t k) {
        return {k % 4 == 1 || k % 4 == 2 ? 1.0 : 0.0, k % 4 >= 2 ? 1.0 : 0.0};
    }

    /// Halves the side from a corner that is on the sheet towards one that is not, until a step is below a fraction
    /// of a pixel, or it has been halved often enough. The sheet's end is taken in the middle of what is left.
    void add_border(CellOutline<V, F>& outline, const LatticePlace& place, std::int64_t step, std::size_t from,
                    std::size_t to, const Node& corner) {
        const auto a = unit(from), b = unit(to);
        const LatticePlace begin{place.i + std::int64_t(a[0]) * step, place.j + std::int64_t(a[1]) * step};
        const LatticePlace way{std::int64_t(b[0] - a[0]), std::int64_t(b[1] - a[1])};
        Node inside = corner;
        std::int64_t on = 0, off = step;
        for (unsigned halved = 0; halved < halvings_ && off - on > 1; ++halved) {
            const std::int64_t middle = (on + off) / 2;
            const Node* const found = end_of<V, F>(nodes_.at(begin + middle * way), corner.signature);
            if (!found || !are_joined(inside, *found, pixel_)) {
                off = middle;
                continue;
            }
            const double moved2 = double(length2(V(found->position - inside.position)));
            inside = *found;
            on = middle;
            if (moved2 < square(0.25 * double(pixel_())))
                break;
        }
        const double share = 0.5 * double(on + off) / double(step);
        outline.add({a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), inside});
    }

    Nodes& nodes_;
    const Pixel& pixel_;
    unsigned halvings_;
};

} // namespace nephroid::detail
