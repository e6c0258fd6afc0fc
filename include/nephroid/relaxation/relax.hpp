// SPDX-License-Identifier: MIT
/// @file  Photon relaxation: moves a photon map's photons into blue noise that keeps the map's features, so that 20
///        neighbours give what took hundreds [Spencer and Jones 2009, "Into the Blue: Better Caustics through Photon
///        Relaxation"].
///
/// ```cpp
/// nephroid::ThreadExecutor threads;
/// nephroid::relax(photons, nephroid::photon_access(&MyPhoton::position, &MyPhoton::normal, &MyPhoton::flux),
///                 nephroid::RelaxationOptions::keeping_density(), threads);
/// ```
///
/// On a table of 1 by 2, from which no photon is to fall:
///
/// ```cpp
/// const auto on_table = [](std::size_t, const V& p) { return V(clamp(p.x, 0, 1), clamp(p.y, 0, 2), 0); };
/// nephroid::relax(photons, access, options, threads, on_table);
/// ```
#pragma once

#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/execution/executor.hpp"
#include "nephroid/relaxation/options.hpp"
#include "nephroid/relaxation/parallel_sheets.hpp"
#include "nephroid/relaxation/photon_access.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/relaxer.hpp"
#include "nephroid/relaxation/surface_projection.hpp"

#include <algorithm>

namespace nephroid {

namespace detail {
/// k for estimates from a relaxed map, by its pilot: what relaxing leaves is the pilot's own noise, which no k takes
/// away. More than 40 gains hardly anything and blurs folds.
[[nodiscard]] inline std::size_t estimate_neighbours(unsigned pilot_neighbours) {
    return std::clamp(std::size_t(pilot_neighbours) / 16, std::size_t(20), std::size_t(40));
}

/// Goes on to the last iteration.
struct Continue {
    [[nodiscard]] bool operator()(unsigned) const { return true; }
};
} // namespace detail

/// Relaxes photons: writes their positions, their fluxes if `options.flux_diffusion` says so, and their normals if
/// `project` does. Nothing else of a photon changes, and the range keeps its photons in their order.
///
/// @param photons   a random-access range of the user's photons; untouched if an exception is thrown
/// @param access    `photon_access(…)`: a photon's position, normal and flux
/// @param executor  who runs the work; the result is the same bit for bit for any number of threads
/// @param project   project(photon index, position) -> position: puts a moved photon back on its surface, one that is
///                  curved or has a border. It may return a `SurfacePoint` instead, whose normal the photon takes on:
///                  the access's normal then refers to what can be written. Without it photons leave their surface at
///                  its borders, by less than the leash. Called from several threads at once.
/// @param progress  progress(iteration) -> bool: called by the calling thread after each iteration, from 0; false stops
///                  there and writes the photons as they are
/// Throws std::invalid_argument naming the photon whose position, normal or flux cannot be, or the option.
///
/// Squares of distances between photons must be numbers of the scalar type. Where they would overflow, the map is
/// refused. Where they lose digits, as in float for maps smaller than 1e-14 units, photons move otherwise, or stay: a
/// map of one place is allowed, so that this is not told.
///
/// Takes some 120 bytes per photon beside the caller's, in single precision.
template <class Photons, class Access, class E = SerialExecutor, class Project = StayInPlane,
          class Progress = detail::Continue>
    requires detail::MustMovePhotons<Access, Photons> && detail::MustBeExecutor<E>
        RelaxationReport relax(Photons&& photons, const Access& access, const RelaxationOptions& options,
                               E&& executor = E{}, const Project& project = {}, const Progress& progress = {}) {
        using V = detail::position_t<Photons, Access>;
        using Cloud = detail::PhotonCloud<V, detail::flux_t<Photons, Access>>;
        detail::check(options, "relax");
        detail::CheckedExecutor checked(executor);
        Cloud cloud(photons, access, options.cos_same_surface, "nephroid::relax");
        detail::separate_sheets(cloud, checked);
        detail::Relaxer<Cloud> relaxer(cloud, options, checked);
        RelaxationReport report;
        report.photons = std::size_t(std::ranges::size(photons));
        report.feature_searches = relaxer.searches();
        report.constrained_photons = relaxer.constrained_photons();
        report.pilot_neighbours = relaxer.pilot().neighbours;
        report.stratified = relaxer.pilot().stratified;
        report.pilot_unjudged = !relaxer.pilot().judged && !report.stratified;
        report.estimate_neighbours = detail::estimate_neighbours(report.pilot_neighbours);

        detail::SurfaceProjection<Cloud, Project> on_surface(cloud, project);
        const auto put_back = [&](std::size_t slot, const V& position) { return on_surface(slot, position); };
        for (bool go_on = report.photons > 0; go_on && report.iterations < options.iterations;) {
            const double moves = relaxer.step(report.iterations, checked, put_back);
            on_surface.turn_normals(checked);
            report.mean_step.push_back(moves / double(report.photons));
            go_on = progress(report.iterations++);
        }
        if (report.iterations > 0)
            cloud.write_positions(photons, access, checked);
        if constexpr (on_surface.turns_normals)
            cloud.write_normals(photons, access, checked);
        if (report.iterations > 0 && options.flux_diffusion != FluxDiffusion::none)
            cloud.write_fluxes(photons, access, checked);
        return report;
    }

} // namespace nephroid
