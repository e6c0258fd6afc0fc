// SPDX-License-Identifier: MIT
/// @file  Fits the derivatives of the map from an area light to a surface to photons and their tangents.
#pragma once

#include "nephroid/smoothing/second_order/area_cells.hpp"
#include "nephroid/smoothing/second_order/emission_frame.hpp"
#include "nephroid/smoothing/second_order/roughness.hpp"
#include "nephroid/vector/least_squares.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// Two tangents, or how they change.
struct TangentPair {
    Double3 u, v;

    friend TangentPair operator+(const TangentPair& a, const TangentPair& b) { return {a.u + b.u, a.v + b.v}; }
    friend TangentPair operator-(const TangentPair& a, const TangentPair& b) { return {a.u - b.u, a.v - b.v}; }
    friend TangentPair operator*(double s, const TangentPair& a) { return {s * a.u, s * a.v}; }
    [[nodiscard]] friend double norm2(const TangentPair& a) { return inner(a.u, a.u) + inner(a.v, a.v); }
};

/// A photon's tangents, rotated about its ray so that they are aligned with another photon's.
///
/// @param rotation  `EmissionFrame::rotation_of` this photon, from the other photon's frame
[[nodiscard]] inline TangentPair rotated(const std::array<Double3, 2>& tangents, const PlaneMatrix& rotation) {
    return {rotation.first.x * tangents[0] + rotation.second.x * tangents[1],
            rotation.first.y * tangents[0] + rotation.second.y * tangents[1]};
}

/// Fits J(σ, τ) = J + H σ + M τ + ½ T σ σ to tangents. A step of σ changes position and direction by the same
/// amount, as the tangents do. A step of τ changes position forwards and direction backwards. So the position is σ +
/// τ and the direction σ − τ.
class AreaFit {
public:
    /// @param at        step from the frame's photon
    /// @param tangents  aligned with those of the frame (`rotated`)
    /// @param sample    emission coordinates, relative to the point at which the derivatives are wanted
    /// @param weight    > 0
    void add(const AreaStep& at, const TangentPair& tangents, const AreaSample& sample, double weight) {
        const std::array<double, 5> row{1, at.position.x, at.position.y, at.direction.x, at.direction.y};
        for (std::size_t i = 0; i < 4; ++i)
            samples_[i].add(row, sample[i], weight);
        photons_.push_back({at, tangents, weight});
    }

    /// @param result           gets J, H, and T (0 where there are too few photons)
    /// @param samples_by_step  gets the derivatives of the emission coordinates by σ
    /// @param rough            gets the `roughness` of the photons near the wanted point
    /// @return  whether the photons determine J, H, M and the wanted point's position
    [[nodiscard]] bool solve(PathDerivatives& result, std::array<Plane2, 4>& samples_by_step, double& rough) const {
        LeastSquares<4, double> wanted_point;
        for (std::size_t i = 0; i < 4; ++i) {
            std::array<double, 5> s;
            if (!samples_[i].solve(5, s))
                return false;
            samples_by_step[i] = {s[1] + s[3], s[2] + s[4]};
            wanted_point.add({s[1], s[2], s[3], s[4]}, -s[0], 1);
        }
        std::array<double, 4> zero;
        if (!wanted_point.solve(4, zero))
            return false;

        constexpr std::size_t without_third = 9;
        LeastSquares<unknowns, Double3> equations;
        double heaviest = 0;
        for (const Neighbour& photon : photons_)
            heaviest = (std::max)(heaviest, photon.weight);
        std::vector<std::pair<Row, Row>> near_rows;
        std::vector<TangentResidual> near_photons;
        for (const Neighbour& photon : photons_) {
            const Plane2 position = photon.at.position + Plane2{-zero[0], -zero[1]};
            const Plane2 direction = photon.at.direction + Plane2{-zero[2], -zero[3]};
            const Plane2 s = 0.5 * (position + direction), t = 0.5 * (position + -1.0 * direction);
            const double xx = 0.5 * s.x * s.x, xy = s.x * s.y, yy = 0.5 * s.y * s.y;
            const Row u{1, 0, s.x, s.y, 0, t.x, t.y, 0, 0, xx, xy, yy, 0},
                v{0, 1, 0, s.x, s.y, 0, 0, t.x, t.y, 0, xx, xy, yy};
            equations.add(u, photon.tangents.u, photon.weight);
            equations.add(v, photon.tangents.v, photon.weight);
            if (photon.weight > 0.4 * heaviest) { // roughness compares all pairs, which takes long for all photons
                near_rows.emplace_back(u, v);
                near_photons.push_back({{s.x, s.y, t.x, t.y}, {photon.tangents.u, photon.tangents.v}, {}});
            }
        }
        std::array<Double3, unknowns> x{};
        if ((photons_.size() < 12 || !equations.solve(unknowns, x)) &&
            (photons_.size() < 8 || !equations.solve(without_third, x)))
            return false;
        result = {{x[0], x[1]}, {x[2], x[3], x[4]}, {x[9], x[10], x[11], x[12]}};
        for (std::size_t i = 0; i < near_photons.size(); ++i) {
            near_photons[i].residual = near_photons[i].tangents;
            for (std::size_t k = 0; k < unknowns; ++k) {
                near_photons[i].residual[0] += -near_rows[i].first[k] * x[k];
                near_photons[i].residual[1] += -near_rows[i].second[k] * x[k];
            }
        }
        rough = roughness(tangent_jumps(near_photons));
        return true;
    }

private:
    static constexpr std::size_t unknowns = 13;
    using Row = std::array<double, unknowns>;

    struct Neighbour {
        AreaStep at;
        TangentPair tangents;
        double weight;
    };

    std::array<LeastSquares<5, double>, 4> samples_;
    std::vector<Neighbour> photons_;
};

} // namespace nephroid::detail
