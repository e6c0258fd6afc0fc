// SPDX-License-Identifier: MIT
/// @file  The front door: renders caustics from the lamp to the eye path vertices. Include your vectors
///        (nephroid/vector/glm.hpp, or traits of your own) and the lights (nephroid/emission/light/) as well.
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/smoothing/splat_to_second_order.hpp"
#include "nephroid/splat/splat_caustics.hpp"
#include "nephroid/version.hpp"

namespace nephroid {

/// Emits photons, follows them through the scene, and splats them onto eye path vertices: to second order, or according
/// to the policies.
///
/// ```cpp
/// const nephroid::EyePathMap map(vertices, &MyVertex::position, &MyVertex::normal);
/// auto sums = nephroid::sums<float>(map);
/// nephroid::caustics(scene, light, sums, {.count = 100'000}, threads);
/// sums.for_each([&](std::size_t vertex, float irradiance) { film[vertices[vertex].pixel] += irradiance; });
/// ```
///
/// @param scene      the renderer's: rays and surfaces (transport/scene.hpp); used from several threads
/// @param light      one light, or a LightSet of several (emission/light/); WithoutTangents for policies that use no
///                   differentials (FixedFootprint)
/// @param sums       the light is added to these (receiver/sums.hpp)
/// @param pass       which photons to trace, how many there are in all, and their smoothing
/// @param arguments  optional, in any order: splat policies (otherwise `Default`), the sequence that photon i's numbers
///                   come from (otherwise `HaltonSequence`; photon i is a pure function of it and i), and an executor
///                   that runs the work of each batch (otherwise `SerialExecutor`). The sums are the same bit for bit
///                   with any executor
/// @return  what became of the flux, with counts
/// Throws std::invalid_argument for zero photons, a smoothing that is not positive, and options of `SecondOrder` that
/// make no sense.
/// Memory: the sums, one batch, and the pilot photons of second-order splatting, whatever the number of photons. While
/// it compares pictures: of lights without a domain (smoothing/cross_validation.hpp) a second copy of the sums; of
/// lights with area (smoothing/compared_with_published.hpp) two more, and as many deposits as the pilot has.
template <class S, class L, class V, class F, class R, detail::MustBeSplatArgument... Arguments>
    requires(detail::MustNotRepeat<Arguments...>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<detail::scene_for<S, L>, V, Sampler<detail::sequence_among<Arguments...>>>)
Statistics caustics(const S& scene, const L& light, Sums<V, F, R>& sums, const PhotonPass& pass,
                    Arguments&&... arguments) {
    detail::check(pass, "nephroid::caustics");
    return detail::with_splat_arguments<Default>(
        [&]<class Policies>(const Policies& policies, const auto& sequence, auto& executor) {
            if constexpr (detail::is_second_order<Policies, L>) {
                detail::check(policies.order, "nephroid::caustics");
                return detail::splat_to_second_order(scene, light, sums, pass, policies, sequence, executor);
            } else {
                return detail::splat_to_first_order(scene, light, sums, pass, policies, sequence, executor);
            }
        },
        arguments...);
}

} // namespace nephroid
