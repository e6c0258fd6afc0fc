// SPDX-License-Identifier: MIT
/// @file  Where a flight's light ends behind the surface that it met, and where it begins: policies of photon rays.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <concepts>

namespace nephroid {

/// A vertex behind a flight's end, as policies see it. Lengths are world units.
template <Scalar T>
struct BehindEnd {
    T height;    ///< over the tangent plane of the surface that the flight met, positive on the photon's side
    T distance2; ///< squared, from where it met the surface
    T radius2;   ///< squared, of the beam there
    T rounding;  ///< of the height
};

/// A policy: `ends(behind)` returns whether a vertex beyond the end of the flight still receives. It should not branch.
///
/// ```cpp
/// struct EndsAtOnce { // nothing behind the hit: an open plane loses half of what grazes it
///     static constexpr bool reaches_behind_plane = false;
///     template <nephroid::Scalar T>
///     bool operator()(const nephroid::BehindEnd<T>&) const { return false; }
/// };
/// ```
///
/// `reaches_behind_plane` says whether it may be true below the plane, within the beam's radius of the hit.
template <class P, class T = float>
concept FlightEnds = std::semiregular<P> && requires(const P ends, const BehindEnd<T>& behind) {
    { ends(behind) } -> std::convertible_to<bool>;
    { P::reaches_behind_plane } -> std::convertible_to<bool>;
};

/// All in front of the tangent plane. On a plane no light is lost. The default.
struct EndAtPlane {
    static constexpr bool reaches_behind_plane = false;
    template <Scalar T>
    [[nodiscard]] constexpr bool operator()(const BehindEnd<T>& behind) const {
        return behind.height >= -behind.rounding;
    }
};

/// That, or a ball about the hit: it loses nothing at convex edges, and shines through thin things unless short rays
/// forbid it.
struct EndAtPlaneOrBall {
    static constexpr bool reaches_behind_plane = true;
    template <Scalar T>
    [[nodiscard]] constexpr bool operator()(const BehindEnd<T>& behind) const {
        return bool(int(behind.height >= -behind.rounding) | int(behind.distance2 < behind.radius2));
    }
};

/// A half ball about the hit [Herzog et al. 2007]. It darkens every surface: in even light by 1/10 with the
/// Epanechnikov kernel, by 1/14 with the biweight.
struct EndAtHalfBall {
    static constexpr bool reaches_behind_plane = true;
    template <Scalar T>
    [[nodiscard]] constexpr bool operator()(const BehindEnd<T>& behind) const {
        return behind.distance2 < behind.radius2;
    }
};

/// Flights count in front of the surface that they left, with their whole width.
struct WholeWidth {};

/// Narrows a beam beside the surface that it left, such that no part of its disk at a vertex began beside that
/// surface: walls that emit or reflect then keep their light to the very edge of the floor. It is exact for planes.
/// Where it narrows, there is more noise.
struct ClipAtEmitter {
    double least_radius; ///< world units, > 0: no beam is narrowed below it
};

static_assert(FlightEnds<EndAtPlane> && FlightEnds<EndAtPlaneOrBall> && FlightEnds<EndAtHalfBall>);

} // namespace nephroid
