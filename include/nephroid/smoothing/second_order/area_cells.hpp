// SPDX-License-Identifier: MIT
/// @file  Photons of an area light sorted into cells of the four numbers that each was drawn from.
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

/// One number for each that an area light draws, or is split along.
using AreaSample = std::array<double, 4>;

[[nodiscard]] inline AreaSample area_sample(const EmissionSample& sample) {
    return {sample.at[0], sample.at[1], sample.then[0], sample.then[1]};
}

/// A grid over the hypercube of samples, and the photons in each cell.
class AreaCells {
public:
    static constexpr std::size_t photons_per_cell = 16;
    using Place = std::array<std::size_t, 4>;

    /// @param samples  in the order of the photons
    /// @param counts   cells along each number, >= 1
    AreaCells(std::span<const AreaSample> samples, const Place& counts)
        : counts_(counts), contents_(size(), samples.size(), [&](std::size_t i) { return cell_of(samples[i]); }) {}

    /// So many cells along each number that each holds about `photons_per_cell` photons, in proportion to `need` where
    /// that makes one at least: a small light needs hardly any cells along its place.
    ///
    /// @param need  >= 0: how much what matters changes along each number
    [[nodiscard]] static Place counts_for(std::size_t photons, AreaSample need) {
        const double cells = (std::max)(1.0, double(photons) / double(photons_per_cell));
        std::array<std::size_t, 4> order{0, 1, 2, 3};
        double largest = 0;
        for (const double n : need)
            largest = (std::max)(largest, n);
        for (double& n : need) // in proportion, and far from where products vanish
            n = largest > 0 && std::isfinite(largest) ? (std::max)(n / largest, 1e-9) : 1;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return need[a] < need[b]; });
        Place counts{1, 1, 1, 1};
        double product = need[0] * need[1] * need[2] * need[3];
        std::size_t first = 0; // those before it do not deserve a second cell, and leave theirs to the others
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
    [[nodiscard]] const Place& counts() const { return counts_; }
    /// Whether there are so many cells along a number that one in the middle has others around it.
    [[nodiscard]] bool is_fine(std::size_t axis) const { return counts_[axis] > 2; }
    [[nodiscard]] std::span<const std::uint32_t> photons(std::size_t cell) const { return contents_[cell]; }

    [[nodiscard]] std::size_t cell_of(const AreaSample& sample) const {
        Place place;
        for (std::size_t axis = 0; axis < 4; ++axis)
            place[axis] = (std::min)(counts_[axis] - 1, std::size_t(sample[axis] * double(counts_[axis])));
        return cell_at(place);
    }
    [[nodiscard]] std::size_t cell_at(const Place& place) const {
        return ((place[3] * counts_[2] + place[2]) * counts_[1] + place[1]) * counts_[0] + place[0];
    }
    [[nodiscard]] Place place_of(std::size_t cell) const {
        Place place;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            place[axis] = cell % counts_[axis];
            cell /= counts_[axis];
        }
        return place;
    }

    /// From the middle of a cell to a sample, in cells. 0 along numbers that are split in two at most, if so asked.
    [[nodiscard]] AreaSample from_middle(std::size_t cell, const AreaSample& sample, bool fine_only) const {
        const Place place = place_of(cell);
        AreaSample step{};
        for (std::size_t axis = 0; axis < 4; ++axis)
            if (!fine_only || is_fine(axis))
                step[axis] = sample[axis] * double(counts_[axis]) - (double(place[axis]) + 0.5);
        return step;
    }

    /// Calls visit(step, cell) for a cell and those that touch it: steps of −1 to 1 along each number, and `size()`
    /// for a cell beyond the domain.
    template <class Visit>
    void for_each_around(std::size_t cell, Visit&& visit) const {
        const Place place = place_of(cell);
        for (std::size_t number = 0; number < 81; ++number) {
            std::array<int, 4> step;
            Place other;
            bool is_inside = true;
            for (std::size_t axis = 0, rest = number; axis < 4; ++axis, rest /= 3) {
                step[axis] = int(rest % 3) - 1;
                other[axis] = place[axis] + rest % 3 - 1; // wraps below 0, to far beyond
                is_inside = is_inside && other[axis] < counts_[axis];
            }
            visit(step, is_inside ? cell_at(other) : size());
        }
    }

    /// Calls visit(cell, weight, slope) for the cells whose middles are about a sample: weights are multilinear, slopes
    /// those of the weight by each number.
    template <class Visit>
    void for_each_node(const AreaSample& sample, Visit&& visit) const {
        std::array<std::array<std::size_t, 2>, 4> at;
        AreaSample share;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            const double last = double(counts_[axis]) - 1, place = sample[axis] * double(counts_[axis]) - 0.5;
            const double low = std::floor(place);
            at[axis] = {std::size_t(std::clamp(low, 0.0, last)), std::size_t(std::clamp(low + 1, 0.0, last))};
            share[axis] = place - low;
        }
        for (std::size_t corner = 0; corner < 16; ++corner) {
            Place place;
            double weight = 1;
            AreaSample slope{1, 1, 1, 1};
            bool is_met = true; // once, where both ends of an axis are the same cell
            for (std::size_t axis = 0; axis < 4; ++axis) {
                const bool up = corner >> axis & 1, is_flat = at[axis][0] == at[axis][1];
                is_met = is_met && !(up && is_flat);
                const double w = is_flat ? 1 : up ? share[axis] : 1 - share[axis];
                const double change = is_flat ? 0 : up ? double(counts_[axis]) : -double(counts_[axis]);
                weight *= w;
                for (std::size_t by = 0; by < 4; ++by)
                    slope[by] *= by == axis ? change : w;
                place[axis] = at[axis][up];
            }
            if (is_met)
                visit(cell_at(place), weight, slope);
        }
    }

private:
    Place counts_;
    CellContents contents_; // last: made by what is above
};

} // namespace nephroid::detail
