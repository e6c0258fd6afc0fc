// SPDX-License-Identifier: MIT
/// @file  What a walk remembers of its path: nothing, or a signature of the surfaces that the path met.
#pragma once

#include "nephroid/transport/account.hpp"

#include <concepts>
#include <cstdint>

namespace nephroid {

/// A hash of a path that is equal for two paths if they met the same surfaces, from the same sides, and went the same
/// ways there. Such paths lie on one smooth sheet of the caustic, so that their difference approximates a derivative.
/// Surfaces are distinguished by `hit.surface`, if hits have it: it should number smooth surfaces, not triangles.
///
/// It can be a visitor by itself, for walks that end in one deposit, or the `trail` of a visitor.
class PathSignature {
public:
    /// @param from_front  whether the photon came from the side that the geometric normal points to
    /// @param passed      whether the photon goes on through the surface
    template <class Hit>
    void meet(const Hit& hit, bool from_front, bool passed) {
        add(std::uint32_t(from_front) | std::uint32_t(passed) << 1);
        if constexpr (requires {
                          { hit.surface } -> std::convertible_to<std::uint64_t>;
                      })
            add(std::uint64_t(hit.surface));
    }

    [[nodiscard]] std::uint32_t value() const { return hash_; }

private:
    void add(std::uint64_t number) {
        add(static_cast<std::uint32_t>(number));
        add(static_cast<std::uint32_t>(number >> 32));
    }

    // Fowler, Noll and Vo's hash, a word at a time, with the high bits folded in.
    void add(std::uint32_t word) {
        hash_ = (hash_ ^ word) * 16777619u;
        hash_ ^= hash_ >> 15;
    }

    std::uint32_t hash_ = 2166136261u;
};

/// Remembers nothing, and costs nothing.
struct NoTrail {
    template <class Hit>
    void meet(const Hit&, bool /*from_front*/, bool /*passed*/) const {}
};

/// A path up to where a photon is.
template <class Trail = NoTrail>
struct WalkedPath {
    unsigned specular_events = 0; ///< reflections and refractions since the lamp
    unsigned diffuse_bounces = 0; ///< diffuse surfaces that the photon went on from
    [[no_unique_address]] Trail trail{};

    /// Whether the photon has come straight from the lamp.
    [[nodiscard]] bool is_direct() const { return specular_events == 0 && diffuse_bounces == 0; }
    /// As what its light arrives where it is.
    [[nodiscard]] Arrival arrival() const {
        return diffuse_bounces > 0 ? Arrival::indirect : specular_events > 0 ? Arrival::caustic : Arrival::direct;
    }
};

} // namespace nephroid
