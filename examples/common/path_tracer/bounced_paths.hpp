// SPDX-License-Identifier: MIT
/// @file  Paths that bounce between diffuse surfaces, through mirrors and glass, to lamps: the truth about a room.
#pragma once

#include "common/layer.hpp"
#include "common/path_tracer/lamp_samples.hpp"
#include "common/path_tracer/specular_flight.hpp"

#include "nephroid/emission/warp.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

namespace nephroid::examples {

/// Light by its way from the lamp L to the eye E, over diffuse surfaces D and specular ones S. No way is in two layers.
template <Flux F>
struct LightLayers {
    F direct = flux_traits<F>::zero();   ///< L D E
    F caustic = flux_traits<F>::zero();  ///< L S+ D E
    F indirect = flux_traits<F>::zero(); ///< L (S* D)+ S* D E: at least one bounce off a diffuse surface

    [[nodiscard]] F sum() const { return direct + caustic + indirect; }
    friend LightLayers operator+(const LightLayers& a, const LightLayers& b) {
        return {a.direct + b.direct, a.caustic + b.caustic, a.indirect + b.indirect};
    }
    /// Band by band.
    friend LightLayers operator*(const LightLayers& a, const F& b) {
        return {a.direct * b, a.caustic * b, a.indirect * b};
    }
    bool operator==(const LightLayers&) const = default;
};

/// One path at a time, unbiased.
///
/// Each diffuse surface of a path looks for every lamp by a ray to a random point, and the path's own next flight,
/// drawn by the cosine, may meet the lamp as well. The two are weighted by the balance heuristic [Veach and Guibas
/// 1995], so that lamps that touch what they light make no fireflies. What lies behind mirrors or glass only the flight
/// finds. Roulette by albedo keeps the largest band of a path's weight as it is.
template <class T, Flux F>
class BouncedPaths {
public:
    using Vec = Vec3<T>;

    /// The scene and the lamps are kept by reference, and must outlive this object. Throws std::invalid_argument if a
    /// path could not meet all light, or would count it in another way than photons do.
    ///
    /// @param bounces  the most, off diffuse surfaces before the one that is seen; 0: no indirect light
    /// @param specular_events  the most, on one flight from diffuse surface to diffuse surface
    BouncedPaths(const Scene<T, F>& scene, const Lamps<T, F>& lamps, unsigned bounces = all_bounces,
                 unsigned specular_events = 1000)
        : scene_(scene), lamps_(lamps), flight_(scene, specular_events), bounces_(bounces) {
        if (scene.has_specular() && !lamps.lamps.empty())
            invalid_argument("path tracer: a lamp has no area, so no path meets it through the scene's mirrors and "
                             "glass; give it area, or the sun a size");
        for (const Material<F>& material : scene.materials())
            if (material.passes_light() && material.is_partly_opaque())
                invalid_argument("path tracer: glass that is partly opaque is not known to paths; make it either");
    }

    /// The media around a point for which light is asked; air if the scene has no glass.
    [[nodiscard]] Medium medium_at(const EyeVertex<T, F>& vertex) const {
        return scene_.has_specular() ? scene_.media_about(off(vertex)) : Medium{};
    }

    /// An estimate of the irradiance at a point of a diffuse surface.
    ///
    /// @param medium  around it
    template <class Sampler>
    [[nodiscard]] LightLayers<F> operator()(const EyeVertex<T, F>& vertex, const Medium& medium,
                                            Sampler& sampler) const {
        LightLayers<F> found;
        Place at{off(vertex), vertex.normal, vertex.shading_normal};
        FlyingPath<T, F> path{at.position, at.normal, medium};
        std::optional<Hit<T>> hit;
        F weight = grey<F>(1);
        for (unsigned bounce = 0;; ++bounce) {
            F straight = from_lamps(at, path.medium, sampler), bent = flux_traits<F>::zero();
            hit = fly(at, path, hit, sampler, straight, bent);
            if (bounce == 0) {
                found.direct = straight;
                found.caustic = bent;
            } else {
                found.indirect = found.indirect + weight * (straight + bent);
            }
            if (!hit || bounce == bounces_ || !survives(weight, path.radiance * scene_.color(*hit), sampler))
                return found;
            const T side = dot(path.direction, hit->geometric_normal) < T(0) ? T(1) : T(-1);
            at = {hit->position + (T(2) * hit->position_error * side) * hit->geometric_normal,
                  side * hit->geometric_normal, side * hit->shading_normal};
        }
    }

private:
    /// A point barely off a diffuse surface.
    struct Place {
        Vec position, normal, shading_normal; ///< the normals unit, on the side from which light comes

        [[nodiscard]] T cosine(const Vec& direction) const {
            return dot(direction, normal) > T(0) ? (std::max)(dot(direction, shading_normal), T(0)) : T(0);
        }
    };

    [[nodiscard]] static Vec off(const EyeVertex<T, F>& vertex) {
        return vertex.position + T(2) * vertex.position_error * vertex.normal;
    }

    /// Irradiance, by a ray to each lamp.
    template <class Sampler>
    [[nodiscard]] F from_lamps(const Place& at, const Medium& medium, Sampler& sampler) const {
        F sum = flux_traits<F>::zero();
        for (std::size_t i = 0; i < lamps_.size(); ++i) {
            const auto lamp = lamps_.draw(i, at.position, sampler);
            const T cosine = lamp ? at.cosine(lamp->direction) : T(0);
            const T reach = lamp ? lamp->distance * (T(1) - T(4) * std::numeric_limits<T>::epsilon()) : T(0);
            if (!(cosine > T(0)) || scene_.occluded(at.position, lamp->direction, T(0), reach))
                continue;
            F light = lamp->light;
            if (std::isfinite(lamp->distance))
                light = light * scene_.transmittance(medium, lamp->distance);
            const double share = lamp->density > 0 ? 1 / (lamp->density + double(cosine) / pi<double>) : 1;
            sum = sum + light * grey<F>(double(cosine) * share);
        }
        return sum;
    }

    /// Follows a path from a diffuse surface to the next one.
    ///
    /// @param left           the surface that it is on; nothing for the first one
    /// @param straight,bent  get the irradiance of the lamps that it meets on its first way, and later
    template <class Sampler>
    [[nodiscard]] std::optional<Hit<T>> fly(const Place& at, FlyingPath<T, F>& path, const std::optional<Hit<T>>& left,
                                            Sampler& sampler, F& straight, F& bent) const {
        const T u1 = sampler.template next<T>(), u2 = sampler.template next<T>();
        const Vec direction =
            cosine_direction(at.shading_normal, frame_about(at.shading_normal), concentric_disk(u1, u2));
        const T cosine = at.cosine(direction);
        if (!(cosine > T(0)))
            return std::nullopt;
        if (left)
            path.leave(*left, direction);
        path.direction = direction;
        path.radiance = grey<F>(1);
        path.specular = 0;
        path.passed = false;
        return flight_(path, sampler, [&](const FlyingPath<T, F>& now, const std::optional<Hit<T>>& hit) {
            const double density = double(cosine) / pi<double>;
            F& sum = now.specular == 0 ? straight : bent;
            const auto add = [&](const F& radiance, double drawn) {
                const double share = now.is_straight() ? density / (density + drawn) : 1;
                sum = sum + now.radiance * radiance * grey<F>(pi<double> * share);
            };
            if (hit)
                lamps_.at_hit(scene_, *hit, now.direction, hit->distance, add);
            else
                lamps_.outside(now.direction, add);
        });
    }

    /// Roulette; the weight becomes that of the path's next part.
    template <class Sampler>
    [[nodiscard]] static bool survives(F& weight, const F& factor, Sampler& sampler) {
        const F next = weight * factor;
        const double chance = (std::min)(1.0, largest_band(next) / largest_band(weight));
        if (!(chance > 0) || (chance < 1 && !(sampler.template next<double>() < chance)))
            return false;
        weight = next * grey<F>(1 / chance);
        return true;
    }

    [[nodiscard]] static double largest_band(const F& f) {
        if constexpr (std::floating_point<F>)
            return double(f);
        else
            return double((std::max)({f.x, f.y, f.z}));
    }

    const Scene<T, F>& scene_;
    LampSamples<T, F> lamps_;
    SpecularFlight<T, F> flight_;
    unsigned bounces_;
};

} // namespace nephroid::examples
