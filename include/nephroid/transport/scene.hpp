// SPDX-License-Identifier: MIT
/// @file  What the library asks of a renderer's scene: rays that hit, and surfaces that scatter.
#pragma once

#include "nephroid/transport/hit.hpp"
#include "nephroid/transport/scattering.hpp"

namespace nephroid {

/// `scene.intersect(origin, direction, t_min, t_max)`: the nearest hit with t_min < distance < t_max, as anything
/// that reads like std::optional of a hit. Called from several threads at once.
template <class S, class V>
concept Intersects = Vector3<V> && requires(const S& scene, const V& v, scalar_t<V> t) {
    { bool(scene.intersect(v, v, t, t)) };
    { *scene.intersect(v, v, t, t) };
};

template <class S, class V>
using hit_t = std::remove_cvref_t<decltype(*std::declval<const S&>().intersect(
    std::declval<const V&>(), std::declval<const V&>(), scalar_t<V>(0), scalar_t<V>(1)))>;

/// The renderer has its own way to start a ray off a surface: `scene.spawn(hit, direction)` is the new ray's origin.
template <class S, class V>
concept SpawnsRays = Intersects<S, V> && requires(const S& scene, const hit_t<S, V>& hit, const V& direction) {
    { scene.spawn(hit, direction) } -> std::convertible_to<V>;
};

/// A new ray must not hit the surface it leaves: either each hit bounds its `position_error`, or the scene spawns.
template <class S, class V>
concept KeepsRaysOffSurfaces = SpawnsRays<S, V> || HasPositionError<hit_t<S, V>, V>;

template <class S, class V>
concept RayTracer = Intersects<S, V> && Hit<hit_t<S, V>, V> && KeepsRaysOffSurfaces<S, V>;

/// `scene.scatter(hit, direction, sampler)`: what the surface does with a photon that arrives along the unit
/// direction, a `Scattering` or a type like it. `sampler.template next<T>()` draws the numbers for its choices.
template <class S, class V, class Sampler>
concept Scatters = RayTracer<S, V> && requires(const S& scene, const hit_t<S, V>& hit, const V& v, Sampler& sampler) {
    { scene.scatter(hit, v, sampler).event } -> std::convertible_to<Event>;
    { scene.scatter(hit, v, sampler).weight };
    { scene.scatter(hit, v, sampler).eta } -> std::convertible_to<scalar_t<V>>;
};

/// All that a photon's walk needs. One object: a renderer's scene, or a small struct that points at it.
template <class S, class V, class Sampler>
concept Scene = RayTracer<S, V> && Scatters<S, V, Sampler>;

/// Optional: `typename S::medium` is what a photon carries to know what it flies through (a value-initialised one
/// where it is emitted), and `scene.transmittance(medium, distance)` the share of flux that passes. Scenes without
/// these pay nothing.
template <class S, class V>
concept Absorbs = requires(const S& scene, const typename S::medium& medium, scalar_t<V> distance) {
    { scene.transmittance(medium, distance) };
};

} // namespace nephroid
