// SPDX-License-Identifier: MIT
/// @file  The photons of an area light: which of them took the same path, and along which emission coordinates their
///        tangents change.
#pragma once

#include "nephroid/smoothing/second_order/area_cells.hpp"
#include "nephroid/smoothing/second_order/area_fit.hpp"
#include "nephroid/smoothing/second_order/emission_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Photons of one area light, with the four emission coordinates of each.
class AreaPhotons {
public:
    explicit AreaPhotons(const PathSamples& photons) : photons_(photons), samples_(photons.size()) {
        for (std::size_t i = 0; i < samples_.size(); ++i)
            samples_[i] = area_sample(photons_[i].sample);
    }

    [[nodiscard]] std::size_t size() const { return samples_.size(); }
    [[nodiscard]] const PathSample& operator[](std::size_t i) const { return photons_[i]; }
    [[nodiscard]] const std::vector<AreaSample>& samples() const { return samples_; }

    /// Whether a photon landed at the end of the path with a signature.
    [[nodiscard]] bool is_on(std::size_t i, std::uint32_t signature) const {
        return photons_[i].has_landed && photons_[i].signature == signature;
    }
    /// Whether its tangents are usable in a fit as well: one photon with invalid tangents must not spoil its
    /// neighbours.
    [[nodiscard]] bool is_usable_on(std::size_t i, std::uint32_t signature) const {
        return is_on(i, signature) && is_usable(photons_[i]);
    }

    /// The path that most of some photons took; nothing if none of them is usable.
    [[nodiscard]] std::optional<std::uint32_t> commonest_path(std::span<const std::uint32_t> among) const {
        std::size_t most = 0;
        std::uint32_t signature = 0;
        for (const std::uint32_t i : among) {
            if (!is_usable(photons_[i]))
                continue;
            const std::uint32_t candidate = photons_[i].signature;
            const auto same = std::size_t(
                std::count_if(among.begin(), among.end(), [&](std::uint32_t j) { return is_on(j, candidate); }));
            if (same > most || (same == most && candidate < signature)) {
                most = same;
                signature = candidate;
            }
        }
        return most > 0 ? std::optional(signature) : std::nullopt;
    }

    /// How many cells to make along each axis: in proportion to how much the tangents change along it, measured on a
    /// coarse grid.
    [[nodiscard]] AreaCells::CellCoordinates cell_counts() const {
        const AreaCells coarse(samples_, AreaCells::counts_for(size(), {1, 1, 1, 1}));
        constexpr double least = 1e-3; // relative change over the domain; less than this counts as none
        AreaSample need{};
        double measured = 0;
        for (std::size_t cell = 0; cell < coarse.size(); ++cell) {
            const auto change = relative_change(coarse, cell);
            if (!change)
                continue;
            for (std::size_t axis = 0; axis < 4; ++axis)
                need[axis] += double(coarse.counts()[axis]) * (*change)[axis];
            ++measured;
        }
        for (double& n : need)
            n = (std::max)(n, least * measured);
        return AreaCells::counts_for(size(), need);
    }

private:
    [[nodiscard]] static bool is_usable(const PathSample& photon) {
        const auto& t = photon.tangents;
        return photon.has_landed && photon.frame.is_of_area() && std::isfinite(inner(t[0], t[0]) + inner(t[1], t[1]));
    }

    /// How much the tangents change across a cell along each axis, over their own length; nothing if the cell has too
    /// few photons.
    [[nodiscard]] std::optional<AreaSample> relative_change(const AreaCells& cells, std::size_t cell) const {
        const auto signature = commonest_path(cells.photons(cell));
        if (!signature)
            return std::nullopt;
        LeastSquares<5, TangentPair> slopes;
        std::size_t count = 0;
        const EmissionFrame* frame = nullptr;
        for (const std::uint32_t i : cells.photons(cell)) {
            if (!is_usable_on(i, *signature))
                continue;
            const PathSample& photon = photons_[i];
            if (frame == nullptr)
                frame = &photon.frame;
            const AreaSample at = cells.from_middle(cell, samples_[i], false);
            slopes.add({1, at[0], at[1], at[2], at[3]}, rotated(photon.tangents, frame->rotation_of(photon.frame)), 1);
            ++count;
        }
        std::array<TangentPair, 5> x;
        if (count < 8 || !slopes.solve(5, x) || !(norm2(x[0]) > 0))
            return std::nullopt;
        AreaSample change;
        for (std::size_t axis = 0; axis < 4; ++axis)
            change[axis] = std::sqrt(norm2(x[axis + 1]) / norm2(x[0]));
        return change;
    }

    PathSamples photons_;
    std::vector<AreaSample> samples_;
};

} // namespace nephroid::detail
