// SPDX-License-Identifier: MIT
/// @file  All ways that light takes at a surface, for scenes that can return them instead of choosing one by chance.
#pragma once

#include "nephroid/transport/scene.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <type_traits>

namespace nephroid {

/// A few scatterings, in the order in which a walk follows them.
template <class Scattering, std::size_t Capacity = 2>
class Ways {
public:
    using value_type = Scattering;

    constexpr Ways() = default;
    /// One way.
    constexpr Ways(const Scattering& only) : ways_{only}, size_(1) {}
    /// Two ways, such as what glass reflects and what it refracts.
    constexpr Ways(const Scattering& first, const Scattering& second) requires(Capacity >= 2)
        : ways_{first, second}, size_(2) {}

    /// Adds a way; there must be room for it.
    constexpr void add(const Scattering& way) {
        assert(size_ < Capacity);
        ways_[size_++] = way;
    }
    [[nodiscard]] constexpr std::size_t size() const { return size_; }
    [[nodiscard]] constexpr const Scattering& operator[](std::size_t i) const { return ways_[i]; }

private:
    std::array<Scattering, Capacity> ways_{};
    std::size_t size_ = 0;
};

/// Optional: `scene.scatter_all(hit, direction)` returns all ways that light takes at a surface, as `Ways` or any type
/// with size() and [i]. A way is what `scatter` returns, except that its weight is the share of the light that goes
/// this way, not divided by a probability. No ways mean absorption. If an Event::deposit is one of several ways, its
/// weight is deposited. The result must not depend on chance, because methods that compare neighbouring photons rely
/// on it.
///
/// ```cpp
/// nephroid::Ways<Scattering> scatter_all(const MyHit& hit, const Vec3& direction) const {
///     if (hit.material->is_diffuse())
///         return Scattering::deposit();
///     const float reflectance = fresnel(hit, direction);
///     return {Scattering::reflect(reflectance), Scattering::refract(1 - reflectance, eta(hit, direction))};
/// }
/// ```
template <class S, class V>
concept ScattersAllWays = RayTracer<S, V> && requires(const S& scene, const hit_t<S, V>& hit, const V& direction) {
    { scene.scatter_all(hit, direction).size() } -> std::convertible_to<std::size_t>;
    { scene.scatter_all(hit, direction)[std::size_t(0)].event } -> std::convertible_to<Event>;
    {scene.scatter_all(hit, direction)[std::size_t(0)].weight};
};

namespace detail {
/// The scene declares `static constexpr bool scatters_by_chance = false`: its `scatter` draws no numbers, and the way
/// that it returns is the only one.
template <class S>
concept ScattersOneWay = requires {
    requires !bool(std::bool_constant<S::scatters_by_chance>::value);
};
} // namespace detail

/// A scene in which all ways of light can be followed, so that a photon's paths are a function of where it was emitted.
/// A scene with nothing but `scatter` may choose a way by chance.
template <class S, class V>
concept ScattersDeterministically = ScattersAllWays<S, V> || detail::ScattersOneWay<S>;

} // namespace nephroid
