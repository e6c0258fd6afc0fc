// SPDX-License-Identifier: MIT
/// @file  Chooses the radius of all disks of a pass, by cross-validation over the quarters of its first photons.
///
/// The error at one radius, but for a constant, is that of smoothing/cross_validation.hpp: ΣW² − A B₀ − B A₀.
/// Behind a diffuse bounce even photons of a stratified sequence are random, so that the halves A and B are
/// independent.
#pragma once

#include "nephroid/bounce/covered_disks.hpp"
#include "nephroid/smoothing/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::detail {

/// Deposits, and which quarter of the photons left each.
template <class V, class F>
struct QuarteredDeposits {
    std::vector<Deposit<V, F, 0>> deposits;
    std::vector<std::uint8_t> quarter; ///< 0 to 3
};

/// Estimates from quarters of stored deposits, as disks of several radii at once.
template <class V, class F>
class QuarterDisks {
public:
    using T = scalar_t<V>;

    QuarterDisks(const FreeDistances<V>& distances, const QuarteredDeposits<V, F>& stored)
        : distances_(distances), stored_(stored),
          tree_(stored.deposits.size(), [&](std::size_t i) { return stored.deposits[i].position; }) {
        std::vector<std::uint32_t> all;
        for (const TreeLeaf& leaf : vertices().leaves())
            for (std::size_t i = 0; i < leaf.size; ++i)
                all.push_back(std::uint32_t(leaf.first + i));
        const std::size_t count = (std::min)(all.size(), most_vertices);
        for (std::size_t i = 0; i < count; ++i)
            slots_.push_back(all[i * all.size() / count]);
    }

    /// The pictures at some of the vertices, for each radius.
    ///
    /// @param radii  world units, rising
    template <class E>
    [[nodiscard]] std::vector<QuarterPictures> estimates(const std::vector<double>& radii, E& executor) const {
        std::vector<QuarterPictures> pictures(radii.size());
        for (QuarterPictures& picture : pictures)
            for (std::vector<double>& quarter : picture)
                quarter.assign(slots_.size(), 0);
        for_each_index(executor, slots_.size(), 32, [&](std::size_t i) { estimate_at(i, radii, pictures); });
        return pictures;
    }

    /// The radius of a sphere about a vertex with so many deposits in it: the median of some vertices.
    [[nodiscard]] double radius_with(std::size_t photons) const {
        std::vector<Neighbour<T>> nearest(photons);
        std::vector<double> radii;
        for (std::size_t i = 0; i < slots_.size(); i += 4) {
            const std::size_t found = tree_.nearest(tree_.relative(vertex(slots_[i])), nearest);
            T furthest2(0);
            for (std::size_t j = 0; j < found; ++j)
                furthest2 = (std::max)(furthest2, nearest[j].distance2);
            radii.push_back(std::sqrt(double(furthest2)));
        }
        const auto middle = radii.begin() + std::ptrdiff_t(radii.size() / 2);
        std::nth_element(radii.begin(), middle, radii.end());
        return *middle;
    }

private:
    static constexpr std::size_t most_vertices = 2048;

    [[nodiscard]] const PointTree<V>& vertices() const { return distances_.map().tree(); }
    [[nodiscard]] V vertex(std::size_t slot) const {
        return vertices().origin() + make_vector<V>(vertices().x()[slot], vertices().y()[slot], vertices().z()[slot]);
    }

    /// Adds the deposits about one vertex to its place in all pictures, as DiskPolicies::add does.
    void estimate_at(std::size_t place, const std::vector<double>& radii,
                     std::vector<QuarterPictures>& pictures) const {
        using t = vector_traits<V>;
        const std::size_t slot = slots_[place];
        const EyePathMap<V>& map = distances_.map();
        const V position = vertex(slot), relative = tree_.relative(position);
        const V normal = make_vector<V>(map.normal_x()[slot], map.normal_y()[slot], map.normal_z()[slot]);
        const double normal_distance = disks_of(1, distances_).normal_distance;
        const double spacing = double(map.spacing_at(position)), furthest = radii.back();
        const T reach = T(furthest), x = t::x(relative), y = t::y(relative), z = t::z(relative);
        tree_.visit_leaves(Box<T>{{x - reach, y - reach, z - reach}, {x + reach, y + reach, z + reach}},
                           [&](std::uint32_t number) {
                               const TreeLeaf leaf = tree_.leaves()[number];
                               for (std::size_t i = leaf.first; i < leaf.first + leaf.size; ++i) {
                                   const V from = make_vector<V>(tree_.x()[i] - x, tree_.y()[i] - y, tree_.z()[i] - z);
                                   const double distance2 = double(length2(from));
                                   if (!(distance2 < furthest * furthest))
                                       continue;
                                   const Deposit<V, F, 0>& deposit = stored_.deposits[tree_.index(i)];
                                   if (!(dot(deposit.normal, normal) > T(one_surface_cosine)))
                                       continue;
                                   if (!distances_.reaches(slot, from))
                                       continue;
                                   const double height = std::abs(double(dot(from, deposit.normal)));
                                   const double power = double(flux_traits<F>::power(deposit.flux));
                                   for (std::size_t r = radii.size(); r-- > 0 && distance2 < square(radii[r]);)
                                       if (height < (std::max)(normal_distance * radii[r], spacing))
                                           pictures[r][stored_.quarter[tree_.index(i)]][place] +=
                                               power * BiweightKernel{}(distance2 / square(radii[r]));
                               }
                           });
        std::uint64_t bounded = 0;
        for (std::size_t r = 0; r < radii.size(); ++r)
            for (std::vector<double>& quarter : pictures[r])
                quarter[place] /= square(radii[r]) * double(bounded_coverage(distances_, slot, T(radii[r]), bounded));
    }

    const FreeDistances<V>& distances_;
    const QuarteredDeposits<V, F>& stored_;
    PointTree<V> tree_;                ///< of the deposits
    std::vector<std::uint32_t> slots_; ///< of the vertices that are looked at
};

inline constexpr std::size_t fewest_deposits_to_choose_by = 64;

/// The radius for a pass of disks.
///
/// @param stored   what its first photons left
/// @param photons  how many these were
/// @param all      how many the picture has: with more photons disks shrink as n^(−1/5), which balances noise and the
///                 bias along edges
/// @return  at most the distances' reach, and above 0 unless the map is empty; that reach itself if there is next to
///          no light to judge by
template <class V, class F, class E>
[[nodiscard]] double validated_radius(const FreeDistances<V>& distances, const QuarteredDeposits<V, F>& stored,
                                      std::uint64_t photons, std::uint64_t all, E& executor) {
    constexpr std::size_t in_smallest = 64, most_steps = 8; // 8,192 deposits in the largest disk
    const double reach = double(distances.reach());
    if (stored.deposits.size() < fewest_deposits_to_choose_by || distances.map().tree().empty())
        return reach;
    announce(executor, Phase::fit);
    const QuarterDisks disks(distances, stored);
    std::vector<double> radii{std::clamp(disks.radius_with(in_smallest), reach / 65536, reach / 2)};
    while (radii.back() < reach && radii.size() < most_steps)
        radii.push_back((std::min)(reach, radii.front() * std::exp2(0.5 * double(radii.size()))));
    const std::vector<QuarterPictures> pictures = disks.estimates(radii, executor);
    const std::optional<double> best =
        best_step([&](std::size_t step) { return validated_error(pictures[step], pictures[0], 1); }, radii.size());
    if (!best)
        return reach;
    const double radius = (std::min)(reach, radii.front() * std::exp2(0.5 * *best));
    return radius * std::pow(double(photons) / double(all), 0.2);
}

} // namespace nephroid::detail
