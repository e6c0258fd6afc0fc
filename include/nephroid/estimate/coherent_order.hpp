// SPDX-License-Identifier: MIT
/// @file  The order in which photons are traced: neighbours at the lamp one after the other, as their rays then meet the
/// same nodes of the ray tracer's tree and the same triangles.
///
/// It decides how fast a batch is traced and nothing else: photon i is the same whenever it is traced, and goes where
/// its index says.
#pragma once

#include "nephroid/emission/emission_sample.hpp"
#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/emission/sequence/sequence.hpp"
#include "nephroid/transport/executor.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nephroid {

/// Where a sample lies on a Z-shaped curve through its light's domain [Morton 1966]: 16 bits, 8 of each coordinate of a
/// point or directional light, 4 of each of an area light; above them the light's number, or the last 16 bits of it.
[[nodiscard]] constexpr std::uint32_t place_on_z_curve(const EmissionSample& sample) {
    const bool is_area = sample.dimensions > 2;
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
    return place | sample.light << 16;
}

/// Sorts the photons of one batch after another; keeps its memory, 20 bytes for each photon of the largest one.
class CoherentOrder {
public:
    /// @param light  as for `splat_caustics`; draws every photon's numbers here once more
    /// @param first  index of the batch's first photon
    /// @param count  of photons, below 2^32
    /// @return  the numbers 0 to count − 1, as photons first + number are best traced; until the next call. A function of
    ///          what is drawn alone: the executor makes no difference.
    template <PhotonSource L, SampleSequence Sequence, ExecutorArgument E>
    std::span<const std::uint32_t> sort(const L& light, const Sequence& sequence, std::uint64_t first,
                                        std::size_t count, E& executor) {
        using T = scalar_t<typename L::vector>;
        photons_.resize(count);
        detail::for_each_index(executor, count, 1024, [&](std::size_t i) {
            Sampler<Sequence> sampler(sequence, first + i);
            RecordingSource<Sampler<Sequence>> recorder(sampler);
            (void)light.emit(recorder, Spread<T>{T(1), T(1)});
            photons_[i] = {place_on_z_curve(recorder.sample()), static_cast<std::uint32_t>(i)};
        });
        sort_by_place();
        order_.resize(count);
        std::transform(photons_.begin(), photons_.end(), order_.begin(), [](const Placed& p) { return p.number; });
        return order_;
    }

private:
    struct Placed {
        std::uint32_t place;
        std::uint32_t number;
    };

    /// By the place's bytes, from the lowest one on, each pass keeping the order that the one before left.
    void sort_by_place() {
        sorted_.resize(photons_.size());
        for (unsigned shift = 0; shift < 32; shift += 8) {
            const auto byte_of = [shift](const Placed& p) { return std::size_t(p.place >> shift & 255u); };
            std::array<std::size_t, 256> begin{};
            for (const Placed& p : photons_)
                ++begin[byte_of(p)];
            if (photons_.empty() || begin[byte_of(photons_.front())] == photons_.size())
                continue;
            std::size_t sum = 0;
            for (std::size_t& b : begin)
                sum += std::exchange(b, sum);
            for (const Placed& p : photons_)
                sorted_[begin[byte_of(p)]++] = p;
            std::swap(photons_, sorted_);
        }
    }

    std::vector<Placed> photons_, sorted_;
    std::vector<std::uint32_t> order_;
};

} // namespace nephroid
