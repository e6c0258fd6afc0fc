// SPDX-License-Identifier: MIT
/// @file  What a caustic map's lines of sight meet: the first diffuse surface. Mirrors and glass are looked through, as
///        their light is what the map is for.
#pragma once

#include "nephroid/image/caustic_map.hpp"
#include "nephroid/sheet/node_tracer.hpp"
#include "nephroid/transport/ray_start.hpp"
#include "nephroid/transport/scene.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace nephroid {

/// Traces lines of sight through a scene.
///
/// ```cpp
/// nephroid::CausticMap<Vec3, Colour, nephroid::LightChart> map(
///     nephroid::LightChart(lamp, centre, radius, 1024), nephroid::SeeReceiver<Scene, Vec3>(scene));
/// ```
template <class S, Vector3 V>
    requires RayTracer<S, V>
class SeeReceiver {
public:
    /// @param scene  kept by reference
    explicit SeeReceiver(const S& scene) : scene_(scene) {}

    [[nodiscard]] std::optional<ReceiverPoint> operator()(const RasterRay& ray) const {
        using T = scalar_t<V>;
        V origin = detail::to_world<V>(ray.origin);
        const V direction = detail::to_world<V>(ray.direction);
        for (int surface = 0; surface < most_surfaces; ++surface) {
            const auto hit = scene_.intersect(origin, direction, T(0), std::numeric_limits<T>::infinity());
            if (!hit)
                return std::nullopt;
            const T distance = T((*hit).distance);
            V position = origin + distance * direction;
            if constexpr (HasPosition<hit_t<S, V>, V>)
                position = (*hit).position;
            detail::NoChance sampler;
            const typename detail::medium_of<S, V>::type medium{};
            const Event event = detail::scatter_in(medium, scene_, *hit, direction, sampler).event;
            if (event == Event::deposit || event == Event::diffuse) {
                const V normal = (*hit).geometric_normal;
                const T side = dot(normal, direction) > T(0) ? T(-1) : T(1);
                return ReceiverPoint{detail::double3(position), detail::double3(V(side * normal))};
            }
            if (event == Event::absorb)
                return std::nullopt;
            origin = origin + (distance + (std::max)(detail::ray_clearance(*hit, position), T(0))) * direction;
        }
        return std::nullopt;
    }

private:
    static constexpr int most_surfaces = 64;

    const S& scene_;
};

} // namespace nephroid
