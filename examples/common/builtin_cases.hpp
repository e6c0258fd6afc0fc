// SPDX-License-Identifier: MIT
/// @file  The scenes whose caustics are known exactly (a water wave, a ring, a ball of glass), and one that is not.
#pragma once

#include "common/path_tracer/emitter.hpp"
#include "common/scene.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/disk.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/light_set.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// A rectangle of the floor z = 0, seen from above.
struct FilmRectangle {
    double x_min, x_max;
    double y_min, y_max;
};

/// Sunlight that is aimed exactly at the ring's mirror. Seen along the light the half cylinder is no parallelogram. But
/// its silhouette in the upright plane x = -1/16 is the rectangle |y| < 1, 0 < z < height with each column raised by
/// the height that the light loses on its way, and this shear preserves areas.
template <class T, Flux F>
class RingBeam {
public:
    using vector = Vec3<T>;
    using flux_type = F;
    static constexpr EmissionDomain domain{.coordinates = 2};

    struct Options {
        T elevation;  ///< of the sun, radians
        T height;     ///< of the mirror
        F irradiance; ///< on horizontal planes
    };

    explicit RingBeam(const Options& options)
        : direction_(std::cos(options.elevation), 0, -std::sin(options.elevation)), slope_(std::tan(options.elevation)),
          height_(options.height), power_(options.irradiance * (T(2) * options.height / slope_)),
          basis_(aligned_basis(Vec3<T>(1, 0, 0), direction_)) {}

    template <SampleSource<T> S>
    [[nodiscard]] Photon<Vec3<T>, F> emit(S& samples, const Spread<T>& spread) const {
        // The first sample, which sequences stratify best, is for the longer side.
        const T y = T(2) * samples.template next<T>() - T(1);
        const T z = height_ * samples.template next<T>();
        const T x = std::sqrt((T(1) - y) * (T(1) + y)), start = T(-1) / T(16);
        const T d_length = spread.length(T(2) * height_);
        const Vec3<T> zero(0);
        return {Vec3<T>(start, y, z + (x - start) * slope_),
                direction_,
                power_ * (T(1) / spread.photons),
                {Tangent<Vec3<T>>{d_length * basis_.u, zero}, Tangent<Vec3<T>>{d_length * basis_.v, zero}}};
    }

    [[nodiscard]] double power() const { return flux_traits<F>::power(power_); }

private:
    Vec3<T> direction_;
    T slope_, height_;
    F power_;
    AlignedBasis<Vec3<T>> basis_;
};

/// The lights of the built-in cases.
template <class T, Flux F>
using CaseLight = LightSet<DirectionalLight<Vec3<T>, F>, PointLight<Vec3<T>, F>, RingBeam<T, F>, DiskLight<Vec3<T>, F>>;

/// A scene above the diffuse floor z = 0, its light, and the film. The picture is the irradiance on the floor.
template <class T, Flux F = Vec3<T>>
struct BuiltinCase {
    Scene<T, F> scene;
    CaseLight<T, F> light;
    FilmRectangle film;
    bool periodic = false; ///< with period 1 along x and y; a hit on the floor is wrapped into the unit square, so a
                           ///< footprint over its border needs eye vertices (ghosts) on the other side as well
    Emitters<T, F> emitters = {}; ///< the light again, as surfaces that paths from the floor can hit; empty for
                                  ///< a light without area
    std::optional<Scene<T, F>> unwrapped = {}; ///< of a periodic case: hits on its floor are where they are, so that
                                               ///< light sheets do not tear

    [[nodiscard]] const Scene<T, F>& scene_for_sheets() const { return unwrapped ? *unwrapped : scene; }
};

inline constexpr std::array<std::string_view, 8> builtin_case_names = {
    "wave-focused", "wave-prefocal", "ring", "ring-zoom", "ball", "ball-point", "ring-disk", "ring-disk-zoom"};

namespace detail {

template <class T, Flux F>
[[nodiscard]] BuiltinCase<T, F> wave_case(T amplitude, bool fresnel) {
    using Materials = std::vector<Material<F>>;
    const typename SineWave<T>::Options wave{.height = 1, .amplitude = amplitude};
    const auto over = [&](const Floor<T>& floor) {
        return Scene<T, F>(
            {{floor, 0}, {SineWave<T>(wave), 1}},
            Materials{Material<F>::diffuse(grey<F>(1)), Material<F>::dielectric(1.33, fresnel, Follow::refraction)});
    };
    // Over the unit square, above the crests.
    const DirectionalLight<Vec3<T>, F> sun({.direction = {0, 0, -1},
                                            .irradiance = grey<F>(1),
                                            .patch = Parallelogram<Vec3<T>>{{0, 0, T(1.25)}, {1, 0, 0}, {0, 1, 0}}});
    return {over(Floor<T>(0, 1)), CaseLight<T, F>({sun}), {0, 1, 0, 1}, true, {}, over(Floor<T>(0))};
}

/// The inner side of a half cylinder on the floor, a perfect mirror.
template <class T, Flux F>
[[nodiscard]] Scene<T, F> ring_scene(T height) {
    using Materials = std::vector<Material<F>>;
    return Scene<T, F>(
        {{Floor<T>(0), 0}, {Cylinder<T>({.radius = 1, .height = height, .facing_x = 1, .least_cosine = 0}), 1}},
        Materials{Material<F>::diffuse(grey<F>(1)), Material<F>::mirror(grey<F>(1))});
}

inline constexpr double ring_height = 0.5, ring_elevation = 35 * pi<double> / 180;

template <class T, Flux F>
[[nodiscard]] BuiltinCase<T, F> ring_case(FilmRectangle film) {
    const T elevation = T(ring_elevation), height = T(ring_height);
    const RingBeam<T, F> sun({.elevation = elevation, .height = height, .irradiance = grey<F>(1)});
    return {ring_scene<T, F>(height), CaseLight<T, F>({sun}), film, false};
}

/// The ring, lit by a disk four units away instead of the sun. Nothing blocks the mirror's inner side, because every
/// ray from the disk enters the cylinder through its open half. Without the mirror the irradiance at the origin would
/// be 1: the disk fills a projected solid angle of π r²/(r² + d²), seen at an angle.
template <class T, Flux F>
[[nodiscard]] BuiltinCase<T, F> ring_disk_case(FilmRectangle film) {
    const double radius = 0.15, distance = 4;
    const double radiance = (square(radius) + square(distance)) / (pi<double> * square(radius) * sin(ring_elevation));
    const Vec3<T> centre(T(-distance * cos(ring_elevation)), T(0), T(distance * sin(ring_elevation)));
    // The smallest sphere about the half cylinder: its four corners are on it.
    const double reach = sqrt(1 + square(ring_height / 2));
    const BoundingSphere<Vec3<T>> mirror{{0, 0, T(ring_height / 2)},
                                         T(reach) * (1 + 8 * std::numeric_limits<T>::epsilon())};
    const DiskLight<Vec3<T>, F> disk(
        {.centre = centre, .normal = -centre, .radius = T(radius), .radiance = grey<F>(radiance), .target = mirror});
    return {ring_scene<T, F>(T(ring_height)),
            CaseLight<T, F>({disk}),
            film,
            false,
            {Emitter<T, F>::disk(centre, -centre, T(radius), grey<F>(radiance))}};
}

template <class T, Flux F>
[[nodiscard]] BuiltinCase<T, F> ball_case(bool point, bool fresnel) {
    using Materials = std::vector<Material<F>>;
    const Vec3<T> centre(0, 0, T(1.25));
    Scene<T, F> scene(
        {{Floor<T>(0), 0}, {Sphere<T>(centre, 1), 1}},
        Materials{Material<F>::diffuse(grey<F>(1)), Material<F>::dielectric(1.5, fresnel, Follow::refraction)});
    const BoundingSphere<Vec3<T>> ball{centre, 1};
    std::vector<typename CaseLight<T, F>::AnyLight> light;
    if (point)
        light.push_back(
            PointLight<Vec3<T>, F>({.position = {0, 0, T(5.25)}, .intensity = grey<F>(16), .target = ball}));
    else
        light.push_back(
            DirectionalLight<Vec3<T>, F>({.direction = {0, 0, -1},
                                          .irradiance = grey<F>(1),
                                          .patch = beam_over<Vec3<T>>({0, 0, -1}, ball)})); // nothing is above it
    return {std::move(scene), CaseLight<T, F>(std::move(light)), {-0.5, 0.5, -0.5, 0.5}, false};
}

} // namespace detail

/// @param name     one of `builtin_case_names`; for another name, nothing is returned
/// @param fresnel  whether water and glass reflect a part of the light. This part is absorbed, because only the
///                 caustics of refracted light are known exactly
/// The ring's number of reflections is a limit on the walk, not on the scene.
template <class T, Flux F = Vec3<T>>
[[nodiscard]] std::optional<BuiltinCase<T, F>> builtin_case(std::string_view name, bool fresnel) {
    if (name == "wave-focused")
        return detail::wave_case<T, F>(T(0.04), fresnel);
    if (name == "wave-prefocal")
        return detail::wave_case<T, F>(T(0.012), fresnel);
    if (name == "ring")
        return detail::ring_case<T, F>({-0.1, 2.1, -1.1, 1.1});
    if (name == "ring-zoom")
        return detail::ring_case<T, F>({0.1, 0.9, -0.4, 0.4});
    if (name == "ring-disk")
        return detail::ring_disk_case<T, F>({-0.1, 2.1, -1.1, 1.1});
    if (name == "ring-disk-zoom")
        return detail::ring_disk_case<T, F>({0.1, 0.9, -0.4, 0.4});
    if (name == "ball")
        return detail::ball_case<T, F>(false, fresnel);
    if (name == "ball-point")
        return detail::ball_case<T, F>(true, fresnel);
    return std::nullopt;
}

} // namespace nephroid::examples
