// SPDX-License-Identifier: MIT
/// @file  All ways that light takes at a surface: what a scene may tell besides one of them by chance.
#pragma once

#include "nephroid/transport/scene.hpp"

#include <array>
#include <cassert>
#include <cstddef>
#include <type_traits>

namespace nephroid {

/// A few scatterings, in the order in which they are to be followed.
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

    /// There must be room for it.
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

/// Optional: `scene.scatter_all(hit, direction)` gives all ways that light takes at a surface, as `Ways` or anything
/// else with size() and [i]; a way is what `scatter` would return, but that its weight is the share of light that takes
/// it, over no probability. None is absorption. A way of Event::deposit that is not the only one deposits its weight's
/// share. The result must not depend on chance: methods that compare neighbouring photons rely on it.
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

/// The scene's `scatter` draws no numbers and says so, `static constexpr bool scatters_by_chance = false`: then the one
/// way that it returns is all ways.
template <class S>
concept ScattersOneWay = requires {
    requires !bool(std::bool_constant<S::scatters_by_chance>::value);
};

/// Whether all ways of light in a scene can be followed, so that a photon's path is a function of where it was emitted.
/// A scene with `scatter` alone may choose a way by chance.
template <class S, class V>
concept TellsAllWays = ScattersAllWays<S, V> || ScattersOneWay<S>;

} // namespace nephroid
