// SPDX-License-Identifier: MIT
/// @file  Photon relaxation: a photon map's photons moved into a blue-noise arrangement that keeps its features, after
///        which 20 neighbours give what took hundreds [Spencer and Jones 2009, "Into the Blue: Better Caustics through
///        Photon Relaxation"].
///
/// ```cpp
/// nephroid::ThreadExecutor threads;
/// nephroid::relax(photons, nephroid::photon_access(&MyPhoton::position, &MyPhoton::normal, &MyPhoton::flux),
///                 nephroid::RelaxationOptions::keeping_density(), threads);
/// ```
#pragma once

#include "nephroid/relaxation/detect_features.hpp"
#include "nephroid/relaxation/options.hpp"
#include "nephroid/relaxation/photon_access.hpp"
#include "nephroid/relaxation/relaxer.hpp"

namespace nephroid {

/// Leaves a moved photon in the tangent plane that it moved in: for flat surfaces, and unknown ones.
struct StayInPlane {
    template <class V>
    [[nodiscard]] const V& operator()(std::size_t, const V& position) const {
        return position;
    }
};

/// Goes on to the last iteration.
struct Continue {
    [[nodiscard]] bool operator()(unsigned) const { return true; }
};

/// Relaxes photons: their positions change, their fluxes if `options.flux_diffusion` says so, nothing else, and none
/// is added, dropped or put elsewhere in the range.
///
/// @param photons   a random-access range of the user's photons; untouched if an exception is thrown
/// @param access    `photon_access(…)`: a photon's position, normal and flux
/// @param executor  who runs it; the result is the same bit for bit for any number of threads
/// @param project   project(photon index, position) -> position: puts a moved photon back on its curved surface. Its
///                  normal stays what it was, so it should not be far. Called from several threads at once.
/// @param progress  progress(iteration) -> bool: called by the calling thread after each iteration, from 0; false stops
///                  there, with the photons as they are then
/// Throws std::invalid_argument naming the photon whose position or normal cannot be, or the option.
///
/// Takes some 120 bytes per photon beside the caller's, in single precision.
template <class Photons, class Access, class E, class Project = StayInPlane, class Progress = Continue>
    requires MovesPhotons<Access, Photons> && Executor<E&>
        RelaxationReport relax(Photons&& photons, const Access& access, const RelaxationOptions& options, E&& executor,
                               const Project& project = {}, const Progress& progress = {}) {
        using V = detail::position_t<Photons, Access>;
        using Cloud = PhotonCloud<V, detail::flux_t<Photons, Access>>;
        detail::check(options, "relax");
        Cloud cloud(photons, access, options.cos_same_surface, "nephroid::relax");
        detail::Relaxer<Cloud> relaxer(cloud, options, executor);
        RelaxationReport report;
        report.photons = std::size_t(std::ranges::size(photons));
        report.feature_searches = relaxer.searches();
        report.constrained_photons = relaxer.constrained_photons();

        const auto put_back = [&](std::size_t slot, const V& position) -> V {
            if constexpr (std::is_same_v<Project, StayInPlane>) {
                return position;
            } else {
                const std::size_t photon = cloud.tree().index(slot);
                const V there = project(photon, V(cloud.tree().origin() + position));
                if (!all_finite(there))
                    invalid_argument(std::string("nephroid::relax: project put photon ") + std::to_string(photon) +
                                     " at " + detail::text_of(there) + "; every position must be finite");
                return cloud.tree().relative(there);
            }
        };
        for (bool go_on = report.photons > 0; go_on && report.iterations < options.iterations;) {
            const double moves = relaxer.step(report.iterations, executor, put_back);
            report.mean_step.push_back(moves / double(report.photons));
            go_on = progress(report.iterations++);
        }
        if (report.iterations > 0)
            cloud.write_positions(photons, access, executor);
        if (report.iterations > 0 && options.flux_diffusion != FluxDiffusion::none)
            cloud.write_fluxes(photons, access, executor);
        return report;
    }

/// Evens out the fluxes of photons that stay where they are: `options.iterations` steps of `options.flux_diffusion`,
/// not across features if `options.constrain` says so.
///
/// @param photons, access, executor  as for `relax`
template <class Photons, class Access, class E>
    requires MovesPhotons<Access, Photons> && Executor<E&>
void diffuse_flux(Photons&& photons, const Access& access, const RelaxationOptions& options, E&& executor) {
    using Cloud = PhotonCloud<detail::position_t<Photons, Access>, detail::flux_t<Photons, Access>>;
    detail::check(options, "diffuse_flux");
    Cloud cloud(photons, access, options.cos_same_surface, "nephroid::diffuse_flux");
    if (options.flux_diffusion == FluxDiffusion::none || options.iterations == 0)
        return;
    RelaxationOptions without_target = options; // which only moves ask for
    without_target.pilot_neighbours = 0;
    detail::Relaxer<Cloud> relaxer(cloud, without_target, executor);
    relaxer.diffuse(executor);
    for (unsigned i = 1; i < options.iterations; ++i)
        relaxer.exchange_flux(executor);
    cloud.write_fluxes(photons, access, executor);
}

} // namespace nephroid
