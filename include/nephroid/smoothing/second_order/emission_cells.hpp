// SPDX-License-Identifier: MIT
/// @file  Photons of a light, sorted into the cells of a grid over its two emission coordinates.
#pragma once

#include "nephroid/emission/emission_sample.hpp"
#include "nephroid/emission/parameters.hpp"
#include "nephroid/smoothing/second_order/cell_contents.hpp"
#include "nephroid/smoothing/second_order/emission_frame.hpp"
#include "nephroid/smoothing/second_order/path_derivatives.hpp"
#include "nephroid/transport/deposit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nephroid::detail {

/// J: the halves of a deposit's first two tangents, which are its derivatives by the units of the emission frame.
template <Vector3 V, Flux F, std::size_t N>
[[nodiscard]] std::array<Double3, 2> half_tangents(const Deposit<V, F, N>& deposit) {
    using t = vector_traits<V>;
    const auto half = [](const V& v) {
        return Double3{0.5 * double(t::x(v)), 0.5 * double(t::y(v)), 0.5 * double(t::z(v))};
    };
    return {half(deposit.d_position[0]), half(deposit.d_position[1])};
}

/// A sample of the map from a light to the surfaces: one photon, in double precision whatever the renderer's scalar.
struct PathSample {
    EmissionSample sample;
    EmissionFrame frame;
    std::uint32_t signature = 0;       ///< of its path (PathSignature)
    bool has_landed = false;           ///< whether it reached a surface that receives it
    std::array<Double3, 2> tangents{}; ///< J, if it has landed
    Double3 place{};                   ///< where, if it has landed
};

/// A photon's sample of the map, and the deposit to splat.
///
/// @tparam P  the photon's parameters. A deposit of one with a wavelength has been moved to the spectrum's middle
template <Vector3 V, Flux F, std::size_t N, class P = NoParameters>
struct TracedPhoton : PathSample {
    using vector = V;

    std::optional<Deposit<V, F, N>> deposit; ///< nothing if it did not land
    [[no_unique_address]] P parameters{};

    TracedPhoton() = default;
    TracedPhoton(const EmissionSample& drawn, const EmissionFrame& emitted, std::uint32_t path,
                 const std::optional<Deposit<V, F, N>>& landed, const P& of_photon = {})
        : PathSample{drawn, emitted, path, landed.has_value(), {}, {}}, deposit(landed), parameters(of_photon) {
        if (landed) {
            tangents = half_tangents(*landed);
            place = double3(landed->position);
        }
    }
};

/// References to some photons of a light, without their deposits, so that fits are compiled once for all renderers'
/// types. The photons must outlive this object.
class PathSamples {
public:
    PathSamples() = default;
    /// @param photons  a random-access range of PathSample or of types derived from it
    template <class Photons>
        requires(!std::same_as<Photons, PathSamples>)
    explicit PathSamples(const Photons& photons) {
        samples_.reserve(photons.size());
        for (std::size_t i = 0; i < photons.size(); ++i)
            samples_.push_back(&photons[i]);
    }
    void add(const PathSample& photon) { samples_.push_back(&photon); }
    [[nodiscard]] std::size_t size() const { return samples_.size(); }
    [[nodiscard]] const PathSample& operator[](std::size_t i) const { return *samples_[i]; }

    /// The emission coordinates of the first `count` photons.
    [[nodiscard]] std::vector<std::array<double, 2>> coordinates(std::size_t count) const {
        std::vector<std::array<double, 2>> result;
        result.reserve(count);
        for (std::size_t i = 0; i < count; ++i)
            result.push_back(samples_[i]->sample.at);
        return result;
    }

private:
    std::vector<const PathSample*> samples_;
};

/// A grid over the unit square of emission coordinates, and the photons in each cell.
class EmissionCells {
public:
    static constexpr double photons_per_cell = 16;

    /// @param samples   emission coordinates of the photons, in their order
    /// @param aspect    length of the domain along the first coordinate over that along the second
    /// @param repeats   whether opposite borders of the domain are neighbours
    /// @param per_cell  photons in a cell, on average over the whole square, > 0
    EmissionCells(const std::vector<std::array<double, 2>>& samples, double aspect, bool repeats,
                  double per_cell = photons_per_cell)
        : repeats_(repeats) {
        const double cells = (std::max)(double(samples.size()) / per_cell, 1.0);
        const double most = cells;
        columns_ = std::size_t(std::lround(std::clamp(std::sqrt(cells * aspect), 1.0, most)));
        rows_ = std::size_t(std::lround(std::clamp(cells / double(columns_), 1.0, most)));

        contents_ = CellContents(size(), samples.size(), [&](std::size_t i) { return cell_of(samples[i]); });
    }

    [[nodiscard]] std::size_t size() const { return columns_ * rows_; }
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::size_t rows() const { return rows_; }
    [[nodiscard]] bool repeats() const { return repeats_; }
    [[nodiscard]] std::span<const std::uint32_t> photons(std::size_t cell) const { return contents_[cell]; }
    [[nodiscard]] std::size_t cell_of(const std::array<double, 2>& sample) const {
        const auto index = [](double u, std::size_t n) { return (std::min)(n - 1, std::size_t(u * double(n))); };
        return index(sample[1], rows_) * columns_ + index(sample[0], columns_);
    }
    /// The emission coordinates of a cell's middle.
    [[nodiscard]] std::array<double, 2> middle(std::size_t cell) const {
        return {(double(cell % columns_) + 0.5) / double(columns_), (double(cell / columns_) + 0.5) / double(rows_)};
    }
    /// The cell `dx` columns and `dy` rows away, each −1 to 1; nothing beyond the domain's border.
    [[nodiscard]] std::optional<std::size_t> neighbour(std::size_t cell, int dx, int dy) const {
        const auto column = step(cell % columns_, dx, columns_), row = step(cell / columns_, dy, rows_);
        if (!column || !row)
            return std::nullopt;
        return *row * columns_ + *column;
    }
    /// The step from one point of the domain to another; the shortest one where the domain repeats.
    [[nodiscard]] Plane2 step_between(const std::array<double, 2>& from, const std::array<double, 2>& to) const {
        const auto shorter = [this](double d) { return repeats_ ? d - std::round(d) : d; };
        return {shorter(to[0] - from[0]), shorter(to[1] - from[1])};
    }

private:
    [[nodiscard]] std::optional<std::size_t> step(std::size_t at, int by, std::size_t count) const {
        const auto to = std::ptrdiff_t(at) + by;
        if (to >= 0 && to < std::ptrdiff_t(count))
            return std::size_t(to);
        if (!repeats_)
            return std::nullopt;
        return to < 0 ? count - 1 : 0;
    }

    bool repeats_;
    std::size_t columns_ = 1, rows_ = 1;
    CellContents contents_;
};

/// Fits the matrix M in δ = M Δ to photons: Δ is a step between emission coordinates, δ the displacement in a
/// frame.
class StepFit {
public:
    void add(Plane2 step, Plane2 displacement) {
        steps_ += Symmetric2::outer(step);
        by_x_ = by_x_ + step.x * displacement;
        by_y_ = by_y_ + step.y * displacement;
    }

    /// @return  nothing if the steps do not span the plane
    [[nodiscard]] std::optional<PlaneMatrix> solve() const {
        const double d = steps_.determinant();
        if (!(d > 1e-6 * steps_.trace() * steps_.trace()))
            return std::nullopt;
        const PlaneMatrix m{(1 / d) * (steps_.yy * by_x_ + (-steps_.xy) * by_y_),
                            (1 / d) * (steps_.xx * by_y_ + (-steps_.xy) * by_x_)};
        if (!(std::abs(m.determinant()) > 0) || !std::isfinite(m.determinant()))
            return std::nullopt;
        return m;
    }

private:
    Symmetric2 steps_;
    Plane2 by_x_, by_y_;
};

} // namespace nephroid::detail
