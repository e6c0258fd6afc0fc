// SPDX-License-Identifier: MIT
/// @file  Follows one ray of the camera through mirrors and glass to diffuse surfaces and emitters.
#pragma once

#include "common/camera.hpp"
#include "common/eye_vertex.hpp"
#include "common/scene.hpp"

#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::examples {

namespace detail {

/// A path at a surface or at the camera.
template <class T, Flux F>
struct EyePath {
    Vec3<T> origin, direction;
    F throughput;
    Medium medium;
    unsigned depth;
    Contacts<T> contacts{}; ///< of the surfaces that the path leaves
    std::size_t left = 0;   ///< the material of the last one
};

/// Follows one camera ray. Glass splits it in two.
template <class T, Flux F>
class EyePathTracer {
public:
    EyePathTracer(const Scene<T, F>& scene, const Camera<T>& camera, const EyePathOptions& options, const Medium& start,
                  const Background<T, F>& background, EyePaths<T, F>& result)
        : scene_(scene), camera_(camera), options_(options), start_(start), background_(background),
          grid_(options.samples), result_(result) {}

    /// @param film_x, film_y  where the ray passes through the film, pixels
    /// @param first_pixel     the first pixel of `emitted` in the result
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
                    add_emitted(pixel - first_pixel, path.throughput, background_(path.direction));
                continue;
            }
            const T slope = dot(path.direction, hit->geometric_normal);
            if (path.contacts.is_here(hit->distance, slope) && hit->surface == path.left &&
                (slope > T(0)) == path.contacts.leaves_along_normal()) { // a neighbouring triangle, at the common edge
                path.contacts.leave_beside(hit->primitive);
                if (++passed_ <= 1000) // bounds the triangles at one vertex
                    pending_.push_back(path);
                continue;
            }
            const T flown = (std::max)(hit->distance, T(0)); // rounding makes it negative where surfaces touch
            path.throughput = path.throughput * scene_.transmittance(path.medium, flown);

            const Material<F>& material = scene_.material(*hit);
            const bool from_front = slope < T(0);
            if (material.emits() && (from_front || material.emits_on_both_sides))
                add_emitted(pixel - first_pixel, path.throughput, material.emission);
            const T side = from_front ? T(1) : T(-1);
            if (material.is_mixture())
                follow_mixture(*hit, path, pixel, side);
            else if (material.surface == Surface::diffuse)
                add_vertex(*hit, path, pixel, side, T(1));
            else if (material.is_specular() && path.depth < options_.max_depth)
                follow_specular(*hit, path, side);
        }
    }

private:
    void add_emitted(std::size_t pixel, const F& throughput, const F& radiance) {
        F& emitted = result_.emitted[pixel];
        emitted = emitted + throughput * radiance * grey<F>(1.0 / options_.samples);
    }

    /// Follows the light that a mixture reflects and transmits, and adds a vertex for its diffuse part.
    ///
    /// @param side  as for `follow_specular`
    void follow_mixture(const Hit<T>& hit, EyePath<T, F> path, std::uint32_t pixel, T side) {
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
            add_vertex(hit, seen, pixel, side,
                       covered * (material.passes_light() ? T(1 - scene_.transmission(hit)) : T(1)));
        }
        path.throughput = path.throughput * grey<F>(double(covered));
        if (goes_on && material.surface != Surface::diffuse && material.surface != Surface::black)
            follow_specular(hit, path, side);
    }

    /// @param diffuse_share  of the surface, see `EyeVertex`
    void add_vertex(const Hit<T>& hit, const EyePath<T, F>& path, std::uint32_t pixel, T side, T diffuse_share) {
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

    /// @param side  1 if the ray arrives on the side of the geometric normal, otherwise -1
    void follow_specular(const Hit<T>& hit, const EyePath<T, F>& path, T side) {
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
        const T transmission = T(scene_.transmission(hit));
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
                // Refraction does not change radiance over the square of the index.
                const Bounce<T, F> through =
                    scene_.refracted(hit, at, (T(1) - reflected) * transmission * at.eta * at.eta);
                go_on(hit, path, refraction->direction(), dot(refraction->direction(), facing) < T(0), through.weight,
                      through.medium);
            }
    }

    void reflect(const Hit<T>& hit, const EyePath<T, F>& path, const Vec3<T>& normal, const Vec3<T>& facing,
                 const F& weight) {
        Vec3<T> direction = Reflection<Vec3<T>>(path.direction, normal).direction();
        if (!(dot(direction, facing) > T(0))) // the shading normal sends the ray into the surface
            direction = Reflection<Vec3<T>>(path.direction, facing).direction();
        go_on(hit, path, direction, dot(direction, facing) > T(0), weight, path.medium);
    }

    /// Goes on through a surface that light does not notice.
    void pass(const Hit<T>& hit, EyePath<T, F> path, const Medium& beyond) {
        if (++passed_ > 1000) // bounds a tracer that finds the same surface again and again
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
    const Medium& start_; ///< the camera's
    const Background<T, F>& background_;
    PixelGrid grid_;
    EyePaths<T, F>& result_;
    T film_x_ = T(0), film_y_ = T(0);
    unsigned passed_ = 0;
    std::vector<EyePath<T, F>> pending_;
};

} // namespace detail

} // namespace nephroid::examples
