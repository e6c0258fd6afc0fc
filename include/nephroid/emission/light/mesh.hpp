// SPDX-License-Identifier: MIT
/// @file  Triangles of constant radiance that emit on one side.
#pragma once

#include "nephroid/emission/light/area.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace nephroid {

/// Emits from triangles, on the side from which their vertices run counter-clockwise, with or without a target (see
/// `AreaEmission`). Draws 4 samples: two for the position, two for the direction. The first one chooses a triangle in
/// proportion to its area, and its remainder, scaled to [0, 1), is a coordinate in the triangle. It is drawn as a
/// double, so that enough digits remain.
template <class V, class F>
    requires detail::MustBeFluxFor<F, V>
class MeshLight {
public:
    using vector = V;
    using flux_type = F;
    using T = scalar_t<V>;
    static constexpr EmissionDomain domain{.coordinates = 4};
    using Triangle = std::array<V, 3>;

    struct Options {
        std::vector<Triangle> triangles; ///< vertices, world units; triangles without area are left out
        F radiance;                      ///< flux per area and steradian, >= 0
        /// Bounds of what the photons are aimed at, with a radius > 0; without them the light sends all of its light.
        std::optional<BoundingSphere<V>> target = std::nullopt;
    };

    /// Throws std::invalid_argument for a vertex that is not finite, no area at all, a negative radiance, a
    /// target whose radius is not positive.
    explicit MeshLight(const Options& options) : MeshLight(options, validated(options)) {}

    template <SampleSource<T> S>
        requires SampleSource<S, double>
    [[nodiscard]] Photon<V, F> emit(S& samples, const Spread<T>& spread) const {
        const double u1 = samples.template next<double>();
        const T u2 = samples.template next<T>();
        const T u3 = samples.template next<T>();
        const T u4 = samples.template next<T>();
        return emission_.emit(point(u1, u2), area_, u3, u4, spread);
    }

    /// The same light, aimed at what lies within a sphere.
    [[nodiscard]] MeshLight aimed_at(const BoundingSphere<V>& target) const {
        Options options{{}, emission_.radiance(), target};
        for (const Face& face : faces_)
            options.triangles.push_back({face.corner, face.corner + face.edge_1, face.corner + face.edge_2});
        return MeshLight(options);
    }

    [[nodiscard]] EmissionDomain exact_domain() const {
        return emission_.domain({Kinks::unknown, DomainEdge::ends}, faces_.front().corner, T(0));
    }

    /// Exact without a target, π radiance × area; otherwise estimated from 64 points of the triangles.
    [[nodiscard]] double power() const { return power_; }

private:
    struct Face {
        V corner;
        V edge_1;
        V edge_2;
        V normal;
    };

    /// Faces, and the sums of their areas up to and including each face.
    struct Faces {
        std::vector<Face> faces;
        std::vector<double> area_up_to;
        V middle; ///< of the surface
    };

    MeshLight(const Options& options, Faces all)
        : faces_(std::move(all.faces)), area_up_to_(std::move(all.area_up_to)), area_(T(area_up_to_.back())),
          emission_(options.radiance, options.target, LightPoint<V>{all.middle, faces_.front().normal}),
          power_(emission_.power(area_, [this](T u1, T u2) { return point(double(u1), u2); })) {}

    [[nodiscard]] static Faces validated(const Options& options) {
        const detail::Validator validate("MeshLight");
        validate.flux("radiance", options.radiance);
        validate.target(options.target);

        Faces all{{}, {}, zero_vector<V>()};
        double area = 0;
        for (const Triangle& triangle : options.triangles) {
            for (const V& vertex : triangle)
                validate.finite("vertex", vertex);
            const Face face = face_of(triangle);
            const T face_area = T(0.5) * length(cross(face.edge_1, face.edge_2));
            if (!(face_area > T(0)))
                continue;
            area += double(face_area);
            const V centroid = face.corner + T(1) / T(3) * (face.edge_1 + face.edge_2);
            all.middle = all.middle + T(double(face_area) / area) * (centroid - all.middle);
            all.faces.push_back(face);
            all.area_up_to.push_back(area);
        }
        validate.positive("area", T(area));
        return all;
    }

    [[nodiscard]] static Face face_of(const Triangle& triangle) {
        const V edge_1 = triangle[1] - triangle[0], edge_2 = triangle[2] - triangle[0];
        const V normal = cross(edge_1, edge_2);
        return {triangle[0], edge_1, edge_2, length2(normal) > scalar_t<V>(0) ? normalize(normal) : normal};
    }

    [[nodiscard]] LightPoint<V> point(double u1, T u2) const {
        const double area = u1 * area_up_to_.back();
        const auto found = std::upper_bound(area_up_to_.begin(), area_up_to_.end() - 1, area);
        const std::size_t i = static_cast<std::size_t>(found - area_up_to_.begin());
        const double before = i > 0 ? area_up_to_[i - 1] : 0;
        const double rest = (std::clamp)((area - before) / (area_up_to_[i] - before), 0.0, 1.0);
        const Face& face = faces_[i];
        const Barycentrics<T> b = triangle_point(T(rest), u2);
        return {face.corner + (b.b1 * face.edge_1 + b.b2 * face.edge_2), face.normal};
    }

    std::vector<Face> faces_;
    std::vector<double> area_up_to_;
    T area_;
    AreaEmission<V, F> emission_;
    double power_;
};

} // namespace nephroid
