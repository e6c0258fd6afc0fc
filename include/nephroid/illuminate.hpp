// SPDX-License-Identifier: MIT
/// @file  One call for all light that a renderer does not find by itself: caustics, and light of all diffuse bounces.
#pragma once

#include "nephroid/bounce/illumination.hpp"
#include "nephroid/bounce/splat_global.hpp"
#include "nephroid/caustics.hpp"
#include "nephroid/emission/target.hpp"

#include <cstdint>
#include <optional>
#include <type_traits>

namespace nephroid {

/// What one pass of `illuminate` traces. Each pass weighs as much as any other, however many photons it has.
template <class V>
struct IlluminationPass {
    /// Light between diffuse surfaces.
    struct Global {
        std::uint64_t count = 0;        ///< photons; 0 for none
        std::optional<double> radius{}; ///< of the first pass's disks, world units, > 0; chosen if left out
        double alpha = 2.0 / 3;         ///< in (0, 1]: how fast disks shrink from pass to pass; with 1 only once
    };
    /// Light that mirrors and glass focus.
    struct Caustic {
        std::uint64_t count = 0;                   ///< photons; 0 for none
        std::optional<BoundingSphere<V>> target{}; ///< of the mirrors and glass: lamps that can be aimed (`AimsAt`) are
    };

    Global global{};
    Caustic caustic{};
    WalkLimits limits{};
};

/// What became of the light of one pass. The two accounts are of other photons each, and of the same lamp.
struct IlluminationStatistics {
    Statistics caustic;
    GlobalSplats global;
};

/// Adds a pass to an illumination. **Caustic** light, by mirrors and glass alone, is splatted to second order, with
/// photons of the lamp aimed at the target. **Indirect** light, by at least one diffuse surface, is splatted as disks,
/// with photons of the lamp as it is. No path counts twice, and direct light is left to the renderer.
///
/// ```cpp
/// nephroid::Illumination<Vec3, Colour> light(map, scene); // short rays about the eye vertices, once
/// nephroid::illuminate(scene, lamp, light,
///                      {.global = {.count = 50'000}, .caustic = {.count = 50'000, .target = glass}}, threads);
/// light.for_each([&](std::size_t vertex, const Colour& caustic, const Colour& indirect) {
///     film[vertices[vertex].pixel] += vertices[vertex].albedo_over_pi * (caustic + indirect);
/// });
/// ```
///
/// @param scene      its `scatter` returns Event::diffuse, with the albedo as the weight, on surfaces that send light
///                   on
/// @param lamp       one light or a LightSet, not aimed at anything
/// @param light      what the pass is added to. Its photons follow those of the passes before
/// @param pass       how many photons, and what caustics are aimed at
/// @param arguments  optional, in any order: a sequence (otherwise `HaltonSequence`) and an executor. The light is the
///                   same bit for bit with any executor
/// Throws std::invalid_argument for a pass without photons, a target, radius or α that cannot be, and a scene none of
/// whose surfaces returns Event::diffuse if indirect light is asked for.
template <class S, class L, class V, class F, detail::MustBeTraceArgument... Arguments>
    requires(detail::MustNotRepeat<Arguments...>&& detail::MustEmit<L, V, F>&&
                 detail::MustBeScene<S, V, Sampler<detail::sequence_among<Arguments...>>>)
IlluminationStatistics illuminate(const S& scene, const L& lamp, Illumination<V, F>& light,
                                  const std::type_identity_t<IlluminationPass<V>>& pass, Arguments&&... arguments) {
    detail::check_alpha("nephroid::illuminate", pass.global.alpha);
    if (pass.global.count == 0 && pass.caustic.count == 0)
        invalid_argument("nephroid::illuminate: zero photons; global.count or caustic.count must be at least 1");
    IlluminationStatistics statistics;
    const auto add_caustics = [&](const auto& source) {
        const PhotonPass photons{
            .first = light.caustic_part().next, .count = pass.caustic.count, .limits = pass.limits};
        statistics.caustic = caustics(scene, source, light.caustic(), photons, arguments...);
        light.end_caustic_pass(pass.caustic.count);
    };
    const auto add_indirect = [&] {
        const GlobalPass photons{.first = light.indirect_part().next,
                                 .count = pass.global.count,
                                 .radius = light.radius() ? light.radius() : pass.global.radius,
                                 .limits = pass.limits};
        statistics.global = splat_global(scene, lamp, light.indirect(), light.distances(), photons, arguments...);
        const std::optional<double> radius =
            pass.global.radius ? pass.global.radius : statistics.global.radius_of_later_passes();
        light.end_indirect_pass(pass.global.count, radius, pass.global.alpha);
    };
    // Indirect light first: what it refuses, it refuses before anything is added.
    const auto add_both = [&](const auto& source) {
        if (pass.global.count > 0)
            add_indirect();
        if (pass.caustic.count > 0)
            add_caustics(source);
    };
    if constexpr (AimsAt<L, V>)
        pass.caustic.target ? add_both(lamp.aimed_at(*pass.caustic.target)) : add_both(lamp);
    else
        add_both(lamp);
    return statistics;
}

} // namespace nephroid
