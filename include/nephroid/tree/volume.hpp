// SPDX-License-Identifier: MIT
/// @file  The concept of a volume that a tree is searched for: it says whether it overlaps a box.
#pragma once

#include "nephroid/tree/normal_cone.hpp"

#include <concepts>

namespace nephroid {

/// `volume.overlaps(box)` returns whether a part of the volume may lie in the box. It may return true if none does;
/// then a leaf is visited in vain. It must not return false if some does. Boxes are relative to the tree's origin, and
/// may be flat.
///
/// Box and ConvexVolume are volumes; a renderer's own one needs only this member.
template <class Q, class T>
concept Volume = Scalar<T> && requires(const Q volume, const Box<T> box) {
    { volume.overlaps(box) } -> std::convertible_to<bool>;
};

/// A volume with a condition on normals: `volume.faces(cone)` returns whether one of the cone's normals may satisfy it.
/// A tree with normals then skips the nodes in which none does; other trees ignore the condition.
template <class Q, class T>
concept FacingVolume = Volume<Q, T> && requires(const Q volume, const NormalCone<T> cone) {
    { volume.faces(cone) } -> std::convertible_to<bool>;
};

/// The part of a volume in which surfaces face a direction.
///
/// ```cpp
/// map.visit_leaves(Facing{box, std::array{0.f, 0.f, 1.f}}, visit); // what may be lit from above
/// ```
template <Scalar T, Volume<T> Q>
struct Facing {
    Q volume;
    std::array<T, 3> direction; ///< unit, away from the surfaces

    [[nodiscard]] constexpr bool overlaps(const Box<T>& box) const { return volume.overlaps(box); }
    [[nodiscard]] constexpr bool faces(const NormalCone<T>& cone) const {
        return cone.facing(direction[0], direction[1], direction[2]).some;
    }
};
template <class Q, Scalar T>
Facing(Q, std::array<T, 3>) -> Facing<T, Q>;

namespace detail {
template <class Q, class T>
consteval bool explain_volume() {
    static_assert(Volume<Q, T>, "nephroid: a volume must have a member overlaps(const Box<T>& box) const -> bool "
                                "(tree/volume.hpp)");
    return false;
}

template <class Q, class T>
concept MustBeVolume = Volume<Q, T> || explain_volume<Q, T>();
} // namespace detail

} // namespace nephroid
