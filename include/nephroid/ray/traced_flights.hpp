// SPDX-License-Identifier: MIT
/// @file  Batches of photons followed through all bounces, with the flights of each that count.
#pragma once

#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/pass/traced_batch.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/frame.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// A visitor that collects flights, and starts tangents anew behind each diffuse surface.
template <Vector3 V, Flux F, std::size_t N, class Flights>
struct FlightCollector {
    using T = scalar_t<V>;
    static constexpr bool follows_bounces = true;

    const Flights& flights;
    Spread<T> spread;
    T start_radius;  ///< of beams at diffuse surfaces, world units
    T least_density; ///< per steradian
    std::vector<Flight<V, F, N>> found{};

    void flight(const Flight<V, F, N>& flight) {
        if (flights.counts(flight))
            found.push_back(flight);
    }
    void deposit(const Deposit<V, F, N>&, const WalkedPath<>&) {}

    /// A cone from a disk of the starting radius, across the direction.
    [[nodiscard]] PhotonDifferential<V, N> reemitted(const V& direction, T density) const {
        const Frame<V> frame = frame_about(direction);
        const T turn = spread.length(T(1) / (std::max)(density, least_density)), width = T(2) * start_radius;
        const V zero = zero_vector<V>();
        PhotonDifferential<V, N> tangents;
        for (std::size_t i = 0; i < N; ++i)
            tangents[i] = i == 0   ? Tangent<V>{width * frame.u, turn * frame.u}
                          : i == 1 ? Tangent<V>{width * frame.v, turn * frame.v}
                                   : Tangent<V>{zero, zero};
        return tangents;
    }
};

/// How beams start, for a pass.
template <Scalar T>
struct BeamStart {
    Spread<T> spread; ///< with the pass's smoothing
    T radius;         ///< at diffuse surfaces
    T least_density;  ///< of directions there
};

/// @param scene, lamp, flights, sequence  kept by reference
template <class S, class L, class Flights, SampleSequence Sequence>
class TracedFlights {
public:
    using V = typename L::vector;
    using F = typename L::flux_type;
    using T = scalar_t<V>;
    static constexpr std::size_t tangents = tangent_count_of<L>;

    TracedFlights(const S& scene, const L& lamp, const PhotonPass& pass, const Flights& flights,
                  const BeamStart<T>& start, const Sequence& sequence)
        : scene_(scene), lamp_(lamp), first_(pass.first), limits_(pass.limits), flights_(flights), start_(start),
          sequence_(sequence) {
        if constexpr (!Flights::after_bounces)
            limits_.diffuse_bounces = 0;
    }

    /// Traces photons `begin` to end − 1 of the pass.
    template <class E>
    Statistics trace(std::uint64_t begin, std::uint64_t end, E& executor) {
        const auto trace_one = [&](std::uint64_t i, Statistics& account) {
            Sampler<Sequence> sampler(sequence_, first_ + i);
            FlightCollector<V, F, tangents, Flights> collector{flights_, start_.spread, start_.radius,
                                                               start_.least_density};
            walk(scene_, lamp_.emit(sampler, start_.spread), sampler, limits_, account, collector);
            return std::move(collector.found);
        };
        return batch_.trace(lamp_, sequence_, first_, begin, end, trace_one, executor);
    }

    /// The flights of photon i that count, which must be one of those traced last.
    [[nodiscard]] std::span<const Flight<V, F, tangents>> operator[](std::uint64_t i) { return batch_[i]; }

private:
    const S& scene_;
    const L& lamp_;
    std::uint64_t first_;
    WalkLimits limits_;
    const Flights& flights_;
    BeamStart<T> start_;
    const Sequence& sequence_;
    TracedBatch<std::vector<Flight<V, F, tangents>>> batch_;
};

} // namespace nephroid::detail
