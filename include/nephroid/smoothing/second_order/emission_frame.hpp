// SPDX-License-Identifier: MIT
/// @file  The frame that a photon's tangents span in its light's domain, and other photons' coordinates in it.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/vector/plane.hpp"

#include <array>

namespace nephroid::detail {

/// The step from one photon of an area light to another: in position, in units of the half tangents' displacements, and
/// in direction, in units of their changes of direction.
struct AreaStep {
    Plane2 position, direction;
};

/// A coordinate system in the domain with its origin at a photon. One unit along an axis is half of that tangent,
/// u0 = s sqrt(domain / (π N)), so that a photon stands for π square units at s = 1.
///
/// Along a tangent a light may change the photon's position (directional light), its direction (point light) or both.
class EmissionFrame {
public:
    EmissionFrame() = default;

    template <Vector3 V, Flux F, std::size_t N>
        requires(N >= 2)
    explicit EmissionFrame(const Photon<V, F, N>& photon) : ray_(coordinates(photon.position, photon.direction)) {
        for (std::size_t a = 0; a < 2; ++a)
            axes_[a] = coordinates(photon.differential[a].d_position, photon.differential[a].d_direction);
        gram_ = {dot(axes_[0], axes_[0]), dot(axes_[0], axes_[1]), dot(axes_[1], axes_[1])};
    }

    /// Whether the two tangents span anything.
    [[nodiscard]] bool is_regular() const {
        return gram_.determinant() > 1e-6 * gram_.xx * gram_.yy && std::isfinite(gram_.trace());
    }

    /// The coordinates of another photon.
    [[nodiscard]] Plane2 displacement_to(const EmissionFrame& other) const {
        Ray difference;
        for (std::size_t i = 0; i < difference.size(); ++i)
            difference[i] = other.ray_[i] - ray_[i];
        return 2 * solve({dot(axes_[0], difference), dot(axes_[1], difference)});
    }

    /// The other frame's axes in this frame: a displacement v in the other frame is `axes_of(other)(v)` in this one.
    [[nodiscard]] PlaneMatrix axes_of(const EmissionFrame& other) const {
        return {solve({dot(axes_[0], other.axes_[0]), dot(axes_[1], other.axes_[0])}),
                solve({dot(axes_[0], other.axes_[1]), dot(axes_[1], other.axes_[1])})};
    }

    /// Whether position and direction both change along both tangents, as an area light's do: four coordinates in all.
    [[nodiscard]] bool is_of_area() const {
        const auto spans = [this](std::size_t part) {
            const Symmetric2 gram = gram_of(part);
            return gram.determinant() > 1e-6 * gram.xx * gram.yy && std::isfinite(gram.trace());
        };
        return spans(0) && spans(3);
    }

    /// The step to another photon of an area light; `is_of_area` must hold.
    [[nodiscard]] AreaStep step_to(const EmissionFrame& other) const {
        const auto part = [&](std::size_t first) {
            Plane2 along;
            for (std::size_t i = first; i < first + 3; ++i)
                along = along + (other.ray_[i] - ray_[i]) * Plane2{axes_[0][i], axes_[1][i]};
            return 2 * solve(gram_of(first), along);
        };
        return {part(0), part(3)};
    }

    /// The rotation of the other photon's tangents about its ray against these: a vector v in the other frame is
    /// `rotation_of(other)(v)` in this one. It is found from directions alone; `is_of_area` must hold.
    [[nodiscard]] PlaneMatrix rotation_of(const EmissionFrame& other) const {
        const auto along = [&](std::size_t axis) {
            Plane2 v;
            for (std::size_t i = 3; i < 6; ++i)
                v = v + other.axes_[axis][i] * Plane2{axes_[0][i], axes_[1][i]};
            return solve(gram_of(3), v);
        };
        const Plane2 u = along(0), v = along(1);
        const double c = u.x + v.y, s = u.y - v.x, norm = std::hypot(c, s); // the nearest rotation
        return norm > 0 ? PlaneMatrix{{c / norm, s / norm}, {-s / norm, c / norm}} : PlaneMatrix{{1, 0}, {0, 1}};
    }

private:
    using Ray = std::array<double, 6>;

    template <class V>
    [[nodiscard]] static Ray coordinates(const V& position, const V& direction) {
        using t = vector_traits<V>;
        return {double(t::x(position)),  double(t::y(position)),  double(t::z(position)),
                double(t::x(direction)), double(t::y(direction)), double(t::z(direction))};
    }

    [[nodiscard]] static double dot(const Ray& a, const Ray& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.size(); ++i)
            sum += a[i] * b[i];
        return sum;
    }

    [[nodiscard]] static Plane2 solve(const Symmetric2& gram, Plane2 v) {
        const double d = 1 / gram.determinant();
        return {d * (gram.yy * v.x - gram.xy * v.y), d * (gram.xx * v.y - gram.xy * v.x)};
    }
    [[nodiscard]] Plane2 solve(Plane2 v) const { return solve(gram_, v); }

    /// The Gram matrix of the axes' positions (first = 0) or directions (first = 3).
    [[nodiscard]] Symmetric2 gram_of(std::size_t first) const {
        Symmetric2 gram;
        for (std::size_t i = first; i < first + 3; ++i)
            gram += Symmetric2::outer({axes_[0][i], axes_[1][i]});
        return gram;
    }

    Ray ray_{};
    std::array<Ray, 2> axes_{};
    Symmetric2 gram_{};
};

} // namespace nephroid::detail
