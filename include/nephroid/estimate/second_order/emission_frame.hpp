// SPDX-License-Identifier: MIT
/// @file  Where photons lie from one another in their light's domain, in the coordinates of their own tangents.
#pragma once

#include "nephroid/emission/photon.hpp"
#include "nephroid/vector/plane.hpp"

#include <array>

namespace nephroid {

/// A photon at emission as the origin of coordinates: one unit along an axis is half of the length of that tangent,
/// u0 = s sqrt(domain / (π N)), so that a photon stands for π square units at s = 1.
///
/// A light may vary a photon's position (directional light), its direction (point light) or both along a tangent.
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

    /// Where another photon was emitted.
    [[nodiscard]] Plane2 to(const EmissionFrame& other) const {
        Ray difference;
        for (std::size_t i = 0; i < difference.size(); ++i)
            difference[i] = other.ray_[i] - ray_[i];
        return 2 * solve({dot(axes_[0], difference), dot(axes_[1], difference)});
    }

    /// The other's axes in these: a displacement of coordinates v there is `axes_of(other)(v)` here.
    [[nodiscard]] PlaneMatrix axes_of(const EmissionFrame& other) const {
        return {solve({dot(axes_[0], other.axes_[0]), dot(axes_[1], other.axes_[0])}),
                solve({dot(axes_[0], other.axes_[1]), dot(axes_[1], other.axes_[1])})};
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

    [[nodiscard]] Plane2 solve(Plane2 v) const {
        const double d = 1 / gram_.determinant();
        return {d * (gram_.yy * v.x - gram_.xy * v.y), d * (gram_.xx * v.y - gram_.xy * v.x)};
    }

    Ray ray_{};
    std::array<Ray, 2> axes_{};
    Symmetric2 gram_{};
};

} // namespace nephroid
