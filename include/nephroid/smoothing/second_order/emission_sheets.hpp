// SPDX-License-Identifier: MIT
/// @file  The photons of a light by the paths they took: those that took the same one lie on one sheet of the caustic.
///
/// Two sheets may lie side by side in the emission domain: then there is a border between them, and each has all the
/// photons on its side of it. Or a surface sends photons one way or another by chance (glass that reflects some of
/// them): then they lie over each other, each has its share of the photons, and there is no border. Neighbours tell
/// which: beside a border a photon's neighbours took the path that it took itself, but amid others they did not.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/smoothing/second_order/emission_cells.hpp"

#include <array>
#include <limits>

namespace nephroid::detail {

/// The photons of a light that took one path.
struct EmissionSheet {
    std::uint32_t signature;
    double share; ///< of the photons where the sheet lies: 1, unless chance sent some of them elsewhere
    std::vector<std::uint32_t> photons; ///< indices
};

/// The sheets over the emission domain of one light.
class EmissionSheets {
public:
    /// @param repeats  whether opposite borders of the domain are neighbours
    /// @param run      the result does not depend on it
    EmissionSheets(const PathSamples& photons, bool repeats, const TaskRunner& run)
        : aspect_(aspect_of(photons)), next_to_border_(photons.size()) {
        const EmissionCells cells(photons.places(photons.size()), aspect_, repeats);
        const std::vector<std::uint32_t> kinds = sort_by_path(photons);

        const auto for_each_cell = [&](const auto& work) { for_each_index(run, cells.size(), 64, work); };
        std::vector<Neighbours> neighbours(photons.size());
        std::vector<float> shares(photons.size(), 1);
        for_each_cell([&](std::size_t cell) { find_neighbours(cells, cell, photons, kinds, neighbours); });
        for_each_cell([&](std::size_t cell) { look_around(cells, cell, kinds, neighbours, shares); });
        for (EmissionSheet& sheet : sheets_) {
            std::vector<float> of_sheet;
            of_sheet.reserve(sheet.photons.size());
            for (const std::uint32_t i : sheet.photons)
                of_sheet.push_back(shares[i]);
            const auto middle = of_sheet.begin() + std::ptrdiff_t(of_sheet.size() / 2);
            std::nth_element(of_sheet.begin(), middle, of_sheet.end());
            sheet.share = double(*middle); // the median: cells at borders are few
        }
    }

    /// Sorted by signature.
    [[nodiscard]] std::span<const EmissionSheet> sheets() const { return sheets_; }
    /// How much longer the domain is along the first sample than along the second.
    [[nodiscard]] double aspect() const { return aspect_; }
    /// Whether the sheet that a photon lies on ends within the photon's cell.
    [[nodiscard]] bool is_next_to_border(std::size_t photon) const { return next_to_border_[photon] != 0; }

private:
    struct Neighbours {
        std::array<std::uint32_t, 3> photons{};
        std::uint32_t count = 0;
    };

    static constexpr std::uint32_t lost = (std::numeric_limits<std::uint32_t>::max)();

    [[nodiscard]] static double aspect_of(const PathSamples& photons) {
        const EmissionCells coarse(photons.places((std::min)(photons.size(), std::size_t(4096))), 1, false);
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t cell = 0; cell < coarse.size(); ++cell) {
            const auto inside = coarse.photons(cell);
            if (inside.empty() || !photons[inside.front()].frame.is_regular())
                continue;
            const PathSample& origin = photons[inside.front()];
            SampleMetric metric;
            for (const std::uint32_t i : inside)
                metric.add(coarse.step_between(origin.sample.at, photons[i].sample.at),
                           origin.frame.to(photons[i].frame));
            if (const auto m = metric.solve()) {
                sum += 0.5 * std::log(inner(m->first, m->first) / inner(m->second, m->second));
                ++count;
            }
        }
        return count > 0 && std::isfinite(sum) ? std::clamp(std::exp(sum / double(count)), 1e-3, 1e3) : 1;
    }

    /// Makes the sheets; returns which of them each photon lies on, or `lost`.
    [[nodiscard]] std::vector<std::uint32_t> sort_by_path(const PathSamples& photons) {
        std::vector<std::uint32_t> signatures;
        for (std::size_t i = 0; i < photons.size(); ++i)
            if (photons[i].has_landed)
                signatures.push_back(photons[i].signature);
        std::sort(signatures.begin(), signatures.end());
        signatures.erase(std::unique(signatures.begin(), signatures.end()), signatures.end());
        sheets_.reserve(signatures.size());
        for (const std::uint32_t signature : signatures)
            sheets_.push_back({signature, 1, {}});

        std::vector<std::uint32_t> kinds(photons.size(), lost);
        for (std::size_t i = 0; i < photons.size(); ++i) {
            if (!photons[i].has_landed)
                continue;
            const auto found = std::lower_bound(signatures.begin(), signatures.end(), photons[i].signature);
            kinds[i] = std::uint32_t(found - signatures.begin());
            sheets_[kinds[i]].photons.push_back(std::uint32_t(i));
        }
        return kinds;
    }

    /// The photons of a cell and of those around it; none where all of them took one path.
    [[nodiscard]] static std::vector<std::uint32_t> mixed_photons_about(const EmissionCells& cells, std::size_t cell,
                                                                        std::span<const std::uint32_t> kinds) {
        std::vector<std::uint32_t> around;
        if (cells.photons(cell).empty())
            return around;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto other = cells.neighbour(cell, dx, dy))
                    around.insert(around.end(), cells.photons(*other).begin(), cells.photons(*other).end());
        if (std::all_of(around.begin(), around.end(), [&](auto i) { return kinds[i] == kinds[around.front()]; }))
            around.clear();
        return around;
    }

    /// The three photons nearest to each in a cell; none where all around took one path.
    static void find_neighbours(const EmissionCells& cells, std::size_t cell, const PathSamples& photons,
                                std::span<const std::uint32_t> kinds, std::span<Neighbours> neighbours) {
        const auto around = mixed_photons_about(cells, cell, kinds);
        if (around.empty())
            return;
        for (const std::uint32_t photon : cells.photons(cell)) {
            constexpr double endless = std::numeric_limits<double>::infinity();
            std::array<double, 3> distances{endless, endless, endless};
            Neighbours& nearest = neighbours[photon];
            for (const std::uint32_t i : around) {
                const Plane2 step = cells.step_between(photons[photon].sample.at, photons[i].sample.at);
                const Plane2 in_cells{step.x * double(cells.columns()), step.y * double(cells.rows())};
                const double distance = inner(in_cells, in_cells);
                if (i == photon || !(distance < distances[2]))
                    continue;
                std::size_t at = 2;
                for (; at > 0 && distance < distances[at - 1]; --at) {
                    distances[at] = distances[at - 1];
                    nearest.photons[at] = nearest.photons[at - 1];
                }
                distances[at] = distance;
                nearest.photons[at] = i;
                nearest.count = (std::min)(nearest.count + 1, 3u);
            }
        }
    }

    /// Notes for each photon in a cell how many of those about it lie on its sheet, and whether the sheet ends here.
    void look_around(const EmissionCells& cells, std::size_t cell, std::span<const std::uint32_t> kinds,
                     std::span<const Neighbours> neighbours, std::span<float> shares) {
        const auto around = mixed_photons_about(cells, cell, kinds);
        if (around.empty())
            return;
        const auto inside = cells.photons(cell);
        const auto all = double(around.size());
        std::vector<std::uint32_t> looked_at;
        for (const std::uint32_t i : inside) {
            const std::uint32_t kind = kinds[i];
            if (kind == lost || std::find(looked_at.begin(), looked_at.end(), kind) != looked_at.end())
                continue;
            looked_at.push_back(kind);
            const auto is_on = [&](std::uint32_t photon) { return kinds[photon] == kind; };
            const auto on = double(std::count_if(around.begin(), around.end(), is_on));
            // Neighbours that took different paths: so many there are, and so many there would be by chance.
            double unlike = 0;
            for (const std::uint32_t photon : around)
                for (std::uint32_t k = 0; k < neighbours[photon].count; ++k)
                    unlike += is_on(neighbours[photon].photons[k]) != is_on(photon);
            const double by_chance = 3 * 2 * on * (all - on) / (all - 1);
            // One stray photon is no border: it makes six of them.
            const bool is_parted = by_chance > 6.5 && unlike < 0.5 * by_chance;
            const bool is_mixed = !std::all_of(inside.begin(), inside.end(), is_on);
            for (const std::uint32_t photon : inside)
                if (is_on(photon)) {
                    shares[photon] = is_parted ? 1.0f : float(on / all);
                    next_to_border_[photon] = is_parted && is_mixed;
                }
        }
    }

    double aspect_;
    std::vector<EmissionSheet> sheets_;
    std::vector<std::uint8_t> next_to_border_; // not bits: threads write side by side
};

} // namespace nephroid::detail
