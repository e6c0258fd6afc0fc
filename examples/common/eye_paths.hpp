// SPDX-License-Identifier: MIT
/// @file  What the camera sees: rays followed through mirrors and glass to diffuse surfaces, and to what shines.
#pragma once

#include "common/camera.hpp"
#include "common/scene.hpp"

#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"
#include "nephroid/execution/executor.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace nephroid::examples {

/// A point of a diffuse surface that a pixel sees. Irradiance there times `weight` is what the pixel gets.
template <class T, Flux F>
struct EyeVertex {
    Vec3<T> position;
    Vec3<T> normal;         ///< geometric, unit, on the side that is seen
    Vec3<T> shading_normal; ///< unit, on the same side
    T position_error;       ///< bound on the distance from the surface
    std::uint32_t pixel;    ///< y * width + x, row 0 at the bottom
    F weight;               ///< throughput of the path from the camera × albedo/π / samples, 1 / steradian
    /// Of the sample's part of the pixel, where the camera sees it directly; not known through mirrors and glass.
    PixelFootprint<Vec3<T>> footprint{Vec3<T>(T(0)), Vec3<T>(T(0))};
    /// Of the light that falls here, how much meets the diffuse part of a mixture. Photons choose that part by chance,
    /// so that what they leave has this factor already; light that comes straight from a lamp has not.
    T diffuse_share = T(1);
};

struct EyePathOptions {
    unsigned samples = 1;       ///< for each pixel, > 0
    unsigned max_depth = 16;    ///< reflections and refractions on one path
    double least_weight = 1e-3; ///< a path whose throughput falls below it ends
    std::uint64_t seed = 0;
};

template <class T, Flux F>
struct EyePaths {
    std::vector<EyeVertex<T, F>> vertices; ///< by pixel, in an order that depends on nothing but the arguments
    std::vector<F> emitted;                ///< radiance of emitters as each pixel sees them
    std::size_t rays = 0;
};

/// The radiance that a ray sees which meets nothing, by its direction.
template <class T, Flux F>
using Background = std::function<F(const Vec3<T>&)>;

namespace detail {

/// A path that has come to a surface, or starts at the camera.
template <class T, Flux F>
struct EyePath {
    Vec3<T> origin, direction;
    F throughput;
    Medium medium;
    unsigned depth;
    Contacts<T> contacts{}; ///< of the surfaces that it leaves
    std::size_t left = 0;   ///< the material of the last of them
};

/// Follows one camera ray. Glass splits it in two.
template <class T, Flux F>
class EyePathTracer {
public:
    EyePathTracer(const Scene<T, F>& scene, const Camera<T>& camera, const EyePathOptions& options, const Medium& start,
                  const Background<T, F>& background, EyePaths<T, F>& result)
        : scene_(scene), camera_(camera), options_(options), start_(start), background_(background),
          grid_(options.samples), result_(result) {}

    /// @param film_x, film_y  where the ray goes through the film, pixels
    /// @param first_pixel     the one that `emitted` starts with in the result
    void trace(T film_x, T film_y, std::uint32_t pixel, std::size_t first_pixel) {
        film_x_ = film_x, film_y_ = film_y;
        passed_ = 0;
        const Ray<T> ray = camera_.ray(film_x, film_y);
        pending_.assign(1, {ray.origin, ray.direction, grey<F>(1), start_, 0});
        while (!pending_.empty()) {
            EyePath<T, F> path = pending_.back();
            pending_.pop_back();
            ++result_.rays;
            const auto hit = scene_.intersect(path.origin, path.direction, path.contacts.t_min(),
                                              std::numeric_limits<T>::infinity(), path.contacts);
            if (!hit) {
                if (background_)
                    shine(pixel - first_pixel, path.throughput, background_(path.direction));
                continue;
            }
            const T slope = dot(path.direction, hit->geometric_normal);
            if (path.contacts.is_here(hit->distance, slope) && hit->surface == path.left &&
                (slope > T(0)) == path.contacts.leaves_along_normal()) { // the triangle beside, at their edge
                path.contacts.leave_beside(hit->primitive);
                if (++passed_ <= 1000) // at a vertex of many triangles, again and again
                    pending_.push_back(path);
                continue;
            }
            const T flown = (std::max)(hit->distance, T(0)); // less where surfaces touch
            path.throughput = path.throughput * scene_.transmittance(path.medium, flown);

            const Material<F>& material = scene_.material(*hit);
            const bool from_front = slope < T(0);
            if (material.emits() && (from_front || material.emits_on_both_sides))
                shine(pixel - first_pixel, path.throughput, material.emission);
            const T side = from_front ? T(1) : T(-1);
            if (material.is_mixture())
                part(*hit, path, pixel, side);
            else if (material.surface == Surface::diffuse)
                see(*hit, path, pixel, side, T(1));
            else if (material.is_specular() && path.depth < options_.max_depth)
                bend(*hit, path, side);
        }
    }

private:
    void shine(std::size_t pixel, const F& throughput, const F& radiance) {
        F& emitted = result_.emitted[pixel];
        emitted = emitted + throughput * radiance * grey<F>(1.0 / options_.samples);
    }

    /// Follows what a mixture reflects and lets through, and sees its diffuse part.
    ///
    /// @param side  as in `bend`
    void part(const Hit<T>& hit, EyePath<T, F> path, std::uint32_t pixel, T side) {
        const Material<F>& material = scene_.material(hit);
        const typename Scene<T, F>::Shares share = scene_.shares(material, hit, path.direction, path.medium);
        const bool goes_on = path.depth < options_.max_depth;
        if (goes_on && share.missed > T(0))
            this->go_on(hit, path, path.direction, true, grey<F>(double(share.missed)), path.medium);
        const T covered = T(1) - share.missed;
        if (!(covered > T(0)))
            return;
        if (material.passes_light())
            if (const auto at = scene_.interface(material, hit, path.direction, path.medium); !at.is_real) {
                path.throughput = path.throughput * grey<F>(double(covered));
                pass(hit, path, at.beyond);
                return;
            }
        if (material.is_diffuse()) {
            EyePath<T, F> seen = path;
            seen.throughput = seen.throughput * grey<F>(double(T(1) - share.reflected / covered));
            see(hit, seen, pixel, side, covered * (material.passes_light() ? T(1 - material.transmission) : T(1)));
        }
        path.throughput = path.throughput * grey<F>(double(covered));
        if (goes_on && material.surface != Surface::diffuse && material.surface != Surface::black)
            bend(hit, path, side);
    }

    /// @param diffuse_share  of the surface, see `EyeVertex`
    void see(const Hit<T>& hit, const EyePath<T, F>& path, std::uint32_t pixel, T side, T diffuse_share) {
        const double share = 1 / (double(pi<T>) * options_.samples);
        const F weight = path.throughput * scene_.color(hit) * grey<F>(share);
        if (!(flux_traits<F>::power(weight) > 0))
            return;
        result_.vertices.push_back(
            {hit.position, side * hit.geometric_normal, side * hit.shading_normal, hit.position_error, pixel, weight});
        if (path.depth == 0)
            result_.vertices.back().footprint = camera_.footprint(
                film_x_, film_y_, T(1) / T(grid_.columns), T(1) / T(grid_.rows), hit.position, hit.geometric_normal);
        result_.vertices.back().diffuse_share = diffuse_share;
    }

    /// @param side  of the surface that the ray comes from, 1 or -1
    void bend(const Hit<T>& hit, const EyePath<T, F>& path, T side) {
        const Material<F>& material = scene_.material(hit);
        const Vec3<T> facing = side * hit.geometric_normal;
        const Vec3<T> normal =
            dot(path.direction, side * hit.shading_normal) < T(0) ? side * hit.shading_normal : facing;

        if (!material.passes_light()) {
            reflect(hit, path, normal, facing, scene_.reflectance(material, hit, path.direction));
            return;
        }
        const Interface<T> at = scene_.interface(material, hit, path.direction, path.medium);
        if (!at.is_real) {
            pass(hit, path, at.beyond);
            return;
        }
        const T transmission = T(material.transmission);
        if (material.surface == Surface::window) {
            const T once = scene_.reflectance(material, at), reflected = T(2) * once / (T(1) + once);
            reflect(hit, path, normal, facing, grey<F>(double(reflected)));
            go_on(hit, path, path.direction, true,
                  scene_.color(hit) * grey<F>(double((T(1) - reflected) * transmission)), path.medium);
            return;
        }
        const T reflected = scene_.reflectance(material, at);
        if (reflected > T(0) && material.follow == Follow::both)
            reflect(hit, path, normal, facing, grey<F>(double(reflected)));
        if (reflected < T(1) && transmission > T(0))
            if (const auto refraction = nephroid::refraction(path.direction, normal, at.eta)) {
                // Radiance over the square of the index is what passes unchanged.
                const Bounce<T, F> through =
                    scene_.refracted(hit, at, (T(1) - reflected) * transmission * at.eta * at.eta);
                go_on(hit, path, refraction->direction(), dot(refraction->direction(), facing) < T(0), through.weight,
                      through.medium);
            }
    }

    void reflect(const Hit<T>& hit, const EyePath<T, F>& path, const Vec3<T>& normal, const Vec3<T>& facing,
                 const F& weight) {
        Vec3<T> direction = Reflection<Vec3<T>>(path.direction, normal).direction();
        if (!(dot(direction, facing) > T(0))) // the shading normal sent it into the surface
            direction = Reflection<Vec3<T>>(path.direction, facing).direction();
        go_on(hit, path, direction, dot(direction, facing) > T(0), weight, path.medium);
    }

    /// Through a surface that light does not notice.
    void pass(const Hit<T>& hit, EyePath<T, F> path, const Medium& beyond) {
        if (++passed_ > 1000) // in one pixel's paths: the tracer finds the same one again and again
            return;
        const T slope = dot(path.direction, hit.geometric_normal);
        path.contacts.leave(hit.primitive, slope, T(2) * hit.position_error, true,
                            path.contacts.is_here(hit.distance, slope));
        path.origin = hit.position;
        path.medium = beyond;
        path.left = hit.surface;
        pending_.push_back(path);
    }

    void go_on(const Hit<T>& hit, const EyePath<T, F>& path, const Vec3<T>& direction, bool leaves, const F& weight,
               Medium medium) {
        const F throughput = path.throughput * weight;
        if (!leaves || !(flux_traits<F>::power(throughput) >= options_.least_weight))
            return;
        const T arrives = dot(path.direction, hit.geometric_normal), goes = dot(direction, hit.geometric_normal);
        Contacts<T> contacts = path.contacts;
        contacts.leave(hit.primitive, goes, T(2) * hit.position_error, (arrives > T(0)) == (goes > T(0)),
                       contacts.is_here(hit.distance, arrives));
        pending_.push_back({hit.position, direction, throughput, medium, path.depth + 1, contacts, hit.surface});
    }

    const Scene<T, F>& scene_;
    const Camera<T>& camera_;
    const EyePathOptions& options_;
    const Medium& start_; ///< that the camera is in
    const Background<T, F>& background_;
    PixelGrid grid_;
    EyePaths<T, F>& result_;
    T film_x_ = T(0), film_y_ = T(0);
    unsigned passed_ = 0;
    std::vector<EyePath<T, F>> pending_;
};

} // namespace detail

/// Follows the camera's rays through the scene. Both branches of glass are followed, until their weight is small.
///
/// @param executor    the result does not depend on it
/// @param background  black where it is empty
template <class T, Flux F, Executor E>
[[nodiscard]] EyePaths<T, F> trace_eye_paths(const Scene<T, F>& scene, const Camera<T>& camera,
                                             const EyePathOptions& options, E&& executor,
                                             const std::type_identity_t<Background<T, F>>& background = {}) {
    constexpr std::size_t chunk = 512; // pixels
    const std::size_t pixels = camera.width() * camera.height();
    const Medium start = scene.media_about(camera.ray(T(camera.width()) / 2, T(camera.height()) / 2).origin);
    std::vector<EyePaths<T, F>> parts((pixels + chunk - 1) / chunk);
    executor(parts.size(), [&](std::size_t part) {
        const std::size_t first = part * chunk, last = (std::min)(first + chunk, pixels);
        parts[part].emitted.resize(last - first, flux_traits<F>::zero());
        detail::EyePathTracer<T, F> tracer(scene, camera, options, start, background, parts[part]);
        for (std::size_t pixel = first; pixel < last; ++pixel)
            for (unsigned k = 0; k < options.samples; ++k) {
                const PixelOffset<T> at = pixel_sample<T>(pixel, k, options.samples, options.seed);
                tracer.trace(T(pixel % camera.width()) + at.x, T(pixel / camera.width()) + at.y,
                             static_cast<std::uint32_t>(pixel), first);
            }
    });

    EyePaths<T, F> all;
    std::size_t vertices = 0;
    for (const auto& part : parts)
        vertices += part.vertices.size();
    all.vertices.reserve(vertices);
    all.emitted.reserve(pixels);
    for (auto& part : parts) {
        all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
        all.emitted.insert(all.emitted.end(), part.emitted.begin(), part.emitted.end());
        all.rays += part.rays;
        part = {};
    }
    return all;
}

} // namespace nephroid::examples
