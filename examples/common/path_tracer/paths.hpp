// SPDX-License-Identifier: MIT
/// @file  Follows paths from a diffuse surface through mirrors and glass to a light.
#pragma once

#include "common/path_tracer/emitter.hpp"
#include "common/scene.hpp"

#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"

#include <limits>
#include <optional>

namespace nephroid::examples {

/// The end of a path.
struct Seen {
    double radiance = 0;       ///< along the path, of light that met a specular surface
    bool met_specular = false; ///< whether the path met a specular surface
};

/// Follows paths in the opposite direction of the library's walk: they find from the floor the light that photons carry
/// to the floor.
class SpecularPaths {
public:
    using Vec = Vec3<double>;

    /// The scene and the emitters are kept by reference, and must outlive this object.
    /// @param specular_events  reflections and refractions after which a path that meets one more ends
    SpecularPaths(const Scene<double, double>& scene, const Emitters<double, double>& emitters,
                  unsigned specular_events)
        : scene_(scene), emitters_(emitters), specular_events_(specular_events) {}

    /// @param origin     on a diffuse surface, or moved off it
    /// @param direction  unit
    /// @param sampler    used where glass both reflects and refracts
    template <class Sampler>
    [[nodiscard]] Seen operator()(Vec origin, Vec direction, Sampler& sampler) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Seen seen;
        double throughput = 1;
        for (unsigned events = 0; throughput > 0; ++events) {
            const std::optional<Hit<double>> hit = scene_.intersect(origin, direction, 0, infinity);
            const Medium medium = hit ? medium_before(*hit, direction) : Medium{};
            if (events > 0)
                seen.radiance += throughput * emitted({origin, direction, 0, hit ? hit->distance : infinity}, medium);
            if (!hit)
                break;
            const Bounce<double, double> bounce = scene_.scatter(*hit, direction, sampler);
            if (bounce.event == Event::absorb || bounce.event == Event::diffuse)
                break;
            seen.met_specular = true;
            if (events == specular_events_)
                break;
            throughput *= scene_.transmittance(medium, hit->distance) * bounce.weight * bend(*hit, bounce, direction);
            origin = off_surface(*hit, direction);
        }
        return seen;
    }

private:
    /// A surface's inside is where its normal points away from, and media do not nest.
    [[nodiscard]] Medium medium_before(const Hit<double>& hit, const Vec& direction) const {
        const bool from_inside = dot(direction, hit.geometric_normal) > 0;
        const bool is_glass = scene_.material(hit).surface == Surface::dielectric;
        Medium medium;
        if (from_inside && is_glass)
            medium.enter(static_cast<std::int32_t>(hit.surface));
        return medium;
    }

    [[nodiscard]] double emitted(const Ray<double>& ray, const Medium& medium) const {
        double sum = 0;
        for (const Emitter<double, double>& emitter : emitters_)
            if (const std::optional<double> distance = emitter.distance(ray))
                sum += emitter.radiance * scene_.transmittance(medium, *distance);
        return sum;
    }

    /// Reflects or refracts the direction.
    /// @return  the factor of the radiance: (n₁/n₂)² for a path that goes from n₁ to n₂, because refraction
    ///          changes the solid angle of the light; 0 if the shading normal sends the path to the wrong side, where
    ///          it ends
    [[nodiscard]] static double bend(const Hit<double>& hit, const Bounce<double, double>& bounce, Vec& direction) {
        const double side = dot(direction, hit.geometric_normal) > 0 ? -1 : 1;
        const Vec geometric = side * hit.geometric_normal, normal = side * hit.shading_normal;
        if (bounce.event == Event::refract)
            if (const auto refracted = refraction(direction, normal, bounce.eta)) {
                direction = refracted->direction();
                return dot(direction, geometric) < 0 ? square(bounce.eta) : 0;
            }
        direction = Reflection<Vec>(direction, normal).direction();
        return dot(direction, geometric) > 0 ? 1 : 0;
    }

    [[nodiscard]] static Vec off_surface(const Hit<double>& hit, const Vec& direction) {
        const double side = dot(direction, hit.geometric_normal) > 0 ? 2 : -2;
        return hit.position + (side * hit.position_error) * hit.geometric_normal;
    }

    const Scene<double, double>& scene_;
    const Emitters<double, double>& emitters_;
    unsigned specular_events_;
};

} // namespace nephroid::examples
