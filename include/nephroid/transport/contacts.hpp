// SPDX-License-Identifier: MIT
/// @file  Surfaces that touch: glass on a table, water in a glass. A ray that leaves one of them begins on all of them,
///        and must meet exactly those that it has not passed yet.
#pragma once

#include "nephroid/transport/hit.hpp"
#include "nephroid/vector/algebra.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// Says which primitives a ray leaves out, for scenes with `intersect(origin, direction, t_min, t_max, contacts)` whose
/// hits have a `primitive`, the number of their triangle or shape. The ray then begins on the surface that it leaves
/// instead of a little off it, and t_min is a little below 0. The scene calls `skips` for each candidate, and
/// returns the nearest one that is not left out. Among candidates at the same distance, to rounding, it should prefer a
/// surface where the ray enters an object, then one where it leaves an object, and an opaque surface last. Then there
/// is no air between water and its glass (with Media, transport/media.hpp), and light leaves a glass before it falls
/// onto the table.
///
/// Eight of the primitives that a ray passes where surfaces touch are remembered. If it passes more, as in the middle
/// of a fan of triangles, every primitive there that faces the same way as the last one counts as passed, even one of
/// another object. Light then misses an object that touches a glass at just that point.
///
/// ```cpp
/// if (t > t_min && t < nearest && !contacts.skips(triangle, t, dot(direction, normal)))
///     nearest = t;
/// ```
template <Scalar T>
class Contacts {
public:
    /// @param primitive  of the candidate
    /// @param distance   along the ray; may be negative
    /// @param cosine     between the ray's direction and the candidate's geometric normal, of either sign; it may be
    ///                   rough, as only its sign and the steepness of the ray matter
    [[nodiscard]] bool skips(std::uint64_t primitive, T distance, T cosine) const {
        if (!is_here(distance, cosine)) // only a curved surface can be met again, and only from its other side
            return !(distance > T(0)) || (begins_on_surface_ && primitive == left_ && (cosine > T(0)) == along_normal_);
        return primitive == left_ || has_crossed(primitive) == forwards_ || is_beyond_memory(cosine);
    }

    /// Whether `skips` may return true; computed without the cosine. An iterative search for the intersection with
    /// the shape that the ray leaves may begin at `reach()`: then only grazing rays find their own origin again.
    [[nodiscard]] bool may_skip(std::uint64_t primitive, T distance) const {
        return distance <= reach_ || (begins_on_surface_ && primitive == left_);
    }
    [[nodiscard]] bool was_left(std::uint64_t primitive) const { return begins_on_surface_ && primitive == left_; }

    /// The least distance at which hits count.
    [[nodiscard]] T t_min() const { return -reach_; }
    /// Surfaces at this distance or further do not touch the surface that was left.
    [[nodiscard]] T reach() const { return reach_; }

    /// Whether a hit lies at the ray's origin, on one of the surfaces that touch there.
    [[nodiscard]] bool is_here(T distance, T cosine) const {
        return begins_on_surface_ && abs(distance * cosine) <= height_ && abs(distance) <= reach_;
    }

    /// The ray leaves a surface.
    ///
    /// @param cosine   between its new direction and the surface's geometric normal
    /// @param height   the largest distance between surfaces that touch, > 0
    /// @param passed   whether the ray goes on through the surface
    /// @param is_here  whether the surface is one of those on which the previous ray began
    void leave(std::uint64_t primitive, T cosine, T height, bool passed, bool is_here) {
        if (!is_here || !begins_on_surface_) {
            count_ = 0;
            has_forgotten_ = false;
            forwards_ = true;
        }
        if (!passed)
            forwards_ = !forwards_;
        else if (forwards_)
            add(primitive);
        else
            remove(primitive);
        left_ = primitive;
        along_normal_ = cosine > T(0);
        begins_on_surface_ = true;
        height_ = height;
        reach_ = height / (std::max)(T(abs(cosine)), T(1) / T(16));
    }

    /// The ray also came through a neighbouring triangle of the surface that was left.
    void leave_beside(std::uint64_t primitive) {
        if (forwards_)
            add(primitive);
        else
            remove(primitive);
    }

    [[nodiscard]] bool leaves_along_normal() const { return along_normal_; }
    /// Whether the ray left a surface at all, and not a lamp.
    [[nodiscard]] bool begins_on_surface() const { return begins_on_surface_; }

private:
    [[nodiscard]] bool has_crossed(std::uint64_t primitive) const {
        return std::find(crossed_.begin(), crossed_.begin() + count_, primitive) != crossed_.begin() + count_;
    }
    void add(std::uint64_t primitive) {
        if (count_ < std::ptrdiff_t(crossed_.size()))
            crossed_[std::size_t(count_++)] = primitive;
        else
            has_forgotten_ = true;
    }
    /// Where a vertex has more triangles than are remembered, all that face as the last one are taken to be crossed.
    [[nodiscard]] bool is_beyond_memory(T cosine) const {
        return has_forgotten_ && forwards_ && (cosine > T(0)) == along_normal_;
    }
    void remove(std::uint64_t primitive) {
        const auto end = crossed_.begin() + count_;
        count_ = std::remove(crossed_.begin(), end, primitive) - crossed_.begin();
    }

    std::array<std::uint64_t, 8> crossed_{}; ///< primitives passed since the ray arrived at the surfaces that touch
    std::ptrdiff_t count_ = 0;
    std::uint64_t left_ = 0;
    T height_ = T(0), reach_ = T(0);
    bool forwards_ = true; ///< whether the ray goes on beyond these surfaces, or back to where it came from
    bool along_normal_ = false, begins_on_surface_ = false;
    bool has_forgotten_ = false; ///< whether more primitives were crossed than `crossed_` holds
};

/// Optional: the scene can leave out primitives, so that surfaces may touch (Contacts).
template <class S, class V>
concept LetsSurfacesTouch = requires(const S& scene, const V& v, scalar_t<V> t, const Contacts<scalar_t<V>>& contacts) {
    {bool(scene.intersect(v, v, t, t, contacts))};
    { (*scene.intersect(v, v, t, t, contacts)).primitive } -> std::convertible_to<std::uint64_t>;
};

namespace detail {
/// What RayStart keeps of the surfaces at a ray's origin.
template <Scalar T>
struct Contact {
    Contacts<T> surfaces;
    std::uint64_t left = 0; ///< `surface` of the hit that was left last

    [[nodiscard]] bool begins_on_surface() const { return surfaces.begins_on_surface(); }
};

/// In place of Contact, if surfaces may not touch.
struct NoContact {
    [[nodiscard]] static constexpr bool begins_on_surface() { return false; }
};

template <class S, class V>
struct contact_of {
    using type = NoContact;
};
template <class S, class V>
    requires LetsSurfacesTouch<S, V>
struct contact_of<S, V> {
    using type = Contact<scalar_t<V>>;
};
} // namespace detail

} // namespace nephroid
