// SPDX-License-Identifier: MIT
/// @file  Indirect light of all bounces: photons behind at least one diffuse surface, as disks of one radius over the
///        share of a disk that lies on the surface.
#pragma once

#include "nephroid/bounce/disk_radius.hpp"
#include "nephroid/bounce/indirect_photons.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/gather/check_radius.hpp"
#include "nephroid/pass/call_arguments.hpp"
#include "nephroid/splat/splat_arguments.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>

namespace nephroid {

/// Which photons a pass of indirect light traces.
struct GlobalPass {
    std::uint64_t first = 0; ///< index of the first photon
    std::uint64_t count = 0; ///< photons emitted in this pass, >= 1
    std::uint64_t total = 0; ///< photons of the whole picture, of which this pass is a part; 0 means `count`
    /// Of all disks, world units, > 0. If empty, cross-validation chooses it with the picture's first photons.
    std::optional<double> radius{};
    WalkLimits limits{};
    /// As in PhotonPass: called after each batch, and stops the pass if it returns false.
    std::function<bool(std::uint64_t)> progress{};
};

/// What a pass of indirect light did.
struct GlobalSplats {
    Statistics statistics;               ///< `received` says what arrived at diffuse surfaces, by which way
    Statistics disks{};                  ///< what became of the deposits of indirect light: splatted, or unseen
    double radius = 0;                   ///< of the disks, world units
    bool is_radius_chosen = true;        ///< false if there was too little light to choose it by: it is then the reach
    std::uint64_t bounded_coverages = 0; ///< vertices of whose disk less than a twentieth lies on the surface

    /// From where the disks of further passes shrink (ShrinkingRadius), after a pass whose radius was not given. What
    /// was chosen is best for one pass by itself. The mean of passes keeps their bias and loses their noise, so that
    /// they begin with this share of it: 0.84 sqrt(Γ(5/3)) (include/nephroid/README.md, "Coverage").
    [[nodiscard]] std::optional<double> radius_of_later_passes() const {
        return is_radius_chosen ? std::optional(0.8 * radius) : std::nullopt;
    }

    /// Adds another pass to the accounts. The radius and what it bounded are those of the last one.
    GlobalSplats& operator+=(const GlobalSplats& other) {
        statistics += other.statistics;
        disks += other.disks;
        radius = other.radius;
        is_radius_chosen = other.is_radius_chosen;
        bounded_coverages = other.bounded_coverages;
        return *this;
    }
};

namespace detail {
/// A sequence or an executor; otherwise an error says what is wrong.
template <class A>
concept MustBeTraceArgument = MustBeOneOf<A, SequenceKind, ExecutorKind>;

/// Throws std::invalid_argument for options that make no sense.
template <class V, class F, class R>
void check(const GlobalPass& pass, const Sums<V, F, R>& sums, const FreeDistances<V>& distances) {
    check(PhotonPass{.count = pass.count, .total = pass.total}, "nephroid::splat_global");
    if (pass.radius)
        check_radius<scalar_t<V>>("nephroid::splat_global", "radius", *pass.radius, false);
    if (&distances.map() != &sums.map())
        invalid_argument("nephroid::splat_global: the free distances are those of another map than the sums'");
}

/// Throws std::invalid_argument for a scene without a surface that sends light on. Of few photons none may have met one
/// by chance.
inline void check_bounces(const Statistics& statistics) {
    constexpr std::uint64_t enough = 1000;
    std::uint64_t arrived = 0;
    for (const Tally& tally : statistics.received)
        arrived += tally.photons;
    if (arrived >= enough && statistics.diffuse_events == 0)
        invalid_argument("nephroid::splat_global: all " + std::to_string(arrived) +
                         " photons that reached a diffuse surface ended there, so that there is no indirect light; "
                         "scatter must return Event::diffuse, with the albedo as its weight");
}

/// A radius, and whether there was enough light to choose it by.
struct ChosenRadius {
    double radius;
    bool is_chosen;
};

/// Traces the first photons of a picture, and chooses the radius for the whole of it.
template <class S, class L, class V, class Sequence, class E>
[[nodiscard]] ChosenRadius radius_from_pilot(const S& scene, const L& lamp, const FreeDistances<V>& distances,
                                             const PhotonPass& pass, const Sequence& sequence, E& executor) {
    using F = typename L::flux_type;
    constexpr std::uint64_t most = 32768;
    PhotonPass pilot = pass;
    if (pass.total != 0) // parts of one picture have one pilot
        pilot.first = 0;
    const std::uint64_t all = pass.emitted_in_all(), count = (std::min)(most, all);
    IndirectPhotons photons(scene, lamp, pilot, sequence);
    check_bounces(photons.trace(0, count, executor));
    QuarteredDeposits<V, F> stored;
    for (std::uint64_t i = 0; i < count; ++i)
        for (const Deposit<V, F, 0>& deposit : photons[i]) {
            stored.deposits.push_back(deposit);
            stored.quarter.push_back(std::uint8_t(i * 4 / count));
        }
    return {validated_radius(distances, stored, count, all, executor),
            stored.deposits.size() >= fewest_deposits_to_choose_by};
}

/// Splats a pass of disks of one radius.
template <class S, class L, class V, class F, class R, class Sequence, class E>
[[nodiscard]] GlobalSplats splat_disks(const S& scene, const L& lamp, Sums<V, F, R>& sums,
                                       const FreeDistances<V>& distances, const PhotonPass& pass, ChosenRadius chosen,
                                       const Sequence& sequence, E& executor) {
    Sums<V, F, response_within<R>> disks(sums.map(), sums.response());
    Splatter splatter(disks, disks_of(chosen.radius, distances));
    IndirectPhotons photons(scene, lamp, pass, sequence);
    Statistics traced;
    const Statistics splatted = splat_in_batches( // which the walk has booked as what it became later
        splatter, pass.count,
        [&](std::uint64_t i, auto& chunk, Statistics& account) {
            for (const Deposit<V, F, 0>& deposit : photons[i])
                splatter.prepare(deposit, chunk, account);
        },
        executor,
        [&](std::uint64_t begin, std::uint64_t end) {
            traced += photons.trace(begin, end, executor);
            return Statistics{};
        },
        pass.progress);
    check_bounces(traced);
    return {traced, splatted, chosen.radius, chosen.is_chosen,
            add_over_coverage(disks, chosen.radius, distances, sums, executor)};
}
} // namespace detail

/// Adds the indirect light of diffuse surfaces to sums: of all paths from the lamp to a vertex that have at least one
/// diffuse surface between, and mirrors and glass wherever they stand. What comes straight from the lamp is left to the
/// renderer, and what comes through mirrors and glass alone to `caustics`, so that no light is added twice.
///
/// ```cpp
/// const nephroid::EyePathMap map(vertices, &MyVertex::position, &MyVertex::normal);
/// const nephroid::FreeDistances distances(map, scene);
/// auto sums = nephroid::sums<Colour>(map);
/// nephroid::splat_global(scene, lamp, sums, distances, {.count = 50'000}, threads);
/// ```
///
/// @param scene      its `scatter` returns Event::diffuse with the albedo as its weight (transport/scattering.hpp)
/// @param lamp       one light or a LightSet, not aimed at anything: all of its light counts
/// @param sums       the light is added to these
/// @param distances  of the map of the sums (receiver/free_distances.hpp)
/// @param pass       which photons to trace, and the radius if you know it
/// @param arguments  optional, in any order: the sequence that photon i's numbers come from (otherwise
///                   `HaltonSequence`) and an executor. The sums are the same bit for bit with any executor
/// Throws std::invalid_argument for zero photons, a radius that is not positive, distances of another map, and a scene
/// none of whose surfaces returned Event::diffuse to a thousand photons. Memory: a second copy of the sums, one batch,
/// and at most 32,768 pilot photons, which are traced once more.
template <class S, class L, class V, class F, class R, detail::MustBeTraceArgument... Arguments>
    requires(detail::MustNotRepeat<Arguments...>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<S, V, Sampler<detail::sequence_among<Arguments...>>, 0>)
GlobalSplats splat_global(const S& scene, const L& lamp, Sums<V, F, R>& sums, const FreeDistances<V>& distances,
                          const GlobalPass& pass, Arguments&&... arguments) {
    detail::check(pass, sums, distances);
    return detail::with_splat_arguments<Published>(
        [&](const auto&, const auto& sequence, auto& executor) {
            const auto source = detail::without_tangents(lamp);
            const PhotonPass photons{.first = pass.first,
                                     .count = pass.count,
                                     .total = pass.total,
                                     .limits = pass.limits,
                                     .progress = pass.progress};
            const detail::ChosenRadius radius =
                pass.radius ? detail::ChosenRadius{*pass.radius, true}
                            : detail::radius_from_pilot(scene, source, distances, photons, sequence, executor);
            return detail::splat_disks(scene, source, sums, distances, photons, radius, sequence, executor);
        },
        arguments...);
}

} // namespace nephroid
