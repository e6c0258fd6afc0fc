// SPDX-License-Identifier: MIT
/// @file  Points of lamps for paths that end at them: drawn from a surface, and how likely the draw was for a path that
///        met the lamp by itself.
#pragma once

#include "common/direct_light.hpp"

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::examples {

/// A direction to a lamp.
template <class T, Flux F>
struct LampSample {
    Vec3<T> direction; ///< unit
    T distance;        ///< infinite for light from outside of the scene
    F light;           ///< radiance; of a lamp without area, irradiance across the direction
    double density;    ///< of directions, 1 / steradian; 0 for a lamp without area, which paths cannot meet
};

/// All lamps of a scene, each sampled by itself.
template <class T, Flux F>
class LampSamples {
public:
    /// The lamps are kept by reference, and must outlive this object.
    explicit LampSamples(const Lamps<T, F>& lamps) : lamps_(lamps) {
        for (const AreaLamp<T, F>& area : lamps.areas)
            areas_.emplace_back(area);
    }

    [[nodiscard]] std::size_t size() const { return lamps_.lamps.size() + areas_.size() + lamps_.environments.size(); }

    /// Draws a point of the i-th lamp; nothing if the place is on its dark side.
    template <class Sampler>
    [[nodiscard]] std::optional<LampSample<T, F>> draw(std::size_t i, const Vec3<T>& from, Sampler& sampler) const {
        if (i < lamps_.lamps.size())
            return from_lamp(lamps_.lamps[i], from);
        i -= lamps_.lamps.size();
        const double u1 = sampler.template next<double>(), u2 = sampler.template next<double>();
        if (i < areas_.size())
            return from_area(areas_[i], from, u1, u2);
        const auto drawn = lamps_.environments[i - areas_.size()]->sample(u1, u2);
        return LampSample<T, F>{drawn.towards, endless, drawn.radiance, double(drawn.density)};
    }

    /// Calls visit(radiance, density) for the lamp that a ray has hit, if it has hit one on its bright side; the
    /// density is that with which `draw` finds the same direction.
    template <class Visit>
    void at_hit(const Scene<T, F>& scene, const Hit<T>& hit, const Vec3<T>& direction, T distance,
                const Visit& visit) const {
        const Material<F>& material = scene.material(hit);
        const T cosine = dot(direction, hit.geometric_normal);
        if (!material.emits() || !(cosine < T(0) || material.emits_on_both_sides))
            return;
        for (std::size_t i = 0; i < areas_.size(); ++i)
            if (lamps_.areas[i].part == std::size_t(hit.primitive >> 32) && lamps_.areas[i].material == hit.surface)
                visit(areas_[i].radiance(),
                      double(square(distance)) / (double(abs(cosine)) * double(areas_[i].area())));
    }

    /// The same for a ray that has left the scene.
    template <class Visit>
    void outside(const Vec3<T>& direction, const Visit& visit) const {
        for (const auto& environment : lamps_.environments)
            visit(environment->radiance(direction), environment->density(direction));
    }

private:
    static constexpr T endless = std::numeric_limits<T>::infinity();

    [[nodiscard]] static std::optional<LampSample<T, F>> from_lamp(const Lamp<T, F>& lamp, const Vec3<T>& from) {
        if (lamp.kind == Lamp<T, F>::Kind::directional)
            return LampSample<T, F>{-lamp.direction, endless, lamp.intensity, 0};
        const Vec3<T> to_lamp = lamp.position - from;
        const T distance2 = length2(to_lamp), distance = std::sqrt(distance2);
        if (!(distance > T(0)))
            return std::nullopt;
        const Vec3<T> direction = T(1) / distance * to_lamp;
        const T shone = lamp.kind == Lamp<T, F>::Kind::spot ? lamp.falloff(-direction) : T(1);
        return LampSample<T, F>{direction, distance, lamp.intensity * (shone / distance2), 0};
    }

    [[nodiscard]] static std::optional<LampSample<T, F>> from_area(const detail::SampledAreaLamp<T, F>& lamp,
                                                                   const Vec3<T>& from, double u1, double u2) {
        const auto point = lamp.point(u1, T(u2));
        const Vec3<T> to_lamp = point.position - from;
        const T distance2 = length2(to_lamp), distance = std::sqrt(distance2);
        if (!(distance > T(0)))
            return std::nullopt;
        const Vec3<T> direction = T(1) / distance * to_lamp;
        const T cosine = -dot(direction, point.normal);
        if (!(cosine > T(0)))
            return std::nullopt;
        return LampSample<T, F>{direction, distance, lamp.radiance(),
                                double(distance2) / (double(cosine) * double(lamp.area()))};
    }

    const Lamps<T, F>& lamps_;
    std::vector<detail::SampledAreaLamp<T, F>> areas_;
};

} // namespace nephroid::examples
