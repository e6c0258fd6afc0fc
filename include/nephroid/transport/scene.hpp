// SPDX-License-Identifier: MIT
/// @file  What the library asks of a renderer's scene: rays that hit, and surfaces that scatter.
#pragma once

#include "nephroid/transport/hit.hpp"
#include "nephroid/transport/scattering.hpp"

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace nephroid {

/// `scene.intersect(origin, direction, t_min, t_max)`: the nearest hit with t_min < distance < t_max, as anything
/// that reads like std::optional of a hit. Called from several threads at once.
template <class S, class V>
concept Intersects = Vector3<V> && requires(const S& scene, const V& v, scalar_t<V> t) {
    {bool(scene.intersect(v, v, t, t))};
    {*scene.intersect(v, v, t, t)};
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

/// Optional: the renderer's tracer finds nothing nearer than `scene.tracer_epsilon` to a ray's origin, whatever t_min
/// says (world units, >= 0; 0.001 is usual). The walk then begins its rays so much further back, along their own line,
/// that nothing is skipped: neither the table that a glass stands on nor a surface close to the lamp.
template <class S, class V>
concept HasTracerEpsilon = requires(const S& scene) {
    { scene.tracer_epsilon } -> std::convertible_to<scalar_t<V>>;
};

/// Enough for photons without tangents; for others hits also say how their normals change (`Hit`).
template <class S, class V>
concept RayTracer =
    Intersects<S, V> && HasDistance<hit_t<S, V>, V> && HasGeometricNormal<hit_t<S, V>, V> && KeepsRaysOffSurfaces<S, V>;

/// Optional: `typename S::medium` is what a photon carries to know what it flies through (a value-initialised one
/// where it is emitted), and `scene.transmittance(medium, distance)` the share of flux that passes. Scenes without
/// these pay nothing. Where media touch or overlap, `medium` may be `Media` (transport/media.hpp).
template <class S, class V>
concept Absorbs = requires(const S& scene, const typename S::medium& medium, scalar_t<V> distance) {
    {scene.transmittance(medium, distance)};
};

/// Optional: `scene.medium_at(position)` is the medium that a photon emitted there flies through first. A scene whose
/// lamps may lie under water finds this out once for each lamp.
template <class S, class V>
concept KnowsMediumOfLamps = Absorbs<S, V> && requires(const S& scene, const V& position) {
    { scene.medium_at(position) } -> std::convertible_to<typename S::medium>;
};

namespace detail {
/// Nothing is flown through: what a scene without absorption carries.
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

/// The scene's `scatter`, with the medium that the photon comes through where it asks for that.
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

/// `scene.scatter(hit, direction, sampler)`: what the surface does with a photon that arrives along the unit
/// direction, a `Scattering` or a type like it. `sampler.template next<T>()` draws the numbers for its choices. With a
/// fourth parameter it is told the `medium` that the photon comes through.
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

/// `scatter` takes its sampler as a const reference, which gives no numbers.
template <class S, class Sampler>
concept DrawsFromConst = requires {
    { third_parameter(&S::template scatter<Sampler>) } -> std::same_as<const Sampler&>;
};
} // namespace detail

/// All that a photon's walk needs. One object: a renderer's scene, or a small struct that points at it.
///
/// A float's coordinates are as coarse as a ten-millionth of the distance from the origin. A caustic of one unit is
/// noisy 1,000 units away from it, off by a tenth at 10,000 and by 40% at 100,000: a scene should lie about its own
/// middle.
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
/// @tparam N  tangents of the photons: those without ask no `curvature` of a hit
template <class S, class V, class Sampler, std::size_t N = 2>
concept Scene = RayTracer<S, V> && Scatters<S, V, Sampler> &&
    (N == 0 || Hit<hit_t<S, V>, V>)&&!detail::DrawsFromConst<S, Sampler>;

namespace detail {
/// What a scene lacks, as the first line of the compiler's message.
template <class S, class V, class Sampler, std::size_t N>
consteval bool explain_scene() {
    static_assert(Intersects<S, V>, "nephroid: the scene lacks intersect(origin, direction, t_min, t_max) const -> an "
                                    "optional hit (transport/scene.hpp)");
    if constexpr (Intersects<S, V>) {
        using H = hit_t<S, V>;
        static_assert(HasDistance<H, V>, "nephroid: the scene's hit lacks `distance` (transport/hit.hpp)");
        static_assert(HasGeometricNormal<H, V>,
                      "nephroid: the scene's hit lacks `geometric_normal` (transport/hit.hpp)");
        static_assert(N == 0 || SaysHowItsNormalChanges<H, V>,
                      "nephroid: the scene's hit lacks `curvature`, which says how its normal changes; "
                      "nephroid::Flat is the answer for planes alone (differential/curvature.hpp)");
        static_assert(KeepsRaysOffSurfaces<S, V>, "nephroid: the scene's hit lacks `position_error`, or the scene "
                                                  "spawn(hit, direction) const (transport/scene.hpp)");
        if constexpr (KeepsRaysOffSurfaces<S, V>) // without which nothing is asked of scatter
            static_assert(Scatters<S, V, Sampler>,
                          "nephroid: the scene lacks scatter(hit, direction, sampler) const -> event, "
                          "weight, eta (transport/scattering.hpp)");
        static_assert(!DrawsFromConst<S, Sampler>,
                      "nephroid: the scene's scatter takes its sampler as const, and so can draw no numbers from it; "
                      "take it as `auto& random`");
    }
    return false;
}

/// For functions without an overload, where a wrong type can only be a mistake: Scene, or an error that says why not.
template <class S, class V, class Sampler, std::size_t N = 2>
concept MustBeScene = Scene<S, V, Sampler, N> || explain_scene<S, V, Sampler, N>();
} // namespace detail

} // namespace nephroid
