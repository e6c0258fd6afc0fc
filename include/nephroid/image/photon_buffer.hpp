// SPDX-License-Identifier: MIT
/// @file  The photons of a lamp on a grid, with where each of their paths ended: a picture that the lamp takes.
///
/// Neighbours on the grid are neighbours at emission, so what differentials would say of a photon can be read off the
/// photons beside it.
/// Source: Wyman and Dachsbacher 2008, "Improving Image-Space Caustics Via Variable-Sized Splatting", section 3.
#pragma once

#include "nephroid/emission/chart/emission_chart.hpp"
#include "nephroid/sheet/node_lattice.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/vector/error.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace nephroid {

/// Where a grid's nodes lie.
enum class NodePlaces {
    centres, ///< in the middle of its cells: each photon stands for as much of the lamp. For splats
    corners, ///< at their corners, the square's own among them. For sheets, which join nodes and end at the last
};

/// How many nodes a grid has.
struct PhotonGrid {
    std::size_t columns = 141, rows = 141; ///< of nodes, 2 to 2²⁰ each
    NodePlaces nodes = NodePlaces::centres;
};

/// A grid of about as many nodes whose cells are about as wide as high where the light starts.
template <Vector3 V, Flux F>
[[nodiscard]] PhotonGrid square_grid(const EmissionChart<V, F>& chart, double nodes,
                                     NodePlaces places = NodePlaces::centres) {
    if (!(nodes > 0) || !std::isfinite(nodes) || !(chart.width > 0) || !(chart.height > 0))
        invalid_argument("nephroid::square_grid: " + detail::text_of(nodes) + " nodes on a chart of " +
                         detail::text_of(chart.width) + " by " + detail::text_of(chart.height) +
                         "; all three must be positive, and the nodes finite");
    const auto whole = [](double count) { return std::size_t(std::clamp(std::round(count), 2.0, 1048576.0)); };
    const double across = std::sqrt(nodes * chart.width / chart.height);
    return {whole(across), whole(nodes / across), places};
}

/// The nodes of one chart of a lamp. A node has an end for each way that its light took.
///
/// Memory: for each node 12 bytes, and for each end 44 with three floats a vector and one a flux (`bytes`).
template <Vector3 V, Flux F>
class PhotonBuffer {
public:
    using T = scalar_t<V>;
    using End = detail::NodeEnd<V, F>;

    /// Has no photons yet: `trace_buffer` makes one that does (image/trace_buffer.hpp).
    PhotonBuffer(EmissionChart<V, F> chart, const PhotonGrid& grid, bool has_surfaces)
        : chart_(std::move(chart)), grid_(checked(grid)),
          has_surfaces_(has_surfaces), lattice_{std::int64_t(grid.columns) - 1, std::int64_t(grid.rows) - 1, 0} {}

    [[nodiscard]] const PhotonGrid& grid() const { return grid_; }
    [[nodiscard]] const EmissionChart<V, F>& chart() const { return chart_; }
    /// Whether the scene's hits say which surface they are on. If not, neighbours that met different objects may have
    /// one signature.
    [[nodiscard]] bool has_surfaces() const { return has_surfaces_; }

    /// Where on the chart a node lies, 0 to 1.
    [[nodiscard]] double u(std::size_t i) const { return along(i, grid_.columns); }
    [[nodiscard]] double v(std::size_t j) const { return along(j, grid_.rows); }
    /// The distance of neighbours on the chart.
    [[nodiscard]] double step_u() const { return 1 / double(intervals(grid_.columns)); }
    [[nodiscard]] double step_v() const { return 1 / double(intervals(grid_.rows)); }

    /// The part of the chart that a node stands for; of nodes at corners, half as much on a side of the square.
    [[nodiscard]] double area(std::size_t i, std::size_t j) const {
        const auto share = [this](std::size_t at, std::size_t nodes) {
            return grid_.nodes == NodePlaces::corners && (at == 0 || at + 1 == nodes) ? 0.5 : 1.0;
        };
        return share(i, grid_.columns) * share(j, grid_.rows) * step_u() * step_v();
    }

    [[nodiscard]] detail::NodeEnds<V, F> ends(std::size_t i, std::size_t j) const {
        return nodes_[place(std::int64_t(i), std::int64_t(j))];
    }
    /// The same, and none beyond the grid.
    [[nodiscard]] detail::NodeEnds<V, F> known(const detail::LatticePlace& at) const {
        return nodes_.has(at) ? nodes_[at] : detail::NodeEnds<V, F>{};
    }
    [[nodiscard]] detail::LatticePlace place(std::int64_t i, std::int64_t j) const {
        return {i * lattice_.step(), j * lattice_.step()};
    }

    /// What became of the light; what landed has no fate before it is drawn.
    [[nodiscard]] const Statistics& account() const { return account_; }
    [[nodiscard]] double landed() const { return landed_; }
    /// Nodes whose scene drew a random number: their photons went a way that neighbours need not have gone.
    [[nodiscard]] std::uint64_t by_chance() const { return by_chance_; }
    [[nodiscard]] std::size_t bytes() const { return nodes_.bytes(); }

    /// @param trace  trace(i, j, ends, task): appends the ends of a node; called from several threads
    template <class Trace, class E>
    void fill(const Trace& trace, E& executor) {
        nodes_.fill(
            lattice_, cells(),
            [&](const detail::LatticePlace& at, auto& ends, std::size_t task) {
                trace(std::size_t(at.i / lattice_.step()), std::size_t(at.j / lattice_.step()), ends, task);
            },
            executor);
    }
    [[nodiscard]] std::size_t tasks() const { return detail::NodeGrid<V, F>::tasks_of(lattice_, cells()); }

    void book(const Statistics& account, double landed, std::uint64_t by_chance) {
        account_ += account;
        landed_ += landed;
        by_chance_ += by_chance;
    }

private:
    [[nodiscard]] static const PhotonGrid& checked(const PhotonGrid& grid) {
        const std::size_t most = std::size_t(1) << 20;
        if (grid.columns < 2 || grid.rows < 2 || grid.columns > most || grid.rows > most)
            invalid_argument("nephroid::PhotonBuffer: the grid has " + std::to_string(grid.columns) + " columns and " +
                             std::to_string(grid.rows) + " rows; it needs 2 to 1048576 of each");
        return grid;
    }

    [[nodiscard]] detail::CellRange cells() const { return {0, lattice_.cells_u, 0, lattice_.cells_v}; }
    [[nodiscard]] std::size_t intervals(std::size_t nodes) const {
        return grid_.nodes == NodePlaces::centres ? nodes : nodes - 1;
    }
    [[nodiscard]] double along(std::size_t at, std::size_t nodes) const {
        return (double(at) + (grid_.nodes == NodePlaces::centres ? 0.5 : 0)) / double(intervals(nodes));
    }

    EmissionChart<V, F> chart_;
    PhotonGrid grid_;
    bool has_surfaces_;
    detail::Lattice lattice_;
    detail::NodeGrid<V, F> nodes_;
    Statistics account_;
    double landed_ = 0;
    std::uint64_t by_chance_ = 0;
};

} // namespace nephroid
