// SPDX-License-Identifier: MIT
/// @file  The loop over batches of photons: trace them, make splats of them, add the splats to the sums.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/splat/splatter.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Chooses the number of photons in a batch.
///
/// A batch is traced in parallel, prepared in chunks, and binned as a whole. The next batch has as many photons as make
/// `visits` pairs of splat and leaf, estimated from the last batch, so that memory does not grow with the size of the
/// footprints. It is at most `growth` times as large as the last one. Large batches are faster, because photons that
/// are traced one after the other are closer together. The sums are the same bit for bit with any sizes.
struct BatchSizes {
    static constexpr std::size_t chunks = 64;
    static constexpr std::size_t least = 4 * chunks, first = 16 * chunks, most = 1024 * chunks;
    static constexpr std::size_t most_watched = most / 8; ///< in passes with `progress`, which may stop them
    static constexpr std::size_t visits = std::size_t(1) << 19, growth = 8;

    /// The number of photons in the next batch.
    ///
    /// @param count    photons in the last batch
    /// @param batch    size chosen for the last batch
    /// @param visited  pairs of splat and leaf that it made
    [[nodiscard]] static constexpr std::uint64_t after(std::uint64_t count, std::uint64_t batch, std::uint64_t visited,
                                                       bool is_watched) {
        const std::uint64_t fitting = count * visits / (visited + 1), grown = growth * batch;
        return std::clamp<std::uint64_t>(fitting < grown ? fitting : grown, least, is_watched ? most_watched : most);
    }
};

/// Traces nothing: for photons that were traced before.
struct NothingToTrace {
    Statistics operator()(std::uint64_t, std::uint64_t) const { return {}; }
};

/// Splats photons 0 to count − 1.
///
/// @param prepare   prepare(i, chunk, account) adds photon i's splat to the chunk, or books in the account why there is
///                  none. Called from several threads
/// @param trace     trace(begin, end) -> Statistics: called before photons begin to end − 1 are prepared
/// @param progress  may be empty; called after each batch with the number of photons done so far. If it returns false,
///                  the loop ends
template <class Splatter, class Prepare, class E, class Trace = NothingToTrace>
Statistics splat_in_batches(Splatter& splatter, std::uint64_t count, const Prepare& prepare, E& executor,
                            const Trace& trace = {}, const std::function<bool(std::uint64_t)>& progress = {}) {
    using Chunk = typename Splatter::Chunk;
    std::vector<Chunk> chunks(BatchSizes::chunks);
    std::vector<Statistics> accounts(BatchSizes::chunks);
    Statistics account;
    std::uint64_t batch = BatchSizes::first;
    for (std::uint64_t done = 0; done < count;) {
        const std::uint64_t batch_end = done + (std::min)(batch, count - done);
        const std::uint64_t per_chunk = (batch_end - done + BatchSizes::chunks - 1) / BatchSizes::chunks;
        announce(executor, Phase::trace);
        account += trace(done, batch_end);
        executor(BatchSizes::chunks, [&](std::size_t c) {
            chunks[c].clear();
            Statistics chunk_account;
            const std::uint64_t begin = (std::min)(batch_end, done + c * per_chunk);
            const std::uint64_t end = (std::min)(batch_end, begin + per_chunk);
            for (std::uint64_t i = begin; i < end; ++i)
                prepare(i, chunks[c], chunk_account);
            accounts[c] = chunk_account;
        });
        announce(executor, Phase::splat);
        splatter.add({chunks.data(), chunks.size()}, executor);

        std::uint64_t visited = 0;
        for (std::size_t c = 0; c < BatchSizes::chunks; ++c) {
            account += accounts[c];
            visited += chunks[c].visits().size();
        }
        batch = BatchSizes::after(batch_end - done, batch, visited, bool(progress));
        done = batch_end;
        if (progress && !progress(done))
            break;
    }
    return account;
}

} // namespace nephroid::detail
