// SPDX-License-Identifier: MIT
/// @file  The features of a photon map: edges of density or flux, and how firmly they hold each photon.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/relaxation/feature_detector.hpp"
#include "nephroid/relaxation/options.hpp"
#include "nephroid/relaxation/parallel_sheets.hpp"
#include "nephroid/relaxation/photon_access.hpp"
#include "nephroid/relaxation/photon_cloud.hpp"
#include "nephroid/relaxation/photon_constraint.hpp"

#include <cstddef>
#include <ranges>
#include <vector>

namespace nephroid {

/// Finds the features of a photon map as relaxation sees them.
///
/// @param photons   a random-access range of the user's photons; nothing is written
/// @param access    `photon_access(…)`: a photon's position, normal and flux
/// @param executor  who runs the work; the result does not depend on it
/// @return  a `PhotonConstraint` for each photon, in the order of `photons`: the feature's direction g and its hold w.
///          g is zero where w is, and where features of several directions meet
/// Throws std::invalid_argument naming the photon whose position, normal or flux cannot be, or the option.
template <class Photons, class Access, class E = SerialExecutor>
    requires detail::MustReadPhotons<Access, Photons> && detail::MustBeExecutor<E>
[[nodiscard]] auto detect_features(Photons&& photons, const Access& access, const RelaxationOptions& options,
                                   E&& executor = E{}) {
    using V = detail::position_t<Photons, Access>;
    using Cloud = detail::PhotonCloud<V, detail::flux_t<Photons, Access>>;
    detail::check(options, "detect_features");
    Cloud cloud(photons, access, options.cos_same_surface, "nephroid::detect_features");
    detail::separate_sheets(cloud, executor);
    detail::FeatureDetector<Cloud> detector(cloud, options);
    detector.run(executor);
    std::vector<PhotonConstraint<V>> constraints(std::size_t(std::ranges::size(photons)),
                                                 {zero_vector<V>(), scalar_t<V>(0)});
    detail::for_each_slot(cloud.tree(), executor,
                          [&](std::size_t slot) { constraints[cloud.tree().index(slot)] = detector.constraint(slot); });
    return constraints;
}

} // namespace nephroid
