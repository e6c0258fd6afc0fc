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

    /// The mean over the directions of a kernel's mass within the distance.
    template <class K>
    [[nodiscard]] T coverage(std::size_t slot, T radius, const K& kernel) const {
        if (!(nearest_[slot] < (std::min)(radius, reach_)))
            return T(1);
        const std::uint16_t* const distances = distances_.data() + slot * directions_;
        const T scale = reach_ / (T(most) * radius);
        T sum(0);
        for (std::size_t i = 0; i < directions_; ++i)
            sum = sum + (distances[i] == most ? T(1) : mass_within(kernel, square(scale * T(distances[i]))));
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
        if (a > T(4) * b || b > T(4) * a)
            return distance2 < square(unit * (share < T(0.5) ? a : b));
        // On a line 1/distance is linear in the direction, but for a part in 200 of 32 directions.
        return (distances[at.before] == most && distances[at.after] == most) ||
               distance2 * square((T(1) - share) * b + share * a) < square(unit * a * b);
    }

private:
    static constexpr std::uint16_t most = 0xffff; ///< stands for the reach: distances are stored as multiples of it

    std::size_t directions_;
    T reach_;
    std::array<BetweenDirections, compass_points + 1> between_;
    std::vector<std::uint16_t> distances_; ///< by slot, then direction
    std::vector<T> nearest_;               ///< by slot
};

} // namespace nephroid::detail
