// SPDX-License-Identifier: MIT
/// @file  The Fourier transform of a set of points at many integer frequencies, summed directly.
#pragma once

#include "nephroid/execution/executor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace nephroid::detail {

/// A point of the unit square that counts `weight` times.
struct WeightedPoint {
    double x = 0, y = 0;
    double weight = 1;
};

/// Four real sums over the weighted points. The transform is cc − ss − i (sc + cs) at (i, j) and cc + ss − i (sc
/// − cs) at (i, −j): the sums of one quarter of the plane give two quarters, and the other two are their
/// conjugates.
struct TrigonometricSums {
    double cc = 0; ///< Σ cos(2π i x) cos(2π j y)
    double cs = 0; ///< Σ cos(2π i x) sin(2π j y)
    double sc = 0; ///< Σ sin(2π i x) cos(2π j y)
    double ss = 0; ///< Σ sin(2π i x) sin(2π j y)

    /// |Σ w exp(−2πi f·x)|² at f = (i, j).
    [[nodiscard]] double square() const { return (cc - ss) * (cc - ss) + (sc + cs) * (sc + cs); }
    /// At f = (i, −j).
    [[nodiscard]] double mirrored_square() const { return (cc + ss) * (cc + ss) + (sc - cs) * (sc - cs); }
};

/// Number of frequencies that are summed together. Their sums stay in registers.
inline constexpr std::size_t sum_lanes = 8;
using SumLanes = std::array<float, sum_lanes>;

/// cos and sin of 2π j y for a block of points; group g holds the frequencies j = g · sum_lanes + lane.
class WaveTable {
public:
    struct Entry {
        SumLanes cosine, sine;
    };

    WaveTable(std::size_t frequencies, std::size_t most_points)
        : groups_((frequencies + sum_lanes - 1) / sum_lanes), stride_(most_points), entries_(groups_ * most_points) {}

    /// Rotates each lane by sum_lanes frequencies from group to group, in double: after g rotations the error is about
    /// g epsilon.
    void fill(std::span<const WeightedPoint> points) {
        for (std::size_t p = 0; p < points.size(); ++p) {
            const double angle = 2 * std::numbers::pi * points[p].y;
            std::array<double, sum_lanes> cosine, sine;
            for (std::size_t lane = 0; lane < sum_lanes; ++lane) {
                cosine[lane] = std::cos(angle * static_cast<double>(lane));
                sine[lane] = std::sin(angle * static_cast<double>(lane));
            }
            const double turn_cosine = std::cos(angle * sum_lanes), turn_sine = std::sin(angle * sum_lanes);
            for (std::size_t group = 0; group < groups_; ++group) {
                Entry& entry = entries_[group * stride_ + p];
                for (std::size_t lane = 0; lane < sum_lanes; ++lane) {
                    const double c = cosine[lane], s = sine[lane];
                    entry.cosine[lane] = static_cast<float>(c);
                    entry.sine[lane] = static_cast<float>(s);
                    cosine[lane] = c * turn_cosine - s * turn_sine;
                    sine[lane] = s * turn_cosine + c * turn_sine;
                }
            }
        }
    }

    [[nodiscard]] const Entry* group(std::size_t g) const { return entries_.data() + g * stride_; }

private:
    std::size_t groups_, stride_;
    std::vector<Entry> entries_;
};

/// Weighted cos and sin of 2π i x of one point.
struct Wave {
    float cosine, sine;
};

/// Adds a block of points to the sums of one frequency along x and sum_lanes along y.
inline void add_block(std::span<const Wave> waves, const WaveTable::Entry* table, TrigonometricSums* sums) {
    SumLanes cc{}, cs{}, sc{}, ss{};
    for (std::size_t p = 0; p < waves.size(); ++p) {
        const float c = waves[p].cosine, s = waves[p].sine;
        const WaveTable::Entry& entry = table[p];
        for (std::size_t lane = 0; lane < sum_lanes; ++lane) {
            cc[lane] += c * entry.cosine[lane];
            cs[lane] += c * entry.sine[lane];
            sc[lane] += s * entry.cosine[lane];
            ss[lane] += s * entry.sine[lane];
        }
    }
    for (std::size_t lane = 0; lane < sum_lanes; ++lane) {
        sums[lane].cc += static_cast<double>(cc[lane]);
        sums[lane].cs += static_cast<double>(cs[lane]);
        sums[lane].sc += static_cast<double>(sc[lane]);
        sums[lane].ss += static_cast<double>(ss[lane]);
    }
}

/// The sums at all frequencies (i, j) with 0 <= i, j and i² + j² <= highest². They cost 4 · points · π/4 ·
/// highest² multiplications and additions in single precision.
///
/// @param points    finite, not checked
/// @param highest   frequency, cycles per side of the unit square
/// @param executor  the sums do not depend on it, bit for bit
/// @return  row i, column j at [i * (highest + 1) + j]; beyond `highest` zero. Blocks of 64 points are summed in single
///          precision and the blocks in double, so a sum is known to about 1e-7 sqrt(points).
template <Executor E = SerialExecutor>
[[nodiscard]] std::vector<TrigonometricSums> trigonometric_sums(std::span<const WeightedPoint> points,
                                                                std::size_t highest, E&& executor = E{}) {
    constexpr std::size_t rows = 16, block = 64; // rows of frequencies in a task, points in a table
    const std::size_t side = highest + 1;
    std::vector<TrigonometricSums> all(side * side);
    executor((side + rows - 1) / rows, [&](std::size_t task) {
        const std::size_t first = task * rows, last = (std::min)(first + rows, side);
        // The longest row of the task is its first one, as the frequencies fill a quarter disk.
        const double reach = std::sqrt(static_cast<double>(highest * highest - first * first));
        const std::size_t groups = static_cast<std::size_t>(reach) / sum_lanes + 1;
        const std::size_t width = groups * sum_lanes;
        WaveTable table(width, block);
        std::vector<TrigonometricSums> sums((last - first) * width);
        std::vector<Wave> waves(block);
        for (std::size_t begin = 0; begin < points.size(); begin += block) {
            const auto some = points.subspan(begin, (std::min)(block, points.size() - begin));
            table.fill(some);
            for (std::size_t i = first; i < last; ++i) {
                for (std::size_t p = 0; p < some.size(); ++p) {
                    const double angle = 2 * std::numbers::pi * static_cast<double>(i) * some[p].x;
                    waves[p] = {static_cast<float>(some[p].weight * std::cos(angle)),
                                static_cast<float>(some[p].weight * std::sin(angle))};
                }
                for (std::size_t group = 0; group < groups; ++group)
                    add_block(std::span(waves).first(some.size()), table.group(group),
                              sums.data() + (i - first) * width + group * sum_lanes);
            }
        }
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t j = 0; j < (std::min)(width, side) && i * i + j * j <= highest * highest; ++j)
                all[i * side + j] = sums[(i - first) * width + j];
    });
    return all;
}

} // namespace nephroid::detail
