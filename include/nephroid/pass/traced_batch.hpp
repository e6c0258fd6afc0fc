// SPDX-License-Identifier: MIT
/// @file  A batch of photons, traced by several threads in a coherent order and stored in the order of their indices.
#pragma once

#include "nephroid/pass/coherent_order.hpp"
#include "nephroid/transport/account.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// Photons of a batch, stored by their indices in whatever order they are traced.
///
/// @tparam Record  what is stored of a photon; default-constructible
template <class Record>
class TracedBatch {
public:
    /// Traces photons `begin` to end − 1 of a pass.
    ///
    /// @param first      index of the pass's first photon
    /// @param trace_one  trace_one(i, account) returns the Record of photon first + i. Called from several threads
    /// @return  the sum of the accounts; the same bit for bit with any executor
    template <PhotonSource L, SampleSequence Sequence, class Trace, ExecutorArgument E>
    Statistics trace(const L& light, const Sequence& sequence, std::uint64_t first, std::uint64_t begin,
                     std::uint64_t end, const Trace& trace_one, E& executor) {
        const auto count = std::size_t(end - begin), per_task = (std::max)(least_per_task, (count + 63) / 64);
        const std::span<const KeyedPhoton> order = order_.sort(light, sequence, first + begin, count, executor);
        begin_ = begin;
        make_room(count, executor);
        accounts_.resize((count + per_task - 1) / per_task);
        executor(accounts_.size(), [&](std::size_t task) {
            Statistics account; // a local one, so that threads do not write to the same cache line
            const std::size_t from = task * per_task;
            for (const KeyedPhoton& photon : order.subspan(from, (std::min)(per_task, count - from))) {
                Record& record = at(photon.number);
                prefetch(record);
                record = trace_one(begin + photon.number, account);
            }
            accounts_[task] = account;
        });
        Statistics sum;
        for (const Statistics& account : accounts_)
            sum += account;
        return sum;
    }

    /// The record of photon i of the pass, which must be in the batch traced last.
    [[nodiscard]] Record& operator[](std::uint64_t i) { return at(std::size_t(i - begin_)); }

private:
    static constexpr std::size_t least_per_task = 16, records_per_block = 1024;

    [[nodiscard]] Record& at(std::size_t number) {
        return blocks_[number / records_per_block][number % records_per_block];
    }

    /// Allocates records. First use of new memory costs a tenth of tracing, so the threads do it together.
    template <class E>
    void make_room(std::size_t count, E& executor) {
        const std::size_t had = blocks_.size(), want = (count + records_per_block - 1) / records_per_block;
        if (want <= had)
            return;
        blocks_.resize(want);
        executor(want - had, [&](std::size_t i) { blocks_[had + i] = std::vector<Record>(records_per_block); });
    }

    /// Prefetches a record while its photon is traced, because it is far from the last one in memory.
    static void prefetch(const Record& record) {
#if defined(__GNUC__)
        for (std::size_t offset = 0; offset < sizeof(Record); offset += 64)
            __builtin_prefetch(reinterpret_cast<const char*>(&record) + offset, 1);
#else
        (void)record;
#endif
    }

    CoherentOrder order_;
    std::uint64_t begin_ = 0;
    std::vector<std::vector<Record>> blocks_;
    std::vector<Statistics> accounts_;
};

} // namespace nephroid::detail
