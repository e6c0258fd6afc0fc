// SPDX-License-Identifier: MIT
/// @file  Photon rays: light that counts along a photon's way, not where it lands [Herzog et al. 2007], with beams for
///        cones.
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/ray/ray_smoothing.hpp"
#include "nephroid/ray/ray_splatter.hpp"
#include "nephroid/ray/traced_flights.hpp"
#include "nephroid/splat/splat_arguments.hpp"
#include "nephroid/splat/splat_in_batches.hpp"

#include <cstdint>
#include <type_traits>

namespace nephroid {

/// What a pass of photon rays did.
struct RaySplats {
    Statistics statistics;            ///< of the photons: a flight that is splatted does not end its photon
    Statistics flights{};             ///< what became of the flights that count: splatted, unseen (near no vertex that
                                      ///< faces them), collapsed, invalid. `bounded_footprints` were wider than the map
    double smoothing = 0;             ///< s of the beams; 0 if their widths do not depend on it
    bool is_smoothing_chosen = false; ///< whether cross-validation found it
    std::uint64_t rejected = 0;       ///< pairs of a flight and a vertex that short rays kept apart
};

namespace detail {
struct RayPoliciesKind {
    template <class A>
    static constexpr bool is = is_ray_policies<std::remove_cvref_t<A>>;
};

/// Ray policies, a sequence or an executor; otherwise an error says what is wrong.
template <class A>
concept MustBeRayArgument = MustBeOneOf<A, RayPoliciesKind, SequenceKind, ExecutorKind>;

/// At most one of each.
template <class... Arguments>
concept MustNotRepeatRays = NotRepeated<RayPoliciesKind, Arguments...> && NotRepeated<SequenceKind, Arguments...> &&
    NotRepeated<ExecutorKind, Arguments...>;

/// Bands are moved along a tangent where photons land, which a beam does not do.
template <class L>
consteval bool explain_ray_light() {
    static_assert(
        !has_wavelength<parameters_t<L>>,
        "nephroid::splat_rays: a Spectral light's photons have all bands at the place of one wavelength; give "
        "a lamp for each band, or splat it by nephroid::caustics");
    return !has_wavelength<parameters_t<L>>;
}

template <class L>
concept MustFitRays = explain_ray_light<L>();

template <class L, class V, class Policies>
consteval bool explain_ray_width() {
    using Width = std::remove_cvref_t<decltype(Policies::width)>;
    static_assert(ChoosesRayWidth<Width, Flight<V, typename L::flux_type, tangent_count_of<L>>, V>,
                  "nephroid: the width policy cannot be called as width(flight, filter_radius) const -> "
                  "std::optional<Beam<V>> (ray/ray_width.hpp)");
    static_assert(!std::same_as<Width, DifferentialWidth> || tangent_count_of<L> >= 2,
                  "nephroid: these photons carry no tangents to widen beams by: leave WithoutTangents out, or choose "
                  "FixedRayWidth (ray/ray_width.hpp)");
    return true;
}

template <class S, class L, class V, class F, class R, class Policies, class Sequence, class E>
RaySplats splat_flights(const S& scene, const L& lamp, Sums<V, F, R>& sums, const PhotonPass& pass,
                        const Policies& policies, const Sequence& sequence, E& executor) {
    const RaySmoothing chosen = smoothing_of_rays(scene, lamp, sums, pass, policies, sequence, executor);
    TracedFlights photons(scene, lamp, pass, policies.flights,
                          beam_start(sums.map(), policies.width, pass, chosen.smoothing), sequence);
    RaySplatter splatter(scene, sums, policies);
    Statistics traced;
    const Statistics flights = splat_in_batches(
        splatter, pass.count,
        [&](std::uint64_t i, auto& chunk, Statistics& account) {
            for (const auto& flight : photons[i])
                splatter.prepare(flight, chunk, account);
        },
        executor,
        [&](std::uint64_t begin, std::uint64_t end) {
            traced += photons.trace(begin, end, executor);
            return Statistics{};
        },
        pass.progress);
    using Width = std::remove_cvref_t<decltype(policies.width)>;
    return {traced, flights, uses_smoothing<Width> ? chosen.smoothing : 0, chosen.is_chosen, splatter.rejected()};
}
} // namespace detail

/// Adds the light of photons to all vertices that lie near their flights, in front of what ends them: direct light,
/// caustics and the light of all diffuse bounces, or those that the policies choose. No surface enters the density, so
/// the light is right at edges and corners, and on leaves and other things that are smaller than a beam.
///
/// ```cpp
/// const nephroid::EyePathMap map(vertices, &MyVertex::position, &MyVertex::normal);
/// auto sums = nephroid::sums<Colour>(map);
/// const auto indirect = nephroid::Rays{}.with_flights(nephroid::IndirectFlights{});
/// nephroid::splat_rays(scene, lamp, sums, {.count = 100'000}, indirect, threads);
/// ```
///
/// @param scene      its `scatter` returns Event::diffuse with the albedo as its weight where light goes on. What a
///                   medium absorbs on the last flight before a vertex is not taken off
/// @param lamp       one light or a LightSet, not aimed at anything: all of its light counts. Of more than two tangents
///                   the first two widen beams
/// @param sums       the light is added to these; with a response its BRDF is evaluated for each flight
/// @param pass       which photons to trace, and the smoothing s of their beams. If that is empty, cross-validation
///                   chooses it with the picture's first photons
/// @param arguments  optional, in any order: ray policies (otherwise `Rays`), the sequence that photon i's numbers come
///                   from (otherwise `HaltonSequence`) and an executor. The sums are the same bit for bit with any
///                   executor
/// Throws std::invalid_argument for zero photons, and for a smoothing or lengths of policies that are not positive and
/// finite. Memory: the sums and one batch.
template <class S, class L, class V, class F, class R, detail::MustBeRayArgument... Arguments>
    requires(detail::MustNotRepeatRays<Arguments...>&& detail::MustFitRays<L>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<S, V, Sampler<detail::sequence_among<Arguments...>>, detail::tangent_count_of<L>>)
RaySplats splat_rays(const S& scene, const L& lamp, Sums<V, F, R>& sums, const PhotonPass& pass,
                     Arguments&&... arguments) {
    detail::check(pass, "nephroid::splat_rays");
    return detail::with_splat_arguments<Rays, detail::RayPoliciesKind>(
        [&](const auto& policies, const auto& sequence, auto& executor) {
            static_assert(detail::explain_ray_width<L, V, std::remove_cvref_t<decltype(policies)>>());
            detail::check_rays(policies);
            return detail::splat_flights(scene, lamp, sums, pass, policies, sequence, executor);
        },
        arguments...);
}

} // namespace nephroid
