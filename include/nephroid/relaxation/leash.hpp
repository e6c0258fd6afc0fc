// SPDX-License-Identifier: MIT
/// @file  How far photons may go from where they began.
#pragma once

#include "nephroid/vector/algebra.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace nephroid::detail {

/// Keeps each photon within a number of radii of where it began.
template <Scalar T>
class Leash {
public:
    /// @param tree    the photons where they begin
    /// @param length  in radii, > 0
    template <class Tree>
    Leash(const Tree& tree, T length)
        : starts_{std::vector<T>(tree.x(), tree.x() + tree.slots()), std::vector<T>(tree.y(), tree.y() + tree.slots()),
                  std::vector<T>(tree.z(), tree.z() + tree.slots())},
          radius_(tree.slots(), T(0)), length_(length) {}

    /// Where the photons began, by axis and slot.
    [[nodiscard]] const std::array<std::vector<T>, 3>& starts() const { return starts_; }

    /// A photon without a radius does not move at all.
    void set_radius(std::size_t slot, T radius) { radius_[slot] = radius; }
    [[nodiscard]] T radius(std::size_t slot) const { return radius_[slot]; }

    /// Where a photon may go: `to`, unless that is too far from where it began; then it stays.
    template <Vector3 V>
    [[nodiscard]] V held(std::size_t slot, const V& from, const V& to) const {
        const V start = make_vector<V>(starts_[0][slot], starts_[1][slot], starts_[2][slot]);
        return length2(V(to - start)) <= square(length_ * radius_[slot]) ? to : from;
    }

private:
    std::array<std::vector<T>, 3> starts_;
    std::vector<T> radius_;
    T length_;
};

} // namespace nephroid::detail
