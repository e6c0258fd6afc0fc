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
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/relaxation/options.hpp"
#include "nephroid/relaxation/photon_access.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/relaxer.hpp"

namespace nephroid {

/// Leaves a moved photon in its tangent plane: for flat surfaces, and where the surface is not known.
struct StayInPlane {
    template <class V>
    [[nodiscard]] const V& operator()(std::size_t, const V& position) const {
        return position;
    }
};

namespace detail {
/// Goes on to the last iteration.
struct Continue {
    [[nodiscard]] bool operator()(unsigned) const { return true; }
};
} // namespace detail

/// Relaxes photons: writes their positions, and their fluxes if `options.flux_diffusion` says so. Nothing else of a
/// photon changes, and the range keeps its photons in their order.
///
/// @param photons   a random-access range of the user's photons; untouched if an exception is thrown
/// @param access    `photon_access(…)`: a photon's position, normal and flux
/// @param executor  who runs the work; the result is the same bit for bit for any number of threads
/// @param project   project(photon index, position) -> position: puts a moved photon back on its curved surface. Its
///                  normal is not changed, so the position should not be far. Called from several threads at once.
/// @param progress  progress(iteration) -> bool: called by the calling thread after each iteration, from 0; false stops
///                  there and writes the photons as they are
/// Throws std::invalid_argument naming the photon whose position, normal or flux cannot be, or the option.
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

} // namespace nephroid
