// SPDX-License-Identifier: MIT
/// @file  Fits the second and third derivatives of the map from light to surface to photons and their tangents.
#pragma once

#include "nephroid/vector/double3.hpp"
#include "nephroid/vector/least_squares.hpp"
#include "nephroid/vector/plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid::detail {

/// Derivatives of the landing point F by the two coordinates of an EmissionFrame, at a point of the domain.
struct PathDerivatives {
    std::array<Double3, 2> first;  ///< J: F_u, F_v
    std::array<Double3, 3> second; ///< H: F_uu, F_uv, F_vv
    std::array<Double3, 4> third;  ///< T: F_uuu, F_uuv, F_uvv, F_vvv; 0 where too few photons determined them
};

/// J at a displacement from the point of the derivatives.
[[nodiscard]] inline std::array<Double3, 2> tangents_at(const PathDerivatives& map, Plane2 at) {
    const double xx = 0.5 * at.x * at.x, xy = at.x * at.y, yy = 0.5 * at.y * at.y;
    const auto& [h_uu, h_uv, h_vv] = map.second;
    const auto& [t_uuu, t_uuv, t_uvv, t_vvv] = map.third;
    return {map.first[0] + (at.x * h_uu + at.y * h_uv) + (xx * t_uuu + (xy * t_uuv + yy * t_uvv)),
            map.first[1] + (at.x * h_uv + at.y * h_vv) + (xx * t_uuv + (xy * t_uvv + yy * t_vvv))};
}

/// F(δ) − F(0): the displacement of where photons land.
[[nodiscard]] inline Double3 displacement_by(const PathDerivatives& map, Plane2 at) {
    const double x = at.x, y = at.y;
    const auto& [h_uu, h_uv, h_vv] = map.second;
    const auto& [t_uuu, t_uuv, t_uvv, t_vvv] = map.third;
    return (x * map.first[0] + y * map.first[1]) + 0.5 * ((x * x) * h_uu + ((2 * x * y) * h_uv + (y * y) * h_vv)) +
           (1.0 / 6) *
               (((x * x * x) * t_uuu + (3 * x * x * y) * t_uuv) + ((3 * x * y * y) * t_uvv + (y * y * y) * t_vvv));
}

/// Second derivatives by the coordinates of another frame.
///
/// @param axes  takes coordinates in the other frame to those of `second`
[[nodiscard]] inline std::array<Double3, 3> rotated(const std::array<Double3, 3>& second, const PlaneMatrix& axes) {
    const auto along = [&](Plane2 a, Plane2 b) {
        return (a.x * b.x) * second[0] + ((a.x * b.y + a.y * b.x) * second[1] + (a.y * b.y) * second[2]);
    };
    return {along(axes.first, axes.first), along(axes.first, axes.second), along(axes.second, axes.second)};
}

/// A weighted least-squares fit of J(δ) = J + H δ + ½ T δ δ to the tangents of photons at displacements δ.
///
/// Landing points are not used, because they jump where a periodic floor wraps around and tangents do not.
class PathFit {
public:
    /// @param at        displacement of the photon from the point at which the derivatives are wanted
    /// @param tangents  the photon's J, in the axes of the fit
    /// @param weight    > 0
    void add(Plane2 at, const std::array<Double3, 2>& tangents, double weight) {
        const double xx = 0.5 * at.x * at.x, xy = at.x * at.y, yy = 0.5 * at.y * at.y;
        equations_.add({1, 0, at.x, at.y, 0, xx, xy, yy, 0}, tangents[0], weight);
        equations_.add({0, 1, 0, at.x, at.y, 0, xx, xy, yy}, tangents[1], weight);
        ++photons_;
    }

    /// @return  whether the photons determine at least J and H
    [[nodiscard]] bool solve(PathDerivatives& result) const {
        constexpr std::size_t unknowns = 9, without_third = 5;
        std::array<Double3, unknowns> x{};
        if ((photons_ < 8 || !equations_.solve(unknowns, x)) && (photons_ < 4 || !equations_.solve(without_third, x)))
            return false;
        result = {{x[0], x[1]}, {x[2], x[3], x[4]}, {x[5], x[6], x[7], x[8]}};
        return true;
    }

private:
    LeastSquares<9, Double3> equations_;
    std::size_t photons_ = 0;
};

} // namespace nephroid::detail
