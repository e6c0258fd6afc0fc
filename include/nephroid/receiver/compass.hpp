// SPDX-License-Identifier: MIT
/// @file  Directions about vertices, found without an angle, for many vertices at once.
#pragma once

#include "nephroid/vector/algebra.hpp"
#include "nephroid/vector/frame.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// How many points a compass has: equal parts of the square |x| + |y| = 1, which need no angle.
inline constexpr std::size_t compass_points = 1024;

/// The point of the compass that an offset's projection across a normal lies at, from the first axis of the frame about
/// the normal. A quarter of the way round for an offset along the normal.
///
/// @param nx, ny, nz  normal, unit
/// @param dx, dy, dz  offset
template <Scalar T>
[[nodiscard]] std::int32_t compass_point(T nx, T ny, T nz, T dx, T dy, T dz) {
    const T sign = nz < T(0) ? T(-1) : T(1), a = T(-1) / (sign + nz), b = nx * ny * a; // as in frame_about
    const T x = (T(1) + sign * nx * nx * a) * dx + sign * (b * dy - nx * dz);
    const T y = b * dx + (sign + ny * ny * a) * dy - ny * dz;
    const T along = x / (abs(x) + abs(y) + (std::numeric_limits<T>::min)()); // falls over the upper half, then rises
    const T quarters = y < T(0) ? T(3) + along : T(1) - along;
    return std::int32_t(quarters * T(compass_points / 4));
}

/// Where a point of the compass lies among directions.
struct BetweenDirections {
    std::uint8_t before, after; ///< the directions on both sides
    float share;                ///< of the way from one to the other, in [0, 1]
};

/// For each point of the compass, where its middle lies among the directions at (i + 1/2)/count of a full turn. One
/// point more, as rounding may lead to the end.
[[nodiscard]] inline std::array<BetweenDirections, compass_points + 1> directions_by_compass(std::size_t count) {
    std::array<BetweenDirections, compass_points + 1> directions{};
    for (std::size_t i = 0; i <= compass_points; ++i) {
        const double quarters = (double(i % compass_points) + 0.5) / double(compass_points / 4);
        const double x = quarters < 2 ? 1 - quarters : quarters - 3, y = 1 - std::abs(x);
        const double turn = std::atan2(quarters < 2 ? y : -y, x) / (2 * pi<double>);
        const double at = (turn < 0 ? turn + 1 : turn) * double(count) + double(count) - 0.5;
        const auto before = std::size_t(at);
        directions[i] = {std::uint8_t(before % count), std::uint8_t((before + 1) % count), float(at - double(before))};
    }
    return directions;
}

} // namespace nephroid::detail
