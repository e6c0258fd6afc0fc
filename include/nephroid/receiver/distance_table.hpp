// SPDX-License-Identifier: MIT
/// @file  Distances in directions about each of many vertices, in two bytes each, and what follows from them.
#pragma once

#include "nephroid/footprint/kernel_mass.hpp"
#include "nephroid/receiver/compass.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::detail {

/// What of a kernel lies on the surface is taken as at least this much. Less is left in gaps that are far narrower than
/// the disk, and free distances are not exact to more.
inline constexpr double least_coverage = 0.05;

/// Free distances by slot and direction. Different threads may set those of different slots.
template <Scalar T>
class DistanceTable {
public:
    /// @param reach  the largest distance, world units; what is that far counts as free
    DistanceTable(std::size_t slots, std::size_t directions, T reach)
        : directions_(directions), reach_(reach), between_(directions_by_compass(directions)),
          distances_(slots * directions, most), nearest_(slots, reach) {}

    [[nodiscard]] T reach() const { return reach_; }
    [[nodiscard]] std::size_t directions() const { return directions_; }

    void set(std::size_t slot, std::size_t direction, T distance) {
        if (!(distance < reach_))
            return;
        distances_[slot * directions_ + direction] = std::uint16_t(double(distance / reach_) * double(most) + 0.5);
        nearest_[slot] = (std::min)(nearest_[slot], distance);
    }

    [[nodiscard]] T distance(std::size_t slot, std::size_t direction) const {
        return reach_ / T(most) * T(distances_[slot * directions_ + direction]);
    }
    /// The least of a slot's distances.
    [[nodiscard]] const T& nearest(std::size_t slot) const { return nearest_[slot]; }

    /// The share of a kernel's mass before the end of the surface, as `is_before_end` has it: the mean over all
    /// directions, four between each two of the table.
    template <class K>
    [[nodiscard]] T coverage(std::size_t slot, T radius, const K& kernel) const {
        if (!(nearest_[slot] < (std::min)(radius, reach_)))
            return T(1);
        const std::uint16_t* const distances = distances_.data() + slot * directions_;
        const T scale = reach_ / (T(most) * radius);
        const auto mass = [&](T d) { return mass_within(kernel, square(scale * d)); };
        T sum(0);
        for (std::size_t i = 0; i < directions_; ++i) {
            const T a = T(distances[i]), b = T(distances[i + 1 < directions_ ? i + 1 : 0]);
            if (is_free(a) && is_free(b))
                sum = sum + T(1);
            else if (jumps(a, b))
                sum = sum + T(0.5) * ((is_free(a) ? T(1) : mass(a)) + (is_free(b) ? T(1) : mass(b)));
            else if (a > T(0)) // else both are 0
                for (const T share : {T(0.125), T(0.375), T(0.625), T(0.875)})
                    sum = sum + T(0.25) * mass(a * b / ((T(1) - share) * b + share * a));
        }
        return sum / T(directions_);
    }

    /// Whether the surface ends within a distance of the vertex, in any direction.
    [[nodiscard]] bool ends_within(std::size_t slot, T distance2) const {
        return nearest_[slot] < reach_ && square(nearest_[slot]) <= distance2;
    }
    /// Whether a place is closer than the end of the surface in its direction. Between two directions the end is taken
    /// to lie on a straight line; if their distances differ by far, to jump in the middle.
    ///
    /// @param point  of the compass, of the place, see `compass_point`
    [[nodiscard]] bool is_before_end(std::size_t slot, T distance2, std::int32_t point) const {
        const BetweenDirections at = between_[std::size_t(point)];
        const std::uint16_t* const distances = distances_.data() + slot * directions_;
        const T a = T(distances[at.before]), b = T(distances[at.after]), share = T(at.share), unit = reach_ / T(most);
        if (jumps(a, b)) {
            const T end = share < T(0.5) ? a : b;
            return is_free(end) || distance2 < square(unit * end);
        }
        // On a line 1/distance is linear in the direction, but for a part in 200 of 32 directions.
        return (is_free(a) && is_free(b)) || distance2 * square((T(1) - share) * b + share * a) < square(unit * a * b);
    }

private:
    static constexpr std::uint16_t most = 0xffff; ///< stands for the reach: distances are stored as multiples of it

    [[nodiscard]] static bool is_free(T stored) { return stored == T(most); }
    [[nodiscard]] static bool jumps(T a, T b) { return a > T(4) * b || b > T(4) * a; }

    std::size_t directions_;
    T reach_;
    std::array<BetweenDirections, compass_points + 1> between_;
    std::vector<std::uint16_t> distances_; ///< by slot, then direction
    std::vector<T> nearest_;               ///< by slot
};

} // namespace nephroid::detail
