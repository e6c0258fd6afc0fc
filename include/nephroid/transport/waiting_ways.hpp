// SPDX-License-Identifier: MIT
/// @file  Ways that a photon has yet to take, where it follows all of them.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/transport/ray_start.hpp"
#include "nephroid/transport/trail.hpp"
#include "nephroid/transport/ways.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <utility>

namespace nephroid::detail {

/// A way that waits: the photon on the surface where ways part, its flux the way's share.
template <class P, class Medium, class Start, class Trail, class H, class Scattering>
struct WaitingWay {
    P photon;
    [[no_unique_address]] Medium medium;
    Start ray_start; ///< of the ray that came here
    WalkedPath<Trail> path;
    H hit;
    Scattering scattering;
};

/// The one that came last is followed first: what waits at a time are the ways that part from one path.
template <class Way>
class WaitingWays {
public:
    /// @return  false if there is no room for it
    [[nodiscard]] bool push(const Way& way) {
        if (size_ == capacity)
            return false;
        ways_[size_++].emplace(way);
        return true;
    }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    /// There must be one.
    [[nodiscard]] Way pop() { return *ways_[--size_]; }

private:
    static constexpr std::size_t capacity = 64;

    std::array<std::optional<Way>, capacity> ways_;
    std::size_t size_ = 0;
};

/// Where ways do not part.
struct NoWays {};

template <class S, class V, class F, std::size_t N, class Trail, bool may_part>
struct waiting_of {
    using type = NoWays;
};
template <class S, class V, class F, std::size_t N, class Trail>
struct waiting_of<S, V, F, N, Trail, true> {
    using Scattering = std::remove_cvref_t<decltype(std::declval<const S&>().scatter_all(
        std::declval<const hit_t<S, V>&>(), std::declval<const V&>())[0])>;
    using Medium = typename medium_of<S, V>::type;
    using type = WaitingWays<WaitingWay<Photon<V, F, N>, Medium, RayStart<S, V>, Trail, hit_t<S, V>, Scattering>>;
};

} // namespace nephroid::detail
