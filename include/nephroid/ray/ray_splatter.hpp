// SPDX-License-Identifier: MIT
/// @file  Makes splats of flights in chunks, and adds batches of chunks to sums.
#pragma once

#include "nephroid/ray/add_ray.hpp"
#include "nephroid/ray/ray_reach.hpp"
#include "nephroid/ray/short_rays.hpp"
#include "nephroid/splat/splat_bins.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Splats flights according to policies and adds them to sums.
///
/// @tparam S  the scene, which short rays ask
template <class S, class V, class F, class R, class Policies>
class RaySplatter {
public:
    using Chunk = ChunkOf<RaySplat<V, F>>;

    /// @param scene, sums  kept by reference; must outlive the splatter
    RaySplatter(const S& scene, Sums<V, F, R>& sums, const Policies& policies)
        : scene_(&scene), sums_(&sums), policies_(policies), bins_(sums.map().tree().leaves().size()),
          rejected_(sums.map().tree().leaves().size()) {}

    [[nodiscard]] const EyePathMap<V>& map() const { return sums_->map(); }

    /// Makes a splat of a flight and books its flux in the account under its fate. May be called from several threads,
    /// each with a chunk of its own.
    ///
    /// @param takes  takes(leaf) returns whether a leaf of the map's tree is to receive light
    template <std::size_t N, class Takes = EveryLeaf>
    void prepare(const Flight<V, F, N>& flight, Chunk& chunk, Statistics& account, const Takes& takes = {}) const {
        const auto outcome = make_ray_splat(flight, map(), policies_);
        account.bounded_footprints += outcome.bounded;
        const Fate fate = outcome.splat && !chunk.add(map(), *outcome.splat, takes) ? Fate::unseen : outcome.fate;
        const double power = double(flux_traits<F>::power(flight.flux));
        account.end(fate, isfinite(power) ? power : 0);
    }

    /// Adds the splats of consecutive chunks to the sums, in order.
    template <class E>
    void add(std::span<const Chunk> chunks, E& executor) {
        bins_.for_each(chunks, executor, [&](const Binned<RaySplat<V, F>>& binned) {
            std::array<scalar_t<V>, PointTree<V>::leaf_size> weight;
            ray_weights(*binned.splat, binned.meeting.checks_height, binned.leaf, map(), policies_, weight);
            if constexpr (!std::same_as<std::remove_cvref_t<decltype(policies_.visibility)>, NoShortRays>)
                rejected_[binned.leaf] +=
                    keep_visible(*scene_, *binned.splat, binned.leaf, map(), policies_.visibility, weight);
            add_weights(*binned.splat, weight, binned.leaf, *sums_);
        });
    }

    /// How many vertices short rays kept from receiving.
    [[nodiscard]] std::uint64_t rejected() const {
        std::uint64_t sum = 0;
        for (const std::uint64_t of_leaf : rejected_)
            sum += of_leaf;
        return sum;
    }

private:
    const S* scene_;
    Sums<V, F, R>* sums_;
    Policies policies_;
    BinsOf<RaySplat<V, F>> bins_;
    std::vector<std::uint64_t> rejected_;
};

} // namespace nephroid::detail
