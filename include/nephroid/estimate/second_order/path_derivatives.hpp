// SPDX-License-Identifier: MIT
/// @file  Second and third derivatives of the map from light to surface, fitted to photons and their tangents.
#pragma once

#include "nephroid/vector/plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace nephroid {

/// A vector of space in double precision, whatever the renderer's.
struct Space3 {
    double x = 0, y = 0, z = 0;

    Space3& operator+=(const Space3& o) {
        x += o.x, y += o.y, z += o.z;
        return *this;
    }
    friend Space3 operator+(const Space3& a, const Space3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Space3 operator-(const Space3& a, const Space3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Space3 operator*(double s, const Space3& a) { return {s * a.x, s * a.y, s * a.z}; }
    [[nodiscard]] friend double inner(const Space3& a, const Space3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

/// Derivatives of the landing point F by the two emission coordinates (EmissionFrame), about some point of the domain.
struct PathDerivatives {
    std::array<Space3, 2> first;  ///< J: F_u, F_v
    std::array<Space3, 3> second; ///< H: F_uu, F_uv, F_vv
    std::array<Space3, 4> third;  ///< T: F_uuu, F_uuv, F_uvv, F_vvv; 0 where there were too few photons for them
};

/// J at a displacement from where the derivatives are.
[[nodiscard]] inline std::array<Space3, 2> tangents_at(const PathDerivatives& map, Plane2 at) {
    const double xx = 0.5 * at.x * at.x, xy = at.x * at.y, yy = 0.5 * at.y * at.y;
    const auto& [h_uu, h_uv, h_vv] = map.second;
    const auto& [t_uuu, t_uuv, t_uvv, t_vvv] = map.third;
    return {map.first[0] + (at.x * h_uu + at.y * h_uv) + (xx * t_uuu + (xy * t_uuv + yy * t_uvv)),
            map.first[1] + (at.x * h_uv + at.y * h_vv) + (xx * t_uuv + (xy * t_uvv + yy * t_vvv))};
}

/// Second derivatives in other axes: `axes` takes the other frame's coordinates to those that `second` is by.
[[nodiscard]] inline std::array<Space3, 3> turned(const std::array<Space3, 3>& second, const PlaneMatrix& axes) {
    const auto along = [&](Plane2 a, Plane2 b) {
        return (a.x * b.x) * second[0] + ((a.x * b.y + a.y * b.x) * second[1] + (a.y * b.y) * second[2]);
    };
    return {along(axes.first, axes.first), along(axes.first, axes.second), along(axes.second, axes.second)};
}

/// A weighted least-squares fit of J(δ) = J + H δ + ½ T δ δ to the tangents of photons at displacements δ.
///
/// Their landing points are not used: tangents alone do not mind where a periodic floor wraps.
class PathFit {
public:
    /// @param at       displacement of the photon from where the derivatives are wanted
    /// @param tangents  J there, in the axes of the fit
    /// @param weight   > 0
    void add(Plane2 at, const std::array<Space3, 2>& tangents, double weight) {
        const double xx = 0.5 * at.x * at.x, xy = at.x * at.y, yy = 0.5 * at.y * at.y;
        const std::array<std::array<double, unknowns>, 2> rows = {
            {{1, 0, at.x, at.y, 0, xx, xy, yy, 0}, {0, 1, 0, at.x, at.y, 0, xx, xy, yy}}};
        for (std::size_t r = 0; r < 2; ++r)
            for (std::size_t i = 0; i < unknowns; ++i) {
                const double w = weight * rows[r][i];
                if (w == 0)
                    continue;
                for (std::size_t j = 0; j <= i; ++j)
                    normal_[i][j] += w * rows[r][j];
                right_[i] += w * tangents[r];
            }
        ++photons_;
    }

    /// @return  whether the photons determine at least J and H
    [[nodiscard]] bool solve(PathDerivatives& result) const {
        constexpr std::size_t without_third = 5;
        std::array<Space3, unknowns> x{};
        if (photons_ < 8 || !solve(unknowns, x)) {
            x = {};
            if (photons_ < 4 || !solve(without_third, x))
                return false;
        }
        result = {{x[0], x[1]}, {x[2], x[3], x[4]}, {x[5], x[6], x[7], x[8]}};
        return true;
    }

private:
    static constexpr std::size_t unknowns = 9;

    /// Of the first n unknowns, by Cholesky's decomposition of the matrix scaled to a unit diagonal.
    [[nodiscard]] bool solve(std::size_t n, std::array<Space3, unknowns>& x) const {
        constexpr double least_pivot = 1e-4; // of 1: what is left of a column after the others; rounding is far below
        std::array<double, unknowns> scale;
        for (std::size_t i = 0; i < n; ++i) {
            if (!(normal_[i][i] > 0))
                return false;
            scale[i] = 1 / std::sqrt(normal_[i][i]);
        }
        std::array<std::array<double, unknowns>, unknowns> l{};
        for (std::size_t i = 0; i < n; ++i) {
            Space3 b = scale[i] * right_[i];
            for (std::size_t j = 0; j <= i; ++j) {
                double sum = normal_[i][j] * scale[i] * scale[j];
                for (std::size_t k = 0; k < j; ++k)
                    sum -= l[i][k] * l[j][k];
                if (j < i) {
                    l[i][j] = sum / l[j][j];
                    b = b - l[i][j] * x[j];
                } else {
                    if (!(sum > least_pivot))
                        return false;
                    l[i][i] = std::sqrt(sum);
                    x[i] = (1 / l[i][i]) * b;
                }
            }
        }
        for (std::size_t i = n; i-- > 0;) {
            for (std::size_t k = i + 1; k < n; ++k)
                x[i] = x[i] - l[k][i] * x[k];
            x[i] = (1 / l[i][i]) * x[i];
        }
        for (std::size_t i = 0; i < n; ++i)
            x[i] = scale[i] * x[i];
        return true;
    }

    std::array<std::array<double, unknowns>, unknowns> normal_{}; // lower triangle
    std::array<Space3, unknowns> right_{};
    std::size_t photons_ = 0;
};

} // namespace nephroid
