// SPDX-License-Identifier: MIT
/// @file  The loop of a photon's walk: flights, surfaces, and ways that part. What the visitor does not ask for is not
///        compiled.
#pragma once

#include "nephroid/transport/account.hpp"
#include "nephroid/transport/diffuse_surface.hpp"
#include "nephroid/transport/pending_ways.hpp"
#include "nephroid/transport/photon_steps.hpp"
#include "nephroid/transport/visit_reporter.hpp"
#include "nephroid/transport/visitor.hpp"
#include "nephroid/transport/walk_limits.hpp"
#include "nephroid/transport/ways.hpp"

#include <cstddef>
#include <optional>

namespace nephroid::detail {

/// The walk of one photon, along one way or along all ways in turn.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Visitor>
class VisitedWalk {
public:
    using H = hit_t<S, V>;
    using Kept = std::optional<Deposit<V, F, N>>;

    VisitedWalk(const S& scene, Photon<V, F, N>& photon, Sampler& sampler, const WalkLimits& limits,
                Statistics& account, Visitor& visitor)
        : scene_(scene), sampler_(sampler), limits_(limits), account_(account), steps_(scene, photon, account),
          reporter_(visitor, photon.position) {}

    /// @param kept  gets the deposit if the visitor takes none
    void run(Kept& kept) {
        if (!steps_.start())
            return;
        bool goes_on = true;
        do {
            while (goes_on)
                goes_on = fly(kept);
        } while (take_pending_way(kept, goes_on));
    }

private:
    static constexpr bool all_ways = follows_all_ways<Visitor>;
    static constexpr bool branches = all_ways && ScattersAllWays<S, V>;
    // Bounds on loops that only a faulty ray tracer makes endless.
    static constexpr unsigned most_lamp_surfaces = 4; ///< that a photon leaves at its start: both sides of thin lamps
    static constexpr unsigned most_passed = 1000;     ///< surfaces that light does not notice
    static constexpr unsigned most_edges = 64; ///< between triangles; a ray through a vertex meets many triangles

    /// Flies to the next surface and leaves it again.
    ///
    /// @return  whether the photon goes on; likewise below
    [[nodiscard]] bool fly(Kept& kept) {
        const Photon<V, F, N>& now = steps_.photon();
        if (!all_finite(now.position) || !all_finite(now.direction))
            return steps_.end(Fate::invalid);
        ++account_.rays;
        const auto hit = steps_.next_hit();
        if (hit && steps_.is_on_edge(*hit))
            return edges_++ < most_edges || steps_.end(Fate::terminated);
        reporter_.flight(steps_, hit);
        if (!hit) {
            account_.escaped_first += path().is_direct();
            return steps_.end(Fate::escaped);
        }
        if (!steps_.fly_to(*hit))
            return false;
        if constexpr (branches)
            return branch(*hit, scatter_all_in(steps_.medium(), scene_, *hit, now.direction), kept);
        else
            return follow<false>(*hit, scatter_in(steps_.medium(), scene_, *hit, now.direction, sampler_), kept);
    }

    /// Gives each way its share of the flux, and follows the first one.
    template <class List>
    [[nodiscard]] bool branch(const H& hit, const List& ways, Kept& kept) {
        if (ways.size() == 0)
            return steps_.end(Fate::absorbed);
        if (ways.size() == 1)
            return follow<false>(hit, ways[0], kept);
        return pending_.split(steps_, path(), hit, ways, limits_, account_) && follow<true>(hit, ways[0], kept);
    }

    /// Goes back to the last surface at which ways parted, and follows the next way there.
    ///
    /// @return  false if no way is left
    [[nodiscard]] bool take_pending_way([[maybe_unused]] Kept& kept, [[maybe_unused]] bool& goes_on) {
        if constexpr (branches) {
            if (pending_.empty())
                return false;
            const auto way = pending_.pop();
            steps_.continue_as(way.photon, way.medium, way.ray_start);
            path() = way.path;
            goes_on = follow<true>(way.hit, way.scattering, kept);
            return true;
        } else {
            return false;
        }
    }

    /// Carries out one scattering at a surface.
    ///
    /// @tparam is_weighted  whether the photon's flux is already the way's share
    template <bool is_weighted, class Scattering>
    [[nodiscard]] bool follow(const H& hit, const Scattering& scattering, Kept& kept) {
        if (scattering.event == Event::pass) {
            if (passed_++ == most_passed)
                return steps_.end(Fate::terminated);
            steps_.enter_medium(scattering);
            leave(hit, true);
            return true;
        }
        const bool is_diffuse = scattering.event == Event::deposit || scattering.event == Event::diffuse;
        const bool is_opaque = is_diffuse || scattering.event == Event::absorb;
        if (steps_.ray_start().began_here()) {
            // A lamp may stand in the scene; its photons start on its surface and leave that first.
            if (path().is_direct() && passed_ == 0 && (is_opaque || !steps_.is_in_front_of(hit)) &&
                lamp_surfaces_ < most_lamp_surfaces) {
                ++lamp_surfaces_;
                leave(hit, true);
                return true;
            }
            if constexpr (!LetsSurfacesTouch<S, V>)
                ++account_.hits_at_start;
        }
        if (path().is_direct() && is_opaque)
            ++account_.opaque_first;
        if (scattering.event == Event::absorb)
            return steps_.end(Fate::absorbed);
        if (is_diffuse)
            return deposit(hit, scattering, kept);
        if (path().specular_events == limits_.specular_events)
            return steps_.end(Fate::terminated);
        const bool from_front = steps_.is_in_front_of(hit);
        if constexpr (!is_weighted)
            if (!steps_.scale_flux(scattering.weight) || (all_ways && !steps_.carries_enough(limits_.least_share)))
                return false;
        if (!steps_.turn(hit, scattering))
            return false;
        ++path().specular_events;
        const bool passed = steps_.is_in_front_of(hit) == from_front;
        reporter_.surface(hit, from_front, passed);
        if constexpr (!all_ways)
            if (path().specular_events >= limits_.roulette_after && !steps_.survives_roulette(sampler_))
                return false;
        leave(hit, passed);
        return true;
    }

    /// Leaves a deposit on a diffuse surface.
    template <class Scattering>
    [[nodiscard]] bool deposit(const H& hit, const Scattering& scattering, Kept& kept) {
        const DiffuseSurface<S, V, F, N, Visitor> surface(steps_, reporter_, limits_, account_);
        const Departing departing = surface.meet(hit, scattering, sampler_, kept);
        if (departing.goes_on)
            leave(hit, departing.passes);
        return departing.goes_on;
    }

    void leave(const H& hit, bool passed) {
        reporter_.departure(steps_, hit);
        steps_.leave(hit, passed);
    }

    [[nodiscard]] auto& path() { return reporter_.path(); }

    const S& scene_;
    Sampler& sampler_;
    const WalkLimits& limits_;
    Statistics& account_;
    PhotonSteps<S, V, F, N> steps_;
    VisitReporter<S, V, F, N, Visitor> reporter_;
    [[no_unique_address]] typename pending_ways_of<S, V, F, N, trail_t<Visitor>, branches>::type pending_{};
    unsigned lamp_surfaces_ = 0, passed_ = 0, edges_ = 0;
};

} // namespace nephroid::detail
