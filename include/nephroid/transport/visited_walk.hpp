// SPDX-License-Identifier: MIT
/// @file  The loop of a photon's walk: flights, surfaces, and ways that part; what the visitor does not ask for is left
///        out of it. (A few lines longer than other headers: it is one loop.)
#pragma once

#include "nephroid/transport/account.hpp"
#include "nephroid/transport/photon_steps.hpp"
#include "nephroid/transport/visitor.hpp"
#include "nephroid/transport/waiting_ways.hpp"
#include "nephroid/transport/walk_limits.hpp"
#include "nephroid/vector/in_place.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

namespace nephroid::detail {

/// One photon's walk, all its ways one after the other.
template <class S, Vector3 V, Flux F, std::size_t N, class Sampler, class Visitor>
class VisitedWalk {
public:
    using T = scalar_t<V>;
    using H = hit_t<S, V>;
    using Kept = std::optional<Deposit<V, F, N>>;

    VisitedWalk(const S& scene, Photon<V, F, N>& photon, Sampler& sampler, const WalkLimits& limits,
                Statistics& account, Visitor& visitor)
        : scene_(scene), sampler_(sampler), limits_(limits), account_(account), visitor_(visitor),
          steps_(scene, photon, account) {
        if constexpr (tells_flights)
            departure_ = {photon.position, std::nullopt};
    }

    /// @param kept  gets the deposit where the visitor takes none
    void run(Kept& kept) {
        if (!steps_.start())
            return;
        bool goes_on = true;
        do {
            while (goes_on)
                goes_on = fly(kept);
        } while (next_way(kept, goes_on));
    }

private:
    static constexpr bool tells_flights = VisitsFlights<Visitor, V, F, N>;
    static constexpr bool tells_deposits = VisitsDeposits<Visitor, V, F, N>;
    static constexpr bool all_ways = follows_all_ways<Visitor>;
    static constexpr bool may_part = all_ways && ScattersAllWays<S, V>;
    static constexpr unsigned most_lamp_surfaces = 4; // of both sides of its sheets; more are the tracer's mistake
    static constexpr unsigned most_passed = 1000; // false surfaces; a tracer that finds one again and again has no end
    static constexpr unsigned most_edges = 64;    // as above; a ray through a vertex meets as many triangles
    using waiting_t = typename waiting_of<S, V, F, N, trail_t<Visitor>, may_part>::type;

    /// To the next surface, and off it again. @return  whether the photon goes on
    [[nodiscard]] bool fly(Kept& kept) {
        const Photon<V, F, N>& now = steps_.photon();
        if (!all_finite(now.position) || !all_finite(now.direction))
            return steps_.end(Fate::invalid);
        ++account_.rays;
        const auto hit = steps_.next_hit();
        if (hit && steps_.is_on_edge(*hit))
            return edges_++ < most_edges || steps_.end(Fate::terminated);
        if constexpr (tells_flights) {
            const T distance = hit ? T((*hit).distance) : std::numeric_limits<T>::infinity();
            const std::optional<V> end_normal = hit ? std::optional<V>(steps_.facing_normal(*hit)) : std::nullopt;
            // Less than 0 by rounding, where surfaces touch.
            const T length = (std::max)(steps_.ray_start().from_surface(distance), T(0));
            visitor_.flight(departure_.flight(now, length, end_normal, path_));
        }
        if (!hit) {
            account_.escaped_first += path_.is_direct();
            return steps_.end(Fate::escaped);
        }
        if (!steps_.fly_to(*hit))
            return false;
        if constexpr (may_part)
            return part(*hit, scene_.scatter_all(*hit, now.direction), kept);
        else
            return take<false>(*hit, scatter_in(steps_.medium(), scene_, *hit, now.direction, sampler_), kept);
    }

    /// @tparam weighed  whether the photon's flux is the way's share already
    template <bool weighed, class Scattering>
    [[nodiscard]] bool take(const H& hit, const Scattering& scattering, Kept& kept) {
        if (scattering.event == Event::pass) {
            if (passed_++ == most_passed)
                return steps_.end(Fate::terminated);
            steps_.enter(scattering);
            leave(hit, true);
            return true;
        }
        const bool is_opaque = scattering.event == Event::absorb || scattering.event == Event::deposit;
        if (steps_.ray_start().began_here()) {
            if (path_.is_direct() && passed_ == 0 && (is_opaque || !steps_.is_in_front_of(hit)) &&
                lamp_surfaces_ < most_lamp_surfaces)
                return leave_lamp(hit);
            if constexpr (!LetsSurfacesTouch<S, V>)
                ++account_.hits_at_start;
        }
        if (path_.is_direct() && is_opaque)
            ++account_.opaque_first;
        if (scattering.event == Event::absorb)
            return steps_.end(Fate::absorbed);
        if (scattering.event == Event::deposit)
            return deposit(hit, kept);
        if (path_.specular_events == limits_.specular_events)
            return steps_.end(Fate::terminated);
        const bool from_front = steps_.is_in_front_of(hit);
        if constexpr (!weighed)
            if (!steps_.weigh(scattering.weight) || (all_ways && !steps_.carries_enough(limits_.least_share)))
                return false;
        if (!steps_.bend(hit, scattering))
            return false;
        ++path_.specular_events;
        const bool passed = steps_.is_in_front_of(hit) == from_front;
        tell_of(hit, from_front, passed);
        if constexpr (!all_ways)
            if (path_.specular_events >= limits_.roulette_after && !steps_.survives_roulette(sampler_))
                return false;
        leave(hit, passed);
        return true;
    }

    [[nodiscard]] bool deposit(const H& hit, Kept& kept) {
        if constexpr (!wants_direct_light<Visitor>)
            if (path_.is_direct())
                return steps_.end(Fate::direct);
        tell_of(hit, steps_.is_in_front_of(hit), false);
        if constexpr (SendsPhotonsOn<Visitor, V, F, N>) {
            const std::optional<Photon<V, F, N>> onwards = visitor_.deposit(steps_.deposit(hit), path_);
            return onwards && go_on(hit, *onwards);
        } else if constexpr (tells_deposits) {
            visitor_.deposit(steps_.deposit(hit), path_);
        } else {
            kept.emplace(InPlace{[&] { return steps_.deposit(hit); }});
        }
        return false;
    }

    /// From a diffuse surface, as the visitor says.
    [[nodiscard]] bool go_on(const H& hit, const Photon<V, F, N>& onwards) {
        const bool from_front = steps_.is_in_front_of(hit);
        const double arrived = steps_.power(steps_.photon().flux), carried = steps_.power(onwards.flux);
        if (!isfinite(carried))
            return steps_.end(Fate::invalid);
        account_.lose(Fate::absorbed, arrived - carried);
        steps_.become(onwards, steps_.medium());
        if (path_.bounces == limits_.bounces)
            return steps_.end(Fate::terminated);
        ++path_.bounces;
        leave(hit, steps_.is_in_front_of(hit) == from_front);
        return true;
    }

    /// Each way gets its share of the flux: the first goes on at once, the others wait.
    template <class List>
    [[nodiscard]] bool part(const H& hit, const List& ways, Kept& kept) {
        const std::size_t count = std::size_t(ways.size());
        if (count == 0)
            return steps_.end(Fate::absorbed);
        if (count == 1)
            return take<false>(hit, ways[0], kept);
        const F arrived = steps_.photon().flux;
        double left = steps_.power(arrived);
        for (std::size_t i = 0; i < count; ++i)
            left -= steps_.power(arrived * ways[i].weight);
        if (!isfinite(left))
            return steps_.end(Fate::invalid);
        account_.lose(Fate::absorbed, left);
        account_.branches += count - 1;
        for (std::size_t i = count; i-- > 1;) { // the last waits longest
            steps_.carry(arrived * ways[i].weight);
            if (!steps_.carries_enough(limits_.least_share))
                continue;
            if (followed_ < limits_.branches &&
                waiting_.push({steps_.photon(), steps_.medium(), steps_.ray_start(), path_, hit, ways[i]}))
                ++followed_;
            else
                (void)steps_.end(Fate::terminated);
        }
        steps_.carry(arrived * ways[0].weight);
        return steps_.carries_enough(limits_.least_share) && take<true>(hit, ways[0], kept);
    }

    /// Goes back to the last surface where ways parted. @return  false if none waits
    [[nodiscard]] bool next_way([[maybe_unused]] Kept& kept, [[maybe_unused]] bool& goes_on) {
        if constexpr (may_part) {
            if (waiting_.empty())
                return false;
            const auto way = waiting_.pop();
            steps_.become(way.photon, way.medium, way.ray_start);
            path_ = way.path;
            goes_on = take<true>(way.hit, way.scattering, kept);
            return true;
        } else {
            return false;
        }
    }

    /// Off the surface of the lamp itself, which stands in the scene: the photon begins on it.
    [[nodiscard]] bool leave_lamp(const H& hit) {
        ++lamp_surfaces_;
        leave(hit, true);
        return true;
    }

    void tell_of(const H& hit, bool from_front, bool passed) {
        path_.trail.meet(hit, from_front, passed);
        if constexpr (VisitsSurfaces<Visitor, H>)
            visitor_.meet(hit, from_front, passed);
    }

    void leave(const H& hit, bool passed) {
        if constexpr (tells_flights) // the normal on the side that the photon leaves to
            departure_ = {steps_.photon().position, -steps_.facing_normal(hit)};
        steps_.leave(hit, passed);
    }

    const S& scene_;
    Sampler& sampler_;
    const WalkLimits& limits_;
    Statistics& account_;
    Visitor& visitor_;
    PhotonSteps<S, V, F, N> steps_;
    WalkedPath<trail_t<Visitor>> path_{};
    [[no_unique_address]] std::conditional_t<tells_flights, Departure<V>, NoDeparture> departure_{};
    [[no_unique_address]] waiting_t waiting_{};
    unsigned followed_ = 0;
    unsigned lamp_surfaces_ = 0, passed_ = 0, edges_ = 0;
};

} // namespace nephroid::detail
