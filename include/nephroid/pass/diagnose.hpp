// SPDX-License-Identifier: MIT
/// @file  Diagnoses a pass: says in sentences what looks wrong.
#pragma once

#include "nephroid/transport/account.hpp"
#include "nephroid/vector/text.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace nephroid {

namespace detail {
/// A sentence, and the share of the photons or of their light that it is about.
struct Finding {
    double share; ///< in [0, 1]
    std::string sentence;
};

/// "97%", "0.3%", "less than 0.1%".
[[nodiscard]] inline std::string percent(double share) {
    const auto tenths = static_cast<std::uint64_t>(1000 * (std::min)(1.0, share) + 0.5);
    if (tenths == 0)
        return "less than 0.1%";
    if (tenths >= 100)
        return std::to_string((tenths + 5) / 10) + "%";
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + "%";
}

[[nodiscard]] inline double part_of(double part, double all) { return all > 0 ? part / all : 0; }

/// Looks for mistakes in what became of the photons' paths.
inline void look_at_paths(const Statistics& s, std::vector<Finding>& found) {
    const auto emitted = double(s.emitted.photons);
    const auto add = [&](double share, double least, const std::string& what) {
        if (share >= least && share > 0)
            found.push_back({share, percent(share) + " of " + what});
    };
    const bool bounces = s.diffuse_events > 0; // then light needs no mirror on its way
    if (bounces) {
        add(part_of(double(s.escaped_first), emitted), 0.9,
            "the photons met nothing: does the lamp stand in the scene and shine into it?");
    } else if (s.specular_events == 0) {
        const double opaque = part_of(double(s.opaque_first), emitted);
        found.push_back({1, opaque >= 0.5
                                ? percent(opaque) + " of the photons ended at the first surface they met, and none met "
                                                    "a mirror or glass: is the lamp inside of a closed shade, or does "
                                                    "a wall stand between?"
                                : "no photon met a mirror or glass: aim the light at them (its `target` or `patch`), "
                                  "and let `scatter` answer reflect or refract there"});
    } else {
        add(part_of(double(s.opaque_first) + double(s.escaped_first), emitted), 0.4,
            "the photons missed the mirrors and glass, or ended on a diffuse part of them: if they missed, give the "
            "light a narrower target, a sphere about them, or several (emission/separate_targets.hpp)");
    }
    if (s.invalid_albedos > 0)
        found.push_back({part_of(double(s.invalid_albedos), emitted),
                         percent(part_of(double(s.invalid_albedos), emitted)) +
                             " of the photons met an albedo that cannot be, first of " + text_of(s.invalid_albedo) +
                             " on surface " + std::to_string(s.invalid_albedo_surface) +
                             ": the `weight` of Event::diffuse must be in [0, 1] in each band"});
    add(part_of(double(s[Fate::invalid].photons - s.invalid_albedos), emitted), 1e-3,
        "the photons are invalid: a number of the hit or of `scatter` was not finite, a normal or direction not unit "
        "(the photon needs both to 0.2%), a distance or weight negative, `eta` not positive, or the curvature's "
        "probes found nothing (`tracer_epsilon`)");
    add(part_of(double(s.hits_at_start), double(s.specular_events)), 0.01,
        "the rays from a mirror or glass hit something where they began: surfaces touch there, or the renderer found "
        "the same surface again and `position_error` is too small for its tracer");
    add(part_of(s[Fate::terminated].flux, s.emitted.flux), 0.05,
        bounces ? "the light was terminated on long paths: a closed scene of albedos near 1 holds it that long; raise "
                  "`WalkLimits::diffuse_bounces`, or look for rays that hit the surface they leave"
                : "the light was terminated on long paths: raise `WalkLimits::specular_events`, or look for rays that "
                  "hit the surface they leave");
    add(part_of(double(s.corrected_normals), double(s.specular_events) + double(s.diffuse_bounces)), 0.05,
        "the reflections, refractions and bounces used the geometric normal, as the shading normal would have sent the "
        "ray through the surface: check that both are on one side");
}

/// Looks for mistakes in what became of the light of caustics.
inline void look_at_caustics(const Statistics& s, std::vector<Finding>& found) {
    const auto caustic = double(s.caustic_photons());
    const auto add = [&](std::uint64_t photons, double least, const std::string& what) {
        const double share = part_of(double(photons), caustic);
        if (share >= least && share > 0)
            found.push_back({share, percent(share) + " of the caustic photons " + what});
    };
    const double drawn = s[Fate::splatted].flux + s[Fate::unseen].flux; // by light sheets, which count no photons
    if (s.specular_events > 0 && caustic == 0 && !(drawn > 0))
        found.push_back({1, "no photon reached a diffuse surface through a mirror or glass: " +
                                percent(part_of(s[Fate::escaped].flux, s.emitted.flux)) +
                                " of the light leaves the scene and " +
                                percent(part_of(s[Fate::absorbed].flux, s.emitted.flux)) +
                                " is absorbed; is there a floor, and does `scatter` answer deposit there?"});
    const double went_through = double(s.emitted.photons) - double(s.opaque_first) - double(s.escaped_first);
    const double left = part_of(double(s[Fate::escaped].photons) - double(s.escaped_first), went_through);
    if (caustic > 0 && left >= 0.7)
        found.push_back({left, percent(left) + " of the photons that met a mirror or glass leave the scene: is there a "
                                               "surface where they go, and do rays find it from that side?"});
    add(s[Fate::unseen].photons, 0.9, "fell where no eye path vertex sees them: does the camera look at the caustic?");
    add(s[Fate::collapsed].photons, 0.05,
        "had footprints without area and were left out: does `curvature` answer for the surface that was hit?");
    add(s[Fate::excessive].photons, 0.05, "had footprints without bounds and were left out");
    add(s.splatted_as_published, 0.5,
        "were splatted as published, because their neighbours did not determine better footprints: flat facets do "
        "that, and normals at their vertices would help; so do several paths in one place, and more photons would "
        "help");
}
} // namespace detail

/// Says what looks wrong in a pass, worst first: sentences with numbers and advice. Empty if nothing looks wrong, which
/// does not prove that the picture is right.
///
/// ```cpp
/// for (const std::string& sentence : nephroid::diagnose(statistics))
///     std::cerr << sentence << '\n';
/// ```
///
/// @param statistics  of any pass: `caustics`, `splat_caustics`, `trace_photons`, `SheetStatistics::light`, or photons
///                    walked one by one
[[nodiscard]] inline std::vector<std::string> diagnose(const Statistics& statistics) {
    std::vector<detail::Finding> found;
    if (statistics.emitted.photons == 0)
        found.push_back({1, "no photon was emitted"});
    else if (!(statistics.emitted.flux > 0))
        found.push_back({1, "the light emits nothing: its power is 0 towards its target"});
    else {
        detail::look_at_paths(statistics, found);
        if (statistics.diffuse_events == 0)
            detail::look_at_caustics(statistics, found);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
    std::vector<std::string> sentences;
    for (detail::Finding& finding : found)
        sentences.push_back(std::move(finding.sentence));
    return sentences;
}

} // namespace nephroid
