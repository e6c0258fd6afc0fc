// SPDX-License-Identifier: MIT
/// @file  Makes splats of deposits in chunks, and adds batches of chunks to sums.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/sums.hpp"
#include "nephroid/splat/add_splat.hpp"
#include "nephroid/splat/splat_bins.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace nephroid::detail {

/// Splats photons according to policies and adds them to sums [Frisvad et al. 2014, eq. 10].
template <class V, class F, class R, class Policies>
class Splatter {
public:
    using Chunk = SplatChunk<V, F>;

    /// @param sums  kept by reference; must outlive the splatter
    Splatter(Sums<V, F, R>& sums, const Policies& policies)
        : sums_(&sums), policies_(policies), bins_(sums.map().tree().leaves().size()) {}

    [[nodiscard]] const EyePathMap<V>& map() const { return sums_->map(); }
    [[nodiscard]] const Policies& policies() const { return policies_; }

    /// Makes a splat of a deposit and books its flux in the account under its fate. May be called from several threads,
    /// each with a chunk of its own.
    ///
    /// @param takes  takes(leaf) returns whether a leaf of the map's tree is to receive light
    template <std::size_t N, class Takes = EveryLeaf>
    void prepare(const Deposit<V, F, N>& deposit, Chunk& chunk, Statistics& account, const Takes& takes = {}) const {
        account.end(make(deposit, chunk, account, takes), power(deposit));
    }

    /// The same for a photon in one or several pieces. It counts as splatted if one of them is, and the flux of each
    /// piece is booked under the piece's fate.
    template <std::size_t N>
    void prepare(std::span<const Deposit<V, F, N>> pieces, Chunk& chunk, Statistics& account) const {
        prepare_each(
            [pieces](const auto& use) {
                for (const Deposit<V, F, N>& piece : pieces)
                    use(piece);
            },
            chunk, account);
    }

    /// The same for pieces that are made one after the other.
    ///
    /// @param for_each  for_each(use) calls use(deposit) for each piece
    /// @return  the power of all pieces
    template <class ForEach>
    double prepare_each(const ForEach& for_each, Chunk& chunk, Statistics& account) const {
        std::array<double, fate_count> flux{};
        Fate fate = Fate::splatted;
        bool is_splatted = false;
        double sum = 0;
        for_each([&](const auto& piece) {
            const Fate fate_of_piece = make(piece, chunk, account, EveryLeaf{});
            flux[std::size_t(fate_of_piece)] += power(piece);
            sum += power(piece);
            is_splatted = is_splatted || fate_of_piece == Fate::splatted;
            fate = is_splatted ? Fate::splatted : fate_of_piece;
        });
        account.end(fate, 0);
        for (std::size_t i = 0; i < fate_count; ++i)
            account.lose(Fate(i), flux[i]);
        return sum;
    }

    /// Adds the splats of consecutive chunks to the sums, in order.
    template <class E>
    void add(std::span<const Chunk> chunks, E& executor) {
        bins_.for_each(chunks, executor, [&](const Binned<Splat<V, F>>& binned) { add(binned); });
    }

private:
    /// Adds one splat to a leaf, as the policies say if they have a way of their own.
    void add(const Binned<Splat<V, F>>& binned) {
        if constexpr (requires { policies_.add(*binned.splat, binned.meeting, binned.leaf, *sums_); })
            policies_.add(*binned.splat, binned.meeting, binned.leaf, *sums_);
        else
            add_splat(*binned.splat, binned.meeting, binned.leaf, policies_.kernel, *sums_);
    }

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
    BinsOf<Splat<V, F>> bins_;
};

} // namespace nephroid::detail
