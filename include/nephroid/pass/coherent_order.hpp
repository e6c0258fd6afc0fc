// SPDX-License-Identifier: MIT
/// @file  The order in which photons are traced: neighbours at the lamp one after the other, so that their rays meet
///        the same nodes of the ray tracer's tree and the same triangles.
///
/// The order only affects speed: photon i is the same whenever it is traced, and is stored by its index.
#pragma once

#include "nephroid/emission/emission_sample.hpp"
#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/execution/counting_sort.hpp"
#include "nephroid/execution/executor.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// The sort key of a sample, from its position on a Z-shaped curve through its light's domain [Morton 1966]. The
/// position has 16 bits: 8 of each coordinate of a point or directional light, 4 of each of an area light. Its upper 8
/// bits come first in the key and select one of 256 parts of the domain. Then come 16 bits of the light's index, which
/// keep a light's photons together within a part, and last the lower 8 bits of the position.
[[nodiscard]] constexpr std::uint32_t z_curve_key(const EmissionSample& sample) {
    const bool is_area = sample.coordinates > 2;
    const std::array<double, 4> coordinates = {sample.at[0], sample.at[1], sample.then[0], sample.then[1]};
    const std::size_t count = is_area ? 4 : 2;
    const unsigned bits = is_area ? 4 : 8;
    std::uint32_t key = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double cells = double(1u << bits), cell = coordinates[i] * cells;
        // Invalid values of a sequence, NaN included, count as the first cell.
        const std::uint32_t digits = cell >= 0 && cell < cells ? static_cast<std::uint32_t>(cell) : 0;
        for (unsigned bit = 0; bit < bits; ++bit)
            key |= (digits >> bit & 1u) << (bit * count + i);
    }
    return key >> 8 << 24 | (sample.light & 0xffffu) << 8 | (key & 0xffu);
}

/// A photon of a batch, with the key that batches are sorted by.
struct KeyedPhoton {
    std::uint32_t key;
    std::uint32_t number; ///< index in the batch, from 0
};

/// Sorts the photons of batches, in parallel. Keeps its memory between batches: 18 bytes for each photon of the
/// largest.
class CoherentOrder {
public:
    /// @param light  as for `splat_caustics`; it draws every photon's coordinates once more
    /// @param first  index of the batch's first photon
    /// @param count  number of photons, < 2^32
    /// @return  the photons in the order in which to trace them; those of the same key in the order of their indices.
    ///          Valid until the next call. The executor makes no difference.
    template <PhotonSource L, SampleSequence Sequence, ExecutorArgument E>
    std::span<const KeyedPhoton> sort(const L& light, const Sequence& sequence, std::uint64_t first, std::size_t count,
                                      E& executor) {
        const std::size_t tasks = (count + photons_per_task - 1) / photons_per_task;
        photons_.resize(count);
        sorted_.start(tasks, parts);
        executor(tasks, [&](std::size_t task) {
            set_keys(light, sequence, first, task);
            for (const KeyedPhoton& p : photons_of(task))
                sorted_.count(task, part_of(p));
        });
        sorted_.make_room();
        executor(tasks, [&](std::size_t task) {
            for (const KeyedPhoton& p : photons_of(task))
                sorted_.put(task, part_of(p), p);
        });
        executor(parts, [&](std::size_t part) {
            const std::span<KeyedPhoton> sorted = sorted_.items_of(part);
            const auto from = std::size_t(sorted.data() - sorted_.items().data());
            sort_part(sorted, {photons_.data() + from, sorted.size()});
        });
        return sorted_.items();
    }

private:
    static constexpr std::size_t photons_per_task = 1024, parts = 256;

    [[nodiscard]] static std::size_t part_of(const KeyedPhoton& p) { return p.key >> 24; }

    [[nodiscard]] std::span<KeyedPhoton> photons_of(std::size_t task) {
        const std::size_t from = task * photons_per_task;
        return {photons_.data() + from, (std::min)(photons_per_task, photons_.size() - from)};
    }

    template <class L, class Sequence>
    void set_keys(const L& light, const Sequence& sequence, std::uint64_t first, std::size_t task) {
        std::size_t number = task * photons_per_task;
        for (KeyedPhoton& p : photons_of(task)) {
            Sampler<Sequence> sampler(sequence, first + number);
            p = {z_curve_key(draw_point(light, sampler)), static_cast<std::uint32_t>(number++)};
        }
    }

    /// Sorts by the lower bytes of the key, from the lowest on; each sort keeps the order that the one before made.
    static void sort_part(std::span<KeyedPhoton> photons, std::span<KeyedPhoton> scratch) {
        for (unsigned shift = 0; shift < 24 && !photons.empty(); shift += 8) {
            const auto byte_of = [shift](const KeyedPhoton& p) { return std::size_t(p.key >> shift & 255u); };
            std::array<std::size_t, 256> begin{};
            for (const KeyedPhoton& p : photons)
                ++begin[byte_of(p)];
            if (begin[byte_of(photons.front())] == photons.size())
                continue;
            std::size_t sum = 0;
            for (std::size_t& b : begin)
                sum += std::exchange(b, sum);
            for (const KeyedPhoton& p : photons)
                scratch[begin[byte_of(p)]++] = p;
            std::copy(scratch.begin(), scratch.end(), photons.begin());
        }
    }

    std::vector<KeyedPhoton> photons_;
    CountingSort<KeyedPhoton> sorted_; ///< by the key's highest byte, then within each part by the others
};

} // namespace nephroid::detail
