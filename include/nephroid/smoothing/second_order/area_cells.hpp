// SPDX-License-Identifier: MIT
/// @file  Photons of an area light, sorted into the cells of a grid over its four emission coordinates.
#pragma once

#include "nephroid/emission/emission_sample.hpp"
#include "nephroid/smoothing/second_order/cell_contents.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// A value for each emission coordinate of an area light.
using AreaSample = std::array<double, 4>;

[[nodiscard]] inline AreaSample area_sample(const EmissionSample& sample) {
    return {sample.at[0], sample.at[1], sample.then[0], sample.then[1]};
}

/// A grid over the unit hypercube of emission coordinates, and the photons in each cell.
class AreaCells {
public:
    static constexpr std::size_t photons_per_cell = 16;
    using CellCoordinates = std::array<std::size_t, 4>;

    /// @param samples  of the photons, in their order
    /// @param counts   cells along each axis, >= 1
    AreaCells(const std::vector<AreaSample>& samples, const CellCoordinates& counts)
        : counts_(counts), contents_(size(), samples.size(), [&](std::size_t i) { return cell_of(samples[i]); }) {}

    /// The number of cells along each axis, such that a cell holds about `photons_per_cell` photons. The numbers are in
    /// proportion to `need`, but at least 1: a small light needs few cells along its position.
    ///
    /// @param need  how much the tangents change along each axis, >= 0
    [[nodiscard]] static CellCoordinates counts_for(std::size_t photons, AreaSample need) {
        const double cells = (std::max)(1.0, double(photons) / double(photons_per_cell));
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        double largest = 0;
        for (const double n : need)
            largest = (std::max)(largest, n);
        for (double& n : need) // normalised, and bounded so that the product cannot underflow
            n = largest > 0 && std::isfinite(largest) ? (std::max)(n / largest, 1e-9) : 1;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return need[a] < need[b]; });
        CellCoordinates counts{1, 1, 1, 1};
        double product = need[0] * need[1] * need[2] * need[3];
        std::size_t first = 0; // axes before it get a single cell, and the others share the rest
        double scale = std::pow(cells / product, 0.25);
        while (first < 3 && need[order[first]] * scale < 1) {
            product /= need[order[first++]];
            scale = std::pow(cells / product, 1 / double(4 - first));
        }
        for (std::size_t i = first; i < 4; ++i)
            counts[order[i]] = (std::max)(std::size_t(1), std::size_t(std::lround(need[order[i]] * scale)));
        return counts;
    }

    [[nodiscard]] std::size_t size() const { return counts_[0] * counts_[1] * counts_[2] * counts_[3]; }
    [[nodiscard]] const CellCoordinates& counts() const { return counts_; }
    /// Whether an axis has at least three cells, so that one in the middle has neighbours on both sides.
    [[nodiscard]] bool is_fine(std::size_t axis) const { return counts_[axis] > 2; }
    [[nodiscard]] std::span<const std::uint32_t> photons(std::size_t cell) const { return contents_[cell]; }

    [[nodiscard]] std::size_t cell_of(const AreaSample& sample) const {
        CellCoordinates at;
        for (std::size_t axis = 0; axis < 4; ++axis)
            at[axis] = (std::min)(counts_[axis] - 1, std::size_t(sample[axis] * double(counts_[axis])));
        return cell_at(at);
    }
    [[nodiscard]] std::size_t cell_at(const CellCoordinates& at) const {
        return ((at[3] * counts_[2] + at[2]) * counts_[1] + at[1]) * counts_[0] + at[0];
    }
    [[nodiscard]] CellCoordinates coordinates_of(std::size_t cell) const {
        CellCoordinates at;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            at[axis] = cell % counts_[axis];
            cell /= counts_[axis];
        }
        return at;
    }

    /// From the middle of a cell to a sample, in cells.
    ///
    /// @param fine_only  whether axes with one or two cells count as 0
    [[nodiscard]] AreaSample from_middle(std::size_t cell, const AreaSample& sample, bool fine_only) const {
        const CellCoordinates here = coordinates_of(cell);
        AreaSample step{};
        for (std::size_t axis = 0; axis < 4; ++axis)
            if (!fine_only || is_fine(axis))
                step[axis] = sample[axis] * double(counts_[axis]) - (double(here[axis]) + 0.5);
        return step;
    }

    /// Calls visit(step, other) for a cell and all that touch it. A step is −1, 0 or 1 along each axis; `other` is
    /// `size()` where the step leaves the domain.
    template <class Visit>
    void for_each_around(std::size_t cell, Visit&& visit) const {
        const CellCoordinates here = coordinates_of(cell);
        for (std::size_t number = 0; number < 81; ++number) {
            std::array<int, 4> step;
            CellCoordinates other;
            bool is_inside = true;
            for (std::size_t axis = 0, rest = number; axis < 4; ++axis, rest /= 3) {
                step[axis] = int(rest % 3) - 1;
                other[axis] = here[axis] + rest % 3 - 1; // below 0 it wraps around to a huge number
                is_inside = is_inside && other[axis] < counts_[axis];
            }
            visit(step, is_inside ? cell_at(other) : size());
        }
    }

    /// Calls visit(cell, weight, slope) for the cells whose middles surround a sample. The weights interpolate
    /// multilinearly; a slope is the weight's gradient by the sample.
    template <class Visit>
    void for_each_node(const AreaSample& sample, Visit&& visit) const {
        std::array<std::array<std::size_t, 2>, 4> at;
        AreaSample fraction;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            const double last = double(counts_[axis]) - 1, position = sample[axis] * double(counts_[axis]) - 0.5;
            const double low = std::floor(position);
            at[axis] = {std::size_t(std::clamp(low, 0.0, last)), std::size_t(std::clamp(low + 1, 0.0, last))};
            fraction[axis] = position - low;
        }
        for (std::size_t corner = 0; corner < 16; ++corner) {
            CellCoordinates cell;
            double weight = 1;
            AreaSample slope{1, 1, 1, 1};
            bool is_new = true; // false for the second visit where both ends of an axis are the same cell
            for (std::size_t axis = 0; axis < 4; ++axis) {
                const bool up = corner >> axis & 1, is_flat = at[axis][0] == at[axis][1];
                is_new = is_new && !(up && is_flat);
                const double w = is_flat ? 1 : up ? fraction[axis] : 1 - fraction[axis];
                const double change = is_flat ? 0 : up ? double(counts_[axis]) : -double(counts_[axis]);
                weight *= w;
                for (std::size_t by = 0; by < 4; ++by)
                    slope[by] *= by == axis ? change : w;
                cell[axis] = at[axis][up];
            }
            if (is_new)
                visit(cell_at(cell), weight, slope);
        }
    }

private:
    CellCoordinates counts_;
    CellContents contents_; // declared last: its constructor uses counts_
};

} // namespace nephroid::detail
