// SPDX-License-Identifier: MIT
/// @file  The order in which photons are traced: neighbours at the lamp one after the other, as their rays then meet
///        the
/// same nodes of the ray tracer's tree and the same triangles.
///
/// It decides how fast a batch is traced and nothing else: photon i is the same whenever it is traced, and goes where
/// its index says.
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

namespace nephroid {

/// Where a sample lies on a Z-shaped curve through its light's domain [Morton 1966]: 16 bits, 8 of each coordinate of a
/// point or directional light, 4 of each of an area light. Between the upper 8 and the lower 8, which tell 256 parts of
/// the domain and the places in one apart, the last 16 bits of the light's number keep the photons of a light together.
[[nodiscard]] constexpr std::uint32_t place_on_z_curve(const EmissionSample& sample) {
    const bool is_area = sample.coordinates > 2;
    const std::array<double, 4> coordinates = {sample.at[0], sample.at[1], sample.then[0], sample.then[1]};
    const std::size_t count = is_area ? 4 : 2;
    const unsigned bits = is_area ? 4 : 8;
    std::uint32_t place = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double cells = double(1u << bits), cell = coordinates[i] * cells;
        // What a sequence should not have given, NaN included, lies in the first cell.
        const std::uint32_t digits = cell >= 0 && cell < cells ? static_cast<std::uint32_t>(cell) : 0;
        for (unsigned bit = 0; bit < bits; ++bit)
            place |= (digits >> bit & 1u) << (bit * count + i);
    }
    return place >> 8 << 24 | (sample.light & 0xffffu) << 8 | (place & 0xffu);
}

/// A photon of a batch, and where it lies.
struct PlacedPhoton {
    std::uint32_t place;
    std::uint32_t number; ///< in the batch, from 0
};

/// Sorts the photons of one batch after another, in parallel; keeps its memory, 18 bytes for each photon of the
/// largest.
class CoherentOrder {
public:
    /// @param light  as for `splat_caustics`; draws every photon's coordinates here once more
    /// @param first  index of the batch's first photon
    /// @param count  of photons, below 2^32
    /// @return  the photons first + number in the order in which they are best traced, those in one place in the order
    ///          of their indices; until the next call. A function of what is drawn alone: the executor makes no
    ///          difference.
    template <PhotonSource L, SampleSequence Sequence, ExecutorArgument E>
    std::span<const PlacedPhoton> sort(const L& light, const Sequence& sequence, std::uint64_t first, std::size_t count,
                                       E& executor) {
        const std::size_t tasks = (count + photons_per_task - 1) / photons_per_task;
        photons_.resize(count);
        sorted_.start(tasks, parts);
        executor(tasks, [&](std::size_t task) {
            place(light, sequence, first, task);
            for (const PlacedPhoton& p : photons_of(task))
                sorted_.count(task, part_of(p));
        });
        sorted_.make_room();
        executor(tasks, [&](std::size_t task) {
            for (const PlacedPhoton& p : photons_of(task))
                sorted_.put(task, part_of(p), p);
        });
        executor(parts, [&](std::size_t part) {
            const std::span<PlacedPhoton> sorted = sorted_.items_of(part);
            const auto from = std::size_t(sorted.data() - sorted_.items().data());
            sort_part(sorted, std::span(photons_).subspan(from, sorted.size()));
        });
        return sorted_.items();
    }

private:
    static constexpr std::size_t photons_per_task = 1024, parts = 256;

    [[nodiscard]] static std::size_t part_of(const PlacedPhoton& p) { return p.place >> 24; }

    [[nodiscard]] std::span<PlacedPhoton> photons_of(std::size_t task) {
        const std::size_t from = task * photons_per_task;
        return std::span(photons_).subspan(from, (std::min)(photons_per_task, photons_.size() - from));
    }

    template <class L, class Sequence>
    void place(const L& light, const Sequence& sequence, std::uint64_t first, std::size_t task) {
        std::size_t number = task * photons_per_task;
        for (PlacedPhoton& p : photons_of(task)) {
            Sampler<Sequence> sampler(sequence, first + number);
            p = {place_on_z_curve(draw_point(light, sampler)), static_cast<std::uint32_t>(number++)};
        }
    }

    /// By the place's lower bytes, from the lowest one on, each pass keeping the order that the one before left.
    static void sort_part(std::span<PlacedPhoton> photons, std::span<PlacedPhoton> scratch) {
        for (unsigned shift = 0; shift < 24 && !photons.empty(); shift += 8) {
            const auto byte_of = [shift](const PlacedPhoton& p) { return std::size_t(p.place >> shift & 255u); };
            std::array<std::size_t, 256> begin{};
            for (const PlacedPhoton& p : photons)
                ++begin[byte_of(p)];
            if (begin[byte_of(photons.front())] == photons.size())
                continue;
            std::size_t sum = 0;
            for (std::size_t& b : begin)
                sum += std::exchange(b, sum);
            for (const PlacedPhoton& p : photons)
                scratch[begin[byte_of(p)]++] = p;
            std::copy(scratch.begin(), scratch.end(), photons.begin());
        }
    }

    std::vector<PlacedPhoton> photons_;
    detail::CountingSort<PlacedPhoton> sorted_; ///< by the first byte of the place, then each part by the others
};

} // namespace nephroid
