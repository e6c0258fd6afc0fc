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

namespace detail {
/// The scene's `scatter_all` takes the medium that the photon arrives through.
template <class S, class H, class V, class Medium>
concept ScattersAllIn = requires(const S& scene, const H& hit, const V& v, const Medium& medium) {
    scene.scatter_all(hit, v, medium);
};
template <class S, class H, class V>
concept ScattersAllAnywhere = requires(const S& scene, const H& hit, const V& v) {
    scene.scatter_all(hit, v);
};

/// Calls the scene's `scatter_all`, with the photon's medium if it takes that.
template <class S, class H, class V, class Medium>
    requires(ScattersAllIn<S, H, V, Medium> || ScattersAllAnywhere<S, H, V>)
[[nodiscard]] decltype(auto) scatter_all_in([[maybe_unused]] const Medium& medium, const S& scene, const H& hit,
                                            const V& direction) {
    if constexpr (ScattersAllIn<S, H, V, Medium>)
        return scene.scatter_all(hit, direction, medium);
    else
        return scene.scatter_all(hit, direction);
}
} // namespace detail

/// Optional: `scene.scatter_all(hit, direction)` returns all ways that light takes at a surface, as `Ways` or any type
/// with size() and [i]. An optional third parameter gets the `medium` that the photon arrives through; it has to be
/// there if `scatter` takes the medium. A way is what `scatter` returns, except that its weight is the share of the
/// light that goes this way, not divided by a probability. No ways mean absorption. Shares of several ways that are
/// negative or add up to more than 1.001 make the photon invalid, in each band of a flux that is a vector, else of its
/// power. If an Event::deposit is one of several ways, its weight is deposited.
/// The result must not depend on chance, because methods that compare neighbouring photons rely on it.
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
concept ScattersAllWays = RayTracer<S, V> && requires(const S& scene, const hit_t<S, V>& hit, const V& direction,
                                                      const typename detail::medium_of<S, V>::type& medium) {
    { detail::scatter_all_in(medium, scene, hit, direction).size() } -> std::convertible_to<std::size_t>;
    { detail::scatter_all_in(medium, scene, hit, direction)[std::size_t(0)].event } -> std::convertible_to<Event>;
    {detail::scatter_all_in(medium, scene, hit, direction)[std::size_t(0)].weight};
};

namespace detail {
/// The scene's `scatter` takes the medium, but its `scatter_all` does not, so that both would disagree under water.
template <class S, class V, class Sampler>
concept ForgetsMediumInAllWays =
    ScattersAllWays<S, V> && !ScattersAllIn<S, hit_t<S, V>, V, typename medium_of<S, V>::type> &&
    requires(const S& scene, const hit_t<S, V>& hit, const V& v, Sampler& sampler,
             const typename medium_of<S, V>::type& medium) {
    scene.scatter(hit, v, sampler, medium);
};

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
