// SPDX-License-Identifier: MIT
/// @file  A photon at a diffuse surface: its deposit, and whether it goes on from there.
#pragma once

#include "nephroid/transport/account.hpp"
#include "nephroid/transport/diffuse_bounce.hpp"
#include "nephroid/transport/visit_reporter.hpp"
#include "nephroid/transport/walk_limits.hpp"
#include "nephroid/vector/in_place.hpp"

#include <cstddef>
#include <optional>

namespace nephroid::detail {

/// What became of a photon at a surface.
struct Departing {
    bool goes_on;
    bool passes; ///< through the surface
};

/// Does at a diffuse surface what the visitor wants. Refers to the parts of one photon's walk.
template <class S, Vector3 V, Flux F, std::size_t N, class Visitor>
class DiffuseSurface {
public:
    using H = hit_t<S, V>;
    using Steps = PhotonSteps<S, V, F, N>;
    using Reporter = VisitReporter<S, V, F, N, Visitor>;

    DiffuseSurface(Steps& steps, Reporter& reporter, const WalkLimits& limits, Statistics& account)
        : steps_(steps), reporter_(reporter), limits_(limits), account_(account) {}

    /// @param scattering  Event::deposit or Event::diffuse
    /// @param kept        gets the deposit if the visitor takes none
    template <class Scattering, class Sampler>
    [[nodiscard]] Departing meet(const H& hit, [[maybe_unused]] const Scattering& scattering,
                                 [[maybe_unused]] Sampler& sampler,
                                 [[maybe_unused]] std::optional<Deposit<V, F, N>>& kept) const {
        if constexpr (follows_bounces<Visitor>) {
            return {bounce(hit, scattering, sampler), false};
        } else {
            if constexpr (!wants_direct_light<Visitor>)
                if (reporter_.path().is_direct())
                    return {steps_.end(Fate::direct), false};
            reporter_.surface(hit, steps_.is_in_front_of(hit), false);
            if constexpr (SendsPhotonsOn<Visitor, V, F, N>) {
                if (const std::optional<Photon<V, F, N>> onwards = reporter_.deposit(steps_.deposit(hit)))
                    return go_on_with(*onwards, hit);
            } else if constexpr (VisitsDeposits<Visitor, V, F, N>) {
                reporter_.deposit(steps_.deposit(hit));
            } else {
                kept.emplace(InPlace{[&] { return steps_.deposit(hit); }});
            }
            return {false, false};
        }
    }

private:
    /// Tells the visitor of the deposit, and lets the surface scatter the photon.
    ///
    /// @return  whether the photon goes on
    template <class Scattering, class Sampler>
    [[nodiscard]] bool bounce(const H& hit, const Scattering& scattering, Sampler& sampler) const {
        const auto& path = reporter_.path();
        account_.arrive(path.arrival(), steps_.power(steps_.photon().flux));
        reporter_.surface(hit, steps_.is_in_front_of(hit), false);
        if (wants_direct_light<Visitor> || !path.is_direct())
            reporter_.deposit(steps_.deposit(hit));
        if (scattering.event == Event::deposit)
            return steps_.end(Fate::absorbed);
        ++account_.diffuse_events;
        if (!bounce_diffusely(steps_, hit, scattering.weight, sampler, account_))
            return false;
        if constexpr (N > 0) {
            Photon<V, F, N> onwards = steps_.photon();
            onwards.differential = reporter_.reemitted(onwards.direction, diffuse_density(onwards.direction, hit));
            steps_.continue_as(onwards, steps_.medium());
        }
        return counts_bounce();
    }

    /// Goes on from a diffuse surface with the photon that the visitor returned.
    [[nodiscard]] Departing go_on_with(const Photon<V, F, N>& onwards, const H& hit) const {
        const bool from_front = steps_.is_in_front_of(hit);
        const double arrived = steps_.power(steps_.photon().flux), carried = steps_.power(onwards.flux);
        if (!isfinite(carried))
            return {steps_.end(Fate::invalid), false};
        account_.lose(Fate::absorbed, arrived - carried);
        steps_.continue_as(onwards, steps_.medium());
        return {counts_bounce(), steps_.is_in_front_of(hit) == from_front};
    }

    /// @return  whether the photon may bounce once more
    [[nodiscard]] bool counts_bounce() const {
        if (reporter_.path().diffuse_bounces == limits_.diffuse_bounces)
            return steps_.end(Fate::terminated);
        ++reporter_.path().diffuse_bounces;
        return true;
    }

    Steps& steps_;
    Reporter& reporter_;
    const WalkLimits& limits_;
    Statistics& account_;
};

} // namespace nephroid::detail
