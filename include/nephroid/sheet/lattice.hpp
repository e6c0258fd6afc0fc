// SPDX-License-Identifier: MIT
/// @file  Integer coordinates of places on a chart, so that neighbouring tiles agree on the nodes that they share.
#pragma once

#include "nephroid/vector/language.hpp"

#include <cstdint>

namespace nephroid::detail {

/// A place on a chart, in steps of the finest lattice.
struct LatticePlace {
    std::int64_t i, j;

    friend bool operator==(const LatticePlace&, const LatticePlace&) = default;
    friend LatticePlace operator+(const LatticePlace& a, const LatticePlace& b) { return {a.i + b.i, a.j + b.j}; }
    friend LatticePlace operator-(const LatticePlace& a, const LatticePlace& b) { return {a.i - b.i, a.j - b.j}; }
    friend LatticePlace operator*(std::int64_t s, const LatticePlace& a) { return {s * a.i, s * a.j}; }
};

/// How a chart is divided into cells, and a cell's sides into steps. Refinement halves the sides, and so does the
/// search for where sheets end.
struct Lattice {
    static constexpr unsigned bisections = 6;

    std::int64_t cells_u = 0, cells_v = 0; ///< even
    unsigned levels = 0;                   ///< of refinement

    /// How many steps a cell's side has.
    [[nodiscard]] std::int64_t step() const { return std::int64_t(1) << (levels + bisections); }
    [[nodiscard]] double u(const LatticePlace& p) const { return double(p.i) / (double(cells_u) * double(step())); }
    [[nodiscard]] double v(const LatticePlace& p) const { return double(p.j) / (double(cells_v) * double(step())); }
    /// The area of a square of one step, as a part of the chart.
    [[nodiscard]] double area() const {
        return 1 / (double(cells_u) * double(step()) * (double(cells_v) * double(step())));
    }
};

/// A rectangle of cells.
struct CellRange {
    std::int64_t begin_u, end_u, begin_v, end_v;

    [[nodiscard]] std::int64_t columns() const { return end_u - begin_u; }
    [[nodiscard]] std::int64_t rows() const { return end_v - begin_v; }
    [[nodiscard]] std::int64_t cells() const { return columns() * rows(); }
};

/// The area of the chart that a regular node stands for: that of a cell, and less at the chart's borders. 0 for a node
/// outside the range, which belongs to another range.
[[nodiscard]] inline double area_of_node(const Lattice& lattice, const CellRange& cells, const LatticePlace& place) {
    const auto share = [step = lattice.step()](std::int64_t at, std::int64_t begin, std::int64_t end,
                                               std::int64_t all) {
        const std::int64_t i = at / step;
        if (i < begin || i > end || (i == end && end != all))
            return 0.0;
        return i == 0 || i == all ? 0.5 : 1.0;
    };
    return share(place.i, cells.begin_u, cells.end_u, lattice.cells_u) *
           share(place.j, cells.begin_v, cells.end_v, lattice.cells_v) /
           (double(lattice.cells_u) * double(lattice.cells_v));
}

} // namespace nephroid::detail
