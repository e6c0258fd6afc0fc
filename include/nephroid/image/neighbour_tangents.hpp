// SPDX-License-Identifier: MIT
/// @file  Tangents of photons from the photons beside them: what differentials say, for a tracer that has none.
///
/// The differences are those of light sheets (sheet/cell_tangents.hpp).
/// Derivation: include/nephroid/README.md, "Photons on a grid".
#pragma once

#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/image/photon_buffer.hpp"
#include "nephroid/sheet/cell_tangents.hpp"
#include "nephroid/transport/deposit.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid {

/// A buffer's photons, ready to be splatted.
template <Vector3 V, Flux F>
struct TangentPhotons {
    std::vector<Deposit<V, F, 2>> deposits; ///< row by row; tangents for smoothing 1
    std::uint64_t one_axis = 0;             ///< that have neighbours along one axis alone
    std::uint64_t isolated = 0;             ///< that have none
};

namespace detail {
/// Where light from a node would have gone on one step of the grid, had it met nothing: the change of where it starts
/// and of its direction, over the distance to where it landed.
template <Vector3 V, Flux F>
[[nodiscard]] std::array<Double3, 2> unrefracted_change(const PhotonBuffer<V, F>& buffer, std::size_t i, std::size_t j,
                                                        const NodeEnd<V, F>& end) {
    using T = scalar_t<V>;
    const double u = buffer.u(i), v = buffer.v(j);
    const auto at = [&](double x, double y) { return buffer.chart().emit(T(x), T(y)); };
    std::array<Double3, 2> change{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const double du = axis == 0 ? buffer.step_u() / 2 : 0, dv = axis == 1 ? buffer.step_v() / 2 : 0;
        const auto from = at((std::max)(u - du, 0.0), (std::max)(v - dv, 0.0)),
                   to = at((std::min)(u + du, 1.0), (std::min)(v + dv, 1.0));
        if (!from || !to)
            continue;
        const double distance = double(length(V(end.position - from->position)));
        change[axis] =
            double3(V(to->position - from->position)) + distance * (double3(to->direction) - double3(from->direction));
    }
    return change;
}

/// How a node's place changes over one step along each axis of the grid.
template <Vector3 V, Flux F>
[[nodiscard]] std::array<Double3, 2> neighbour_changes(const PhotonBuffer<V, F>& buffer, std::size_t i, std::size_t j,
                                                       const NodeEnd<V, F>& end) {
    const auto known = [&](const LatticePlace& place) { return buffer.known(place); };
    const LatticePlace place = buffer.place(std::int64_t(i), std::int64_t(j));
    // Where surfaces have numbers a signature tells objects apart, and a large difference is a fold. Else differences
    // that change by more than the light's own spacing are taken for a border between objects.
    const auto pixel = [&] {
        if (buffer.has_surfaces())
            return std::numeric_limits<double>::infinity();
        const auto free = unrefracted_change(buffer, i, j, end);
        return (std::max)(length(free[0]), length(free[1]));
    };
    return {change_along<V, F>(end, place, buffer.place(1, 0), known, pixel),
            change_along<V, F>(end, place, buffer.place(0, 1), known, pixel)};
}

/// Takes the part of a vector out that is across a plane.
[[nodiscard]] inline Double3 within_plane(const Double3& x, const Double3& normal) {
    return x - dot(x, normal) * normal;
}

/// The tangents of a node's deposit, in the plane of its surface.
template <Vector3 V, Flux F>
[[nodiscard]] std::array<V, 2> tangents_of(const PhotonBuffer<V, F>& buffer, std::size_t i, std::size_t j,
                                           const NodeEnd<V, F>& end, TangentPhotons<V, F>& counts) {
    const Double3 normal = double3(end.normal);
    std::array<Double3, 2> change = neighbour_changes(buffer, i, j, end);
    const bool has_u = length2(change[0]) > 0, has_v = length2(change[1]) > 0;
    if (!has_u && !has_v) {
        ++counts.isolated;
        change = unrefracted_change(buffer, i, j, end);
    } else if (has_u != has_v) {
        ++counts.one_axis;
        // The known axis turned by a right angle: a square, for want of better knowledge.
        change[has_u ? 1 : 0] = plain_cross(normal, has_u ? change[0] : -1.0 * change[1]);
    }
    const double full = 2 / std::sqrt(pi<double>); // an ellipse of semi-axes f/√π has the area of the cell
    return {to_world<V>(full * within_plane(change[0], normal)), to_world<V>(full * within_plane(change[1], normal))};
}
} // namespace detail

/// Gives a buffer's photons the tangents that their neighbours tell. With smoothing s the semi-axes of a photon's
/// footprint are s/√π times the differences.
///
/// ```cpp
/// const auto photons = nephroid::neighbour_tangents(buffer, threads);
/// nephroid::splat(photons.deposits, sums, {.smoothing = 2.5}, threads);
/// ```
///
/// @param executor  the photons do not depend on it
template <Vector3 V, Flux F, class E = SerialExecutor>
[[nodiscard]] TangentPhotons<V, F> neighbour_tangents(const PhotonBuffer<V, F>& buffer, E&& executor = E{}) {
    using T = scalar_t<V>;
    const PhotonGrid& grid = buffer.grid();
    detail::CheckedExecutor checked(executor);
    std::vector<TangentPhotons<V, F>> rows(grid.rows);
    checked(grid.rows, [&](std::size_t j) {
        for (std::size_t i = 0; i < grid.columns; ++i)
            for (const detail::NodeEnd<V, F>& end : buffer.ends(i, j))
                rows[j].deposits.push_back({end.position, end.normal, end.direction,
                                            static_cast<F>(end.density * T(buffer.area(i, j))),
                                            detail::tangents_of(buffer, i, j, end, rows[j])});
    });
    TangentPhotons<V, F> all;
    for (const auto& row : rows) {
        all.deposits.insert(all.deposits.end(), row.deposits.begin(), row.deposits.end());
        all.one_axis += row.one_axis;
        all.isolated += row.isolated;
    }
    return all;
}

} // namespace nephroid
