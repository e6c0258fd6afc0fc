// SPDX-License-Identifier: MIT
/// @file  Photons followed from one diffuse surface to the next, and their deposits behind at least one bounce.
#pragma once

#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/pass/photon_pass.hpp"
#include "nephroid/pass/traced_batch.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/transport/walk.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::detail {

/// A visitor that collects a photon's deposits of indirect light.
template <Vector3 V, Flux F>
struct IndirectDeposits {
    static constexpr bool follows_bounces = true;
    std::vector<Deposit<V, F, 0>> found{};

    void deposit(const Deposit<V, F, 0>& deposit, const WalkedPath<>& path) {
        if (path.diffuse_bounces > 0)
            found.push_back(deposit);
    }
};

/// A lamp as a source of photons without tangents, which disks do not need.
template <Light L>
[[nodiscard]] WithoutTangents<L> without_tangents(const L& light) {
    return WithoutTangents<L>(light);
}
template <EmitsWithoutTangents L>
[[nodiscard]] const L& without_tangents(const L& light) {
    return light;
}

/// Batches of photons with all deposits of each, in the order in which it left them.
///
/// @param lamp  without tangents; it, the scene and the sequence are kept by reference
template <class S, class L, SampleSequence Sequence>
class IndirectPhotons {
public:
    using V = typename L::vector;
    using F = typename L::flux_type;

    IndirectPhotons(const S& scene, const L& lamp, const PhotonPass& pass, const Sequence& sequence)
        : scene_(scene), lamp_(lamp), pass_(pass), sequence_(sequence) {}

    /// Traces photons `begin` to end − 1 of the pass.
    template <class E>
    Statistics trace(std::uint64_t begin, std::uint64_t end, E& executor) {
        const auto spread = spread_of<scalar_t<V>>(pass_);
        const auto trace_one = [&](std::uint64_t i, Statistics& account) {
            Sampler<Sequence> sampler(sequence_, pass_.first + i);
            IndirectDeposits<V, F> deposits;
            walk(scene_, lamp_.emit(sampler, spread), sampler, pass_.limits, account, deposits);
            return std::move(deposits.found);
        };
        return batch_.trace(lamp_, sequence_, pass_.first, begin, end, trace_one, executor);
    }

    /// The deposits of photon i, which must be one of those traced last.
    [[nodiscard]] std::span<const Deposit<V, F, 0>> operator[](std::uint64_t i) { return batch_[i]; }

private:
    const S& scene_;
    const L& lamp_;
    const PhotonPass& pass_;
    const Sequence& sequence_;
    TracedBatch<std::vector<Deposit<V, F, 0>>> batch_;
};

} // namespace nephroid::detail
