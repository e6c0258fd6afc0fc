// SPDX-License-Identifier: MIT
/// @file  What is noted of a path on its way: nothing, or a signature of the surfaces that it met.
#pragma once

#include "nephroid/vector/language.hpp"

#include <concepts>
#include <cstdint>

namespace nephroid {

/// A number that two paths share if they met the same surfaces, on the same sides, and went the same ways: then they
/// are neighbours on one smooth sheet of the caustic, and their difference is a derivative. Surfaces are told apart by
/// `hit.surface`, where a hit has that: it should name a smooth surface, not one of its triangles.
///
/// A visitor by itself, for a walk that ends in one deposit, and a visitor's `trail`.
class PathSignature {
public:
    /// @param from_front  whether the photon came from the side that the geometric normal points to
    /// @param passed      whether it went on through the surface
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

/// Notes nothing, and costs nothing.
struct NoTrail {
    template <class Hit>
    void meet(const Hit&, bool /*from_front*/, bool /*passed*/) const {}
};

/// A path up to where a photon is.
template <class Trail = NoTrail>
struct WalkedPath {
    unsigned specular_events = 0; ///< reflections and refractions since the lamp
    unsigned bounces = 0;         ///< diffuse surfaces that the photon went on from
    [[no_unique_address]] Trail trail{};

    /// Whether it came from the lamp straight away.
    [[nodiscard]] bool is_direct() const { return specular_events == 0 && bounces == 0; }
};

} // namespace nephroid
