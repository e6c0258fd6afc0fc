// SPDX-License-Identifier: MIT
/// @file  From deposits to sums: photons are made splats in chunks, and batches of chunks are added up.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/sums.hpp"
#include "nephroid/splat/add_splat.hpp"
#include "nephroid/splat/splat_bins.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace nephroid::detail {

/// Splats photons as the policies say and adds them to sums [Frisvad et al. 2014, eq. 10].
template <class V, class F, class R, class Policies>
class Splatter {
public:
    using Chunk = SplatChunk<V, F>;

    /// @param sums  are referred to, and must outlive the splatter
    Splatter(Sums<V, F, R>& sums, const Policies& policies)
        : sums_(&sums), policies_(policies), bins_(sums.map().tree().leaves().size()) {}

    [[nodiscard]] const EyePathMap<V>& map() const { return sums_->map(); }
    [[nodiscard]] const Policies& policies() const { return policies_; }

    /// Makes a splat of a deposit; its flux is booked in the account under what became of it. Called from several
    /// threads with a chunk each.
    ///
    /// @param takes  takes(leaf) -> whether that leaf of the map's tree is to get its part: all do unless told
    template <std::size_t N, class Takes = EveryLeaf>
    void prepare(const Deposit<V, F, N>& deposit, Chunk& chunk, Statistics& account, const Takes& takes = {}) const {
        account.end(make(deposit, chunk, account, takes), power(deposit));
    }

    /// The same of a photon that was taken to pieces, at least one: it is splatted if one of them is, and the flux of
    /// each is booked under what became of it.
    template <std::size_t N>
    void prepare(std::span<const Deposit<V, F, N>> pieces, Chunk& chunk, Statistics& account) const {
        std::array<double, fate_count> flux{};
        Fate fate = Fate::splatted;
        bool is_splatted = false;
        for (const Deposit<V, F, N>& piece : pieces) {
            const Fate fate_of_piece = make(piece, chunk, account, EveryLeaf{});
            flux[std::size_t(fate_of_piece)] += power(piece);
            is_splatted = is_splatted || fate_of_piece == Fate::splatted;
            fate = is_splatted ? Fate::splatted : fate_of_piece;
        }
        account.end(fate, 0);
        for (std::size_t i = 0; i < fate_count; ++i)
            account.lose(Fate(i), flux[i]);
    }

    /// Adds the splats of consecutive chunks to the sums, in order.
    template <class E>
    void add(std::span<const Chunk> chunks, E& executor) {
        bins_.sort(chunks, executor);
        // Neighbouring groups have lines of cache in common, which two threads take from each other again and again: a
        // task is several where that leaves enough of them for many threads.
        const std::size_t groups_per_task = std::clamp<std::size_t>(bins_.groups() / 256, 1, 4);
        for_each_index(executor, bins_.groups(), groups_per_task, [&](std::size_t group) {
            for (const BinnedSplat<V, F>& binned : bins_[group])
                add_splat(*binned.splat, binned.meeting, binned.leaf, policies_.kernel, *sums_);
        });
    }

private:
    template <std::size_t N>
    [[nodiscard]] static double power(const Deposit<V, F, N>& deposit) {
        return double(flux_traits<F>::power(deposit.flux));
    }

    template <std::size_t N, class Takes>
    [[nodiscard]] Fate make(const Deposit<V, F, N>& deposit, Chunk& chunk, Statistics& account,
                            const Takes& takes) const {
        const auto outcome = make_splat(deposit, map(), policies_);
        account.bounded_footprints += outcome.bounded;
        return outcome.splat && !chunk.add(map(), *outcome.splat, takes) ? Fate::unseen : outcome.fate;
    }

    Sums<V, F, R>* sums_;
    Policies policies_;
    SplatBins<V, F> bins_;
};

} // namespace nephroid::detail
