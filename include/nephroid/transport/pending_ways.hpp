// SPDX-License-Identifier: MIT
/// @file  The stack of ways that a photon has yet to take, for visitors that follow all ways.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/transport/photon_steps.hpp"
#include "nephroid/transport/trail.hpp"
#include "nephroid/transport/value_checks.hpp"
#include "nephroid/transport/walk_limits.hpp"
#include "nephroid/transport/ways.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace nephroid::detail {

/// A way that a photon takes later: the photon on the surface where the ways part, with this way's share of the flux.
template <class P, class Medium, class Start, class Trail, class H, class Scattering>
struct PendingWay {
    P photon;
    [[no_unique_address]] Medium medium;
    Start ray_start; ///< of the ray that arrived at the surface
    WalkedPath<Trail> path;
    H hit;
    Scattering scattering;
};

/// The pending ways of one photon. The last one pushed is taken first, so that the stack holds only the ways that part
/// from one path.
template <class Way>
class PendingWays {
public:
    /// Divides a photon's flux among all ways at a surface. The photon keeps the first way's share, and the other ways
    /// are pushed. What no way carries is booked as absorbed, and ways without enough flux or room as terminated.
    ///
    /// @param steps  the photon, at the hit
    /// @param path   up to the hit
    /// @param ways   at least two, see `ScattersAllWays`
    /// @return  whether the first way carries enough flux to be followed
    template <class Steps, class Path, class H, class List>
    [[nodiscard]] bool split(Steps& steps, const Path& path, const H& hit, const List& ways, const WalkLimits& limits,
                             Statistics& account) {
        const std::size_t count = std::size_t(ways.size());
        const auto arrived = steps.photon().flux;
        using F = std::remove_const_t<decltype(arrived)>;
        double absorbed = steps.power(arrived);
        F leaving = flux_traits<F>::zero();
        bool is_negative = false;
        for (std::size_t i = 0; i < count; ++i) {
            const F share = arrived * ways[i].weight;
            leaving = leaving + share;
            is_negative = is_negative || has_negative_band(share);
            absorbed -= steps.power(share);
        }
        constexpr double most = 1.001; // more than that is no rounding: the shares add up to more than 1
        if (is_negative || !isfinite(absorbed) || has_band_above(leaving, arrived, most))
            return steps.end(Fate::invalid);
        account.lose(Fate::absorbed, absorbed);
        account.branches += count - 1;
        for (std::size_t i = count; i-- > 1;) { // from the last, so that the second way is taken next
            steps.set_flux(arrived * ways[i].weight);
            if (!steps.carries_enough(limits.least_share))
                continue;
            if (pushed_ < limits.branches &&
                push({steps.photon(), steps.medium(), steps.ray_start(), path, hit, ways[i]}))
                ++pushed_;
            else
                (void)steps.end(Fate::terminated);
        }
        steps.set_flux(arrived * ways[0].weight);
        return steps.carries_enough(limits.least_share);
    }

    [[nodiscard]] bool empty() const { return size_ == 0; }
    /// Removes and returns the last way pushed; there must be one.
    [[nodiscard]] Way pop() { return *ways_[--size_]; }

private:
    static constexpr std::size_t capacity = 64;

    /// @return  false if the stack is full
    [[nodiscard]] bool push(const Way& way) {
        if (size_ == capacity)
            return false;
        ways_[size_++].emplace(way);
        return true;
    }

    std::array<std::optional<Way>, capacity> ways_;
    std::size_t size_ = 0;
    unsigned pushed_ = 0; ///< in the whole walk
};

/// In place of PendingWays, if a photon takes one way only.
struct NoPendingWays {};

template <class S, class V, class F, std::size_t N, class Trail, bool branches>
struct pending_ways_of {
    using type = NoPendingWays;
};
template <class S, class V, class F, std::size_t N, class Trail>
struct pending_ways_of<S, V, F, N, Trail, true> {
    using Medium = typename medium_of<S, V>::type;
    using Scattering =
        std::remove_cvref_t<decltype(scatter_all_in(std::declval<const Medium&>(), std::declval<const S&>(),
                                                    std::declval<const hit_t<S, V>&>(), std::declval<const V&>())[0])>;
    using type = PendingWays<PendingWay<Photon<V, F, N>, Medium, RayStart<S, V>, Trail, hit_t<S, V>, Scattering>>;
};

} // namespace nephroid::detail
