// SPDX-License-Identifier: MIT
/// @file  The scene: a renderer's functions that intersect rays with surfaces and scatter light there.
#pragma once

#include "nephroid/transport/hit.hpp"
#include "nephroid/transport/scattering.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace nephroid {

/// `scene.intersect(origin, direction, t_min, t_max)` returns the nearest hit with t_min < distance < t_max, as a
/// std::optional or any type that is used like one. Called from several threads at once.
template <class S, class V>
concept Intersects = Vector3<V> && requires(const S& scene, const V& v, scalar_t<V> t) {
    {bool(scene.intersect(v, v, t, t))};
    {*scene.intersect(v, v, t, t)};
};

template <class S, class V>
using hit_t = std::remove_cvref_t<decltype(*std::declval<const S&>().intersect(
    std::declval<const V&>(), std::declval<const V&>(), scalar_t<V>(0), scalar_t<V>(1)))>;

/// Optional: `scene.spawn(hit, direction)` returns the origin of a new ray, if the renderer has a method of its own.
template <class S, class V>
concept SpawnsRays = Intersects<S, V> && requires(const S& scene, const hit_t<S, V>& hit, const V& direction) {
    { scene.spawn(hit, direction) } -> std::convertible_to<V>;
};

/// A new ray must not hit the surface that it leaves. So either hits have a `position_error`, or the scene has `spawn`.
template <class S, class V>
concept KeepsRaysOffSurfaces = SpawnsRays<S, V> || HasPositionError<hit_t<S, V>, V>;

/// Optional: `scene.tracer_epsilon` is the distance from a ray's origin within which the renderer's tracer finds
/// nothing, whatever t_min is (world units, >= 0; usually 0.001). The walk then begins its rays further back along
/// their line by this distance, so that no surface is skipped: neither the table under a glass nor a surface near the
/// lamp.
template <class S, class V>
concept HasTracerEpsilon = requires(const S& scene) {
    { scene.tracer_epsilon } -> std::convertible_to<scalar_t<V>>;
};

/// All that photons without tangents need. For others, hits also need a `curvature` (`Hit`).
template <class S, class V>
concept RayTracer =
    Intersects<S, V> && HasDistance<hit_t<S, V>, V> && HasGeometricNormal<hit_t<S, V>, V> && KeepsRaysOffSurfaces<S, V>;

/// Optional, for absorption: `typename S::medium` describes the medium that a photon flies through (value-initialised
/// at emission), and `scene.transmittance(medium, distance)` is the share of the flux that passes. Scenes without these
/// members pay nothing. If media touch or overlap, `medium` may be `Media` (transport/media.hpp).
template <class S, class V>
concept Absorbs = requires(const S& scene, const typename S::medium& medium, scalar_t<V> distance) {
    {scene.transmittance(medium, distance)};
};

/// Optional: `scene.medium_at(position)` is the medium at a lamp, for scenes with lamps under water. It is called for
/// each photon, so a scene should compute it once for each lamp.
template <class S, class V>
concept KnowsMediumOfLamps = Absorbs<S, V> && requires(const S& scene, const V& position) {
    { scene.medium_at(position) } -> std::convertible_to<typename S::medium>;
};

namespace detail {
/// The medium of scenes without absorption.
struct NoMedium {};

template <class S, class V>
struct medium_of {
    using type = NoMedium;
};
template <class S, class V>
    requires Absorbs<S, V>
struct medium_of<S, V> {
    using type = typename S::medium;
};

/// Calls the scene's `scatter`, with the photon's medium if `scatter` takes it.
template <class S, class H, class V, class Sampler, class Medium>
    requires requires(const S& scene, const H& hit, const V& v, Sampler& sampler, const Medium& medium) {
        scene.scatter(hit, v, sampler, medium);
    }
[[nodiscard]] auto scatter_in(const Medium& medium, const S& scene, const H& hit, const V& direction,
                              Sampler& sampler) {
    return scene.scatter(hit, direction, sampler, medium);
}
template <class S, class H, class V, class Sampler, class Medium>
    requires(!requires(const S& scene, const H& hit, const V& v, Sampler& sampler, const Medium& medium) {
        scene.scatter(hit, v, sampler, medium);
    })
&&requires(const S& scene, const H& hit, const V& v, Sampler& sampler) { scene.scatter(hit, v, sampler); }
[[nodiscard]] auto scatter_in(const Medium&, const S& scene, const H& hit, const V& direction, Sampler& sampler) {
    return scene.scatter(hit, direction, sampler);
}
} // namespace detail

/// `scene.scatter(hit, direction, sampler)` returns what the surface does with a photon that arrives along the unit
/// direction: a `Scattering` or a type like it. `sampler.template next<T>()` draws random numbers for its choices. An
/// optional fourth parameter gets the `medium` that the photon arrives through. A photon's parameters (its wavelength)
/// come last, in this and in the other functions, where they take them (transport/parametric_scene.hpp).
template <class S, class V, class Sampler>
concept Scatters = RayTracer<S, V> && requires(const S& scene, const hit_t<S, V>& hit, const V& v, Sampler& sampler,
                                               const typename detail::medium_of<S, V>::type& medium) {
    { detail::scatter_in(medium, scene, hit, v, sampler).event } -> std::convertible_to<Event>;
    {detail::scatter_in(medium, scene, hit, v, sampler).weight};
    requires !detail::refracts<decltype(detail::scatter_in(medium, scene, hit, v, sampler))> || requires {
        { detail::scatter_in(medium, scene, hit, v, sampler).eta } -> std::convertible_to<scalar_t<V>>;
    };
};

namespace detail {
/// The third parameter of a member function.
template <class Result, class S, class A, class B, class C>
C third_parameter(Result (S::*)(A, B, C) const);

/// `scatter` takes its sampler as a const reference, from which no numbers can be drawn.
template <class S, class Sampler>
concept DrawsFromConst = requires {
    { third_parameter(&S::template scatter<Sampler>) } -> std::same_as<const Sampler&>;
};
} // namespace detail

/// All that a photon's walk needs, in one object: a renderer's scene, or a small struct that points to it.
///
/// Coordinates in float are exact to a ten-millionth of their distance from the origin. A caustic of the size of one
/// unit is noisy 1,000 units away from the origin, off by a tenth at 10,000 and by 40% at 100,000. So a scene's origin
/// should be in its middle.
///
/// ```cpp
/// struct Adapter {
///     const MyScene& scene;
///
///     std::optional<MyHit> intersect(const Vec3& origin, const Vec3& direction, float t_min, float t_max) const {
///         MyRecord record;
///         if (!scene.hit(MyRay(origin, direction), t_min, t_max, record))
///             return std::nullopt;
///         return MyHit(record); // transport/hit.hpp
///     }
///     nephroid::Scattering<Colour, float> scatter(const MyHit& hit, const Vec3& direction, auto& random) const {
///         if (hit.material->is_diffuse())
///             return nephroid::Scattering<Colour, float>::deposit(); // transport/scattering.hpp
///         return nephroid::Scattering<Colour, float>::reflect(hit.material->tint);
///     }
/// };
/// ```
///
/// @tparam N  tangents of the photons; with none, hits need no `curvature`
template <class S, class V, class Sampler, std::size_t N = 2>
concept Scene = RayTracer<S, V> && Scatters<S, V, Sampler> &&
    (N == 0 || Hit<hit_t<S, V>, V>)&&!detail::DrawsFromConst<S, Sampler>;

namespace detail {
/// Says what a scene lacks, in the first line of the compiler's message.
template <class S, class V, class Sampler, std::size_t N>
consteval bool explain_scene() {
    static_assert(Intersects<S, V>, "nephroid: the scene lacks intersect(origin, direction, t_min, t_max) const -> an "
                                    "optional hit (transport/scene.hpp)");
    if constexpr (Intersects<S, V>) {
        using H = hit_t<S, V>;
        static_assert(HasDistance<H, V>, "nephroid: the scene's hit lacks `distance` (transport/hit.hpp)");
        static_assert(HasGeometricNormal<H, V>,
                      "nephroid: the scene's hit lacks `geometric_normal` (transport/hit.hpp)");
        static_assert(N == 0 || HasCurvature<H, V>,
                      "nephroid: the scene's hit lacks `curvature`, which says how its normal changes; "
                      "nephroid::Flat is the answer for planes alone (differential/curvature.hpp)");
        static_assert(KeepsRaysOffSurfaces<S, V>, "nephroid: the scene's hit lacks `position_error`, or the scene "
                                                  "spawn(hit, direction) const (transport/scene.hpp)");
        if constexpr (KeepsRaysOffSurfaces<S, V>) // otherwise Scatters fails for that reason
            static_assert(Scatters<S, V, Sampler>,
                          "nephroid: the scene lacks scatter(hit, direction, sampler) const -> event, "
                          "weight, eta (transport/scattering.hpp)");
        static_assert(!DrawsFromConst<S, Sampler>,
                      "nephroid: the scene's scatter takes its sampler as const, and so can draw no numbers from it; "
                      "take it as `auto& random`");
    }
    return false;
}

/// Scene, or an error that says why not; for functions without overloads, where a wrong type can only be a mistake.
template <class S, class V, class Sampler, std::size_t N = 2>
concept MustBeScene = Scene<S, V, Sampler, N> || explain_scene<S, V, Sampler, N>();
} // namespace detail

} // namespace nephroid
