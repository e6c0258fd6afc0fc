// SPDX-License-Identifier: MIT
/// @file  The lamp that is dragged: a point whose light goes to the surfaces that bend it, and nowhere else.
#pragma once

#include "openings.hpp"

#include <nephroid/emission/chart/emission_chart.hpp>
#include <nephroid/emission/light.hpp>
#include <nephroid/vector/frame.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace nephroid::examples::web {

/// Emits the light of a point lamp that passes a scene's openings. Each opening is a chart of its own; splatted photons
/// are divided among them by flux.
struct PointThroughOpenings {
    using vector = Vec;
    using flux_type = float;
    static constexpr EmissionDomain domain{.coordinates = 2, .kinks = {Kinks::unknown}}; ///< between openings

    Vec position;
    float intensity; ///< flux per steradian
    Openings openings;

    template <class Samples>
    [[nodiscard]] Photon<Vec, float> emit(Samples& samples, const Spread<float>& spread) const {
        const float u = samples.template next<float>(), v = samples.template next<float>();
        std::size_t which = 0;
        float from = 0, share = share_of(0);
        while (which + 1 < openings.size && u >= from + share)
            from += share, share = share_of(++which);
        const float within = (std::min)((u - from) / share, 1.f);
        const Light at = light_at(openings.list[which], within, v);
        // Two orthogonal directions that enclose the photon's solid angle.
        const float solid_angle = at.solid_angle / share, length = spread.length(solid_angle);
        const Frame<Vec> frame = frame_about(at.direction);
        const Vec zero(0);
        return {position,
                at.direction,
                intensity * solid_angle / spread.photons,
                {Tangent<Vec>{zero, length * frame.u}, Tangent<Vec>{zero, length * frame.v}}};
    }

    [[nodiscard]] EmissionCharts<Vec, float> charts() const {
        EmissionCharts<Vec, float> charts;
        for (std::size_t i = 0; i < openings.size; ++i) {
            EmissionChart<Vec, float> chart;
            chart.emit = [lamp = *this, i](float u, float v) -> std::optional<Photon<Vec, float, 0>> {
                const Light at = lamp.light_at(lamp.openings.list[i], u, v);
                return Photon<Vec, float, 0>{lamp.position, at.direction, lamp.intensity * at.solid_angle, {}};
            };
            chart.width = double(openings.list[i].width()), chart.height = double(openings.list[i].height());
            chart.power = double(intensity) * power_of(openings.list[i]);
            charts.push_back(std::move(chart));
        }
        return charts;
    }

    [[nodiscard]] double power() const {
        double sum = 0;
        for (std::size_t i = 0; i < openings.size; ++i)
            sum += power_of(openings.list[i]);
        return double(intensity) * sum;
    }

private:
    struct Light {
        Vec direction;
        float solid_angle; ///< steradian per unit of the opening's square
    };
    [[nodiscard]] Light light_at(const Opening& opening, float u, float v) const {
        const Opening::Point to = opening.at(u, v);
        const Vec way = to.position - position;
        const float distance2 = glm::dot(way, way);
        const Vec direction = way / std::sqrt(distance2);
        return {direction, (std::max)(-glm::dot(direction, to.normal), 0.f) * to.area / distance2};
    }

    /// The solid angle of an opening, by the midpoint rule.
    [[nodiscard]] double power_of(const Opening& opening) const {
        constexpr int n = 16;
        double sum = 0;
        for (int i = 0; i < n * n; ++i)
            sum += double(light_at(opening, (float(i % n) + 0.5f) / n, (float(i / n) + 0.5f) / n).solid_angle);
        return sum / (n * n);
    }
    /// By area, which needs no sum for each photon.
    [[nodiscard]] float share_of(std::size_t i) const {
        const auto size = [this](std::size_t j) { return openings.list[j].width() * openings.list[j].height(); };
        float sum = 0;
        for (std::size_t j = 0; j < openings.size; ++j)
            sum += size(j);
        return size(i) / sum;
    }
};

static_assert(nephroid::Light<PointThroughOpenings>);

} // namespace nephroid::examples::web
