// SPDX-License-Identifier: MIT
/// @file  The photons of a light, grouped by the path that they took. Each group samples one smooth piece of the map.
///
/// Two groups may lie side by side in the emission domain. Then there is a border between them, and each has all the
/// photons on its side. Or a surface sends photons one way or another by chance, as glass does that reflects some of
/// them. Then the groups overlap, each has a share of the photons, and there is no border. A photon's nearest
/// neighbours show which case it is: beside a border they took the same path as the photon, in an overlap often another
/// one.
#pragma once

#include "nephroid/execution/task_runner.hpp"
#include "nephroid/smoothing/second_order/emission_cells.hpp"

#include <array>
#include <limits>

namespace nephroid::detail {

/// The photons of a light that took one path.
struct PathGroup {
    std::uint32_t signature; ///< of the path
    double share; ///< of all photons emitted where the group lies: 1, unless chance sent some of them elsewhere
    std::vector<std::uint32_t> photons; ///< indices
};

/// The path groups of one light.
class PathGroups {
public:
    /// @param repeats  whether opposite borders of the domain are neighbours
    /// @param run      runs tasks; the result does not depend on it
    PathGroups(const PathSamples& photons, bool repeats, const TaskRunner& run)
        : aspect_(aspect_of(photons)), next_to_border_(photons.size()) {
        const EmissionCells cells(photons.coordinates(photons.size()), aspect_, repeats);
        const std::vector<std::uint32_t> group_of = sort_by_path(photons);

        const auto for_each_cell = [&](const auto& work) { for_each_index(run, cells.size(), 64, work); };
        std::vector<Neighbours> neighbours(photons.size());
        std::vector<float> shares(photons.size(), 1);
        for_each_cell([&](std::size_t cell) { find_neighbours(cells, cell, photons, group_of, neighbours); });
        for_each_cell([&](std::size_t cell) { measure_shares(cells, cell, group_of, neighbours, shares); });
        for (PathGroup& group : groups_) {
            std::vector<float> of_group;
            of_group.reserve(group.photons.size());
            for (const std::uint32_t i : group.photons)
                of_group.push_back(shares[i]);
            const auto middle = of_group.begin() + std::ptrdiff_t(of_group.size() / 2);
            std::nth_element(of_group.begin(), middle, of_group.end());
            group.share = double(*middle); // the median: cells at borders are few
        }
    }

    /// Sorted by signature.
    [[nodiscard]] const std::vector<PathGroup>& groups() const { return groups_; }
    /// The length of the domain along the first coordinate over that along the second.
    [[nodiscard]] double aspect() const { return aspect_; }
    /// Whether the border of a photon's group lies within the photon's cell.
    [[nodiscard]] bool is_next_to_border(std::size_t photon) const { return next_to_border_[photon] != 0; }

private:
    struct Neighbours {
        std::array<std::uint32_t, 3> photons{};
        std::uint32_t count = 0;
    };

    static constexpr std::uint32_t no_group = (std::numeric_limits<std::uint32_t>::max)();

    [[nodiscard]] static double aspect_of(const PathSamples& photons) {
        const EmissionCells coarse(photons.coordinates((std::min)(photons.size(), std::size_t(4096))), 1, false);
        double sum = 0;
        std::size_t count = 0;
        for (std::size_t cell = 0; cell < coarse.size(); ++cell) {
            const auto inside = coarse.photons(cell);
            if (inside.empty() || !photons[inside.front()].frame.is_regular())
                continue;
            const PathSample& origin = photons[inside.front()];
            StepFit fit;
            for (const std::uint32_t i : inside)
                fit.add(coarse.step_between(origin.sample.at, photons[i].sample.at),
                        origin.frame.displacement_to(photons[i].frame));
            if (const auto m = fit.solve()) {
                sum += 0.5 * std::log(inner(m->first, m->first) / inner(m->second, m->second));
                ++count;
            }
        }
        return count > 0 && std::isfinite(sum) ? std::clamp(std::exp(sum / double(count)), 1e-3, 1e3) : 1;
    }

    /// Makes the groups. Returns the group of each photon, or `no_group`.
    [[nodiscard]] std::vector<std::uint32_t> sort_by_path(const PathSamples& photons) {
        std::vector<std::uint32_t> signatures;
        for (std::size_t i = 0; i < photons.size(); ++i)
            if (photons[i].has_landed)
                signatures.push_back(photons[i].signature);
        std::sort(signatures.begin(), signatures.end());
        signatures.erase(std::unique(signatures.begin(), signatures.end()), signatures.end());
        groups_.reserve(signatures.size());
        for (const std::uint32_t signature : signatures)
            groups_.push_back({signature, 1, {}});

        std::vector<std::uint32_t> group_of(photons.size(), no_group);
        for (std::size_t i = 0; i < photons.size(); ++i) {
            if (!photons[i].has_landed)
                continue;
            const auto found = std::lower_bound(signatures.begin(), signatures.end(), photons[i].signature);
            group_of[i] = std::uint32_t(found - signatures.begin());
            groups_[group_of[i]].photons.push_back(std::uint32_t(i));
        }
        return group_of;
    }

    /// The photons of a cell and of the cells around it; none if all of them took the same path.
    [[nodiscard]] static std::vector<std::uint32_t>
    photons_around_if_mixed(const EmissionCells& cells, std::size_t cell, const std::vector<std::uint32_t>& group_of) {
        std::vector<std::uint32_t> around;
        if (cells.photons(cell).empty())
            return around;
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (const auto other = cells.neighbour(cell, dx, dy))
                    around.insert(around.end(), cells.photons(*other).begin(), cells.photons(*other).end());
        if (std::all_of(around.begin(), around.end(), [&](auto i) { return group_of[i] == group_of[around.front()]; }))
            around.clear();
        return around;
    }

    /// Finds the three nearest neighbours of each photon in a cell; none where all photons around took the same path.
    static void find_neighbours(const EmissionCells& cells, std::size_t cell, const PathSamples& photons,
                                const std::vector<std::uint32_t>& group_of, std::vector<Neighbours>& neighbours) {
        const auto around = photons_around_if_mixed(cells, cell, group_of);
        if (around.empty())
            return;
        for (const std::uint32_t photon : cells.photons(cell)) {
            constexpr double infinity = std::numeric_limits<double>::infinity();
            std::array<double, 3> distances{infinity, infinity, infinity};
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

    /// Sets, for each photon in a cell, its group's share of the photons around, and whether the group ends here.
    void measure_shares(const EmissionCells& cells, std::size_t cell, const std::vector<std::uint32_t>& group_of,
                        const std::vector<Neighbours>& neighbours, std::vector<float>& shares) {
        const auto around = photons_around_if_mixed(cells, cell, group_of);
        if (around.empty())
            return;
        const auto inside = cells.photons(cell);
        const auto all = double(around.size());
        std::vector<std::uint32_t> done;
        for (const std::uint32_t i : inside) {
            const std::uint32_t group = group_of[i];
            if (group == no_group || std::find(done.begin(), done.end(), group) != done.end())
                continue;
            done.push_back(group);
            const auto is_in_group = [&](std::uint32_t photon) { return group_of[photon] == group; };
            const auto members = double(std::count_if(around.begin(), around.end(), is_in_group));
            // Pairs of neighbours with one photon in the group: as found, and as expected if chance chose each path.
            double mixed_pairs = 0;
            for (const std::uint32_t photon : around)
                for (std::uint32_t k = 0; k < neighbours[photon].count; ++k)
                    mixed_pairs += is_in_group(neighbours[photon].photons[k]) != is_in_group(photon);
            const double expected_pairs = 3 * 2 * members * (all - members) / (all - 1);
            // A single stray photon makes six pairs, and is no border.
            const bool is_separated = expected_pairs > 6.5 && mixed_pairs < 0.5 * expected_pairs;
            const bool is_mixed = !std::all_of(inside.begin(), inside.end(), is_in_group);
            for (const std::uint32_t photon : inside)
                if (is_in_group(photon)) {
                    shares[photon] = is_separated ? 1.0f : float(members / all);
                    next_to_border_[photon] = is_separated && is_mixed;
                }
        }
    }

    double aspect_;
    std::vector<PathGroup> groups_;
    std::vector<std::uint8_t> next_to_border_; // bytes, because threads write neighbouring elements at once
};

} // namespace nephroid::detail
