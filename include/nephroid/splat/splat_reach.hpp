// SPDX-License-Identifier: MIT
/// @file  Which leaves of an eye path map a splat overlaps, and which conditions must be checked for each vertex there.
#pragma once

#include "nephroid/splat/splat.hpp"
#include "nephroid/vector/not_unrolled.hpp"

#include <array>
#include <cstdint>
#include <limits>

namespace nephroid::detail {

/// How a leaf and a splat overlap.
struct LeafMeeting {
    bool meets;          ///< false only if no vertex lies inside the outline and faces the photon
    bool checks_height;  ///< whether some vertices may lie beyond the normal distance
    bool checks_normals; ///< whether some vertices may face away
};

/// A splat's matrix, stored by columns so that all of its rows are evaluated on a leaf's box at once.
template <Vector3 V, Flux F>
class SplatReach {
public:
    using T = scalar_t<V>;

    explicit SplatReach(const Splat<V, F>& splat)
        : x_(side_by_side(splat, [](const V& v) { return T(t::x(v)); })),
          y_(side_by_side(splat, [](const V& v) { return T(t::y(v)); })),
          z_(side_by_side(splat, [](const V& v) { return T(t::z(v)); })), centre_(splat.centre), normal_(splat.normal) {
    }

    [[nodiscard]] LeafMeeting operator()(const EyePathLeaf<T>& leaf) const {
        const T dx = leaf.middle[0] - t::x(centre_), dy = leaf.middle[1] - t::y(centre_),
                dz = leaf.middle[2] - t::z(centre_);
        const T hx = leaf.half[0], hy = leaf.half[1], hz = leaf.half[2];
        // Every row is a linear function of position that is 0 at the centre. On the box its values lie within middle
        // ± reach. The reach includes rounding, because a thin footprint's terms are large and cancel.
        std::array<T, 4> least, most; // of the absolute value
        NEPHROID_NOT_UNROLLED
        for (std::size_t row = 0; row < 4; ++row) {
            const T a = x_[row] * dx, b = y_[row] * dy, c = z_[row] * dz;
            const T middle = abs(a + b + c);
            const T half = abs(x_[row]) * hx + abs(y_[row]) * hy + abs(z_[row]) * hz;
            const T reach = half + rounding * (half + (abs(a) + abs(b) + abs(c)));
            const T beyond = middle - reach;
            least[row] = beyond > T(0) ? beyond : T(0);
            most[row] = middle + reach;
        }
        const typename NormalCone<T>::Facing facing = leaf.normals.facing(t::x(normal_), t::y(normal_), t::z(normal_));
        const bool beside = square(least[0]) + square(least[1]) > T(1);
        return {!beside && facing.some, !(most[2] < T(1)), !facing.all};
    }

private:
    using t = vector_traits<V>;
    /// Bound of a sum's rounding error over its terms. It is larger than any error seen, and covers compilers that fuse
    /// products and sums.
    static constexpr T rounding = T(64) * std::numeric_limits<T>::epsilon();

    template <class Coordinate>
    [[nodiscard]] static std::array<T, 4> side_by_side(const Splat<V, F>& splat, const Coordinate& of) {
        return {of(splat.row_a), of(splat.row_b), of(splat.row_n), T(0)}; // four fill a vector register
    }

    std::array<T, 4> x_, y_, z_;
    V centre_, normal_;
};

/// Calls visit(leaf, meeting) for the leaves that a splat overlaps and that have vertices which may face it.
///
/// @param takes  takes(leaf) returns whether a leaf of the map's tree is to receive light
template <Vector3 V, Flux F, class Takes, class Visit>
void for_each_reached_leaf(const EyePathMap<V>& map, const Splat<V, F>& splat, const Takes& takes, const Visit& visit) {
    const SplatReach<V, F> reach(splat);
    map.tree().visit_leaves(splat.box, [&](std::uint32_t leaf) {
        if (!takes(leaf))
            return;
        if (const LeafMeeting meeting = reach(map.leaf(leaf)); meeting.meets)
            visit(leaf, meeting);
    });
}

} // namespace nephroid::detail
