// SPDX-License-Identifier: MIT
/// @file  Caustics from the lamp to the eye path vertices: the library's front door. Beside it include the vectors
///        (nephroid/vector/glm.hpp, or traits of your own) and the lights (nephroid/emission/light/).
#pragma once

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/smoothing/splat_to_second_order.hpp"
#include "nephroid/splat/splat_caustics.hpp"

namespace nephroid {

/// Emits photons, walks them through the scene and splats them onto eye path vertices: to second order, or as the
/// policies say.
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
/// @param sums       what is added to (receiver/sums.hpp)
/// @param pass       which photons, how many in all, how smooth
/// @param arguments  in any order, none needed: splat policies (`Default` unless told); a sequence, where photon i's
///                   numbers come from (`HaltonSequence`): photon i is a pure function of it and i; an executor, who
///                   runs the work, called to trace and to splat each batch (`SerialExecutor`). The sums do not depend
///                   on the executor, bit for bit
/// @return  what became of the flux, and counts
/// Throws std::invalid_argument for zero photons, a smoothing that is not positive, and bounds of `SecondOrder` that
/// cannot be.
/// Memory: the sums, one batch, and the pilot photons of second-order splatting, whatever the number of photons; while
/// a smoothing is chosen for lights without cells (smoothing/cross_validation.hpp), the sums twice.
template <class S, class L, class V, class F, class R, detail::MustBeSplatArgument... Arguments>
    requires(detail::MustNotRepeat<Arguments...>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<S, V, Sampler<detail::sequence_among<Arguments...>>>)
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
