// SPDX-License-Identifier: MIT
/// @file  Surfaces that touch: glass on a table, water in a glass. A ray that leaves one of them begins on all, and
///        must meet those that it has not come through yet, and no other.
#pragma once

#include "nephroid/transport/hit.hpp"
#include "nephroid/vector/algebra.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// What a ray leaves out, told to scenes that ask for it: `scene.intersect(origin, direction, t_min, t_max, contacts)`
/// with hits that have a `primitive`, a number of their triangle or shape. The ray then begins on the surface that it
/// leaves, instead of a little off it, and t_min is a little below 0. The scene asks for each candidate, and takes the
/// nearest of those that are not left out. Of two that are equally far, to rounding, it should take the one whose
/// inside the ray enters first, then one whose inside it leaves, and what is opaque last: then no air is between water
/// and its glass (with Media, transport/media.hpp), and light comes out of the glass before it falls onto the table.
///
/// ```cpp
/// if (t > t_min && t < nearest && !contacts.leave_out(triangle, t, dot(direction, normal)))
///     nearest = t;
/// ```
template <Scalar T>
class Contacts {
public:
    /// @param primitive  of the candidate
    /// @param distance   along the ray, less than 0 as well
    /// @param cosine     between the ray's direction and the candidate's geometric normal, of either sign; only as
    ///                   exact as is needed to tell its sign, and how steeply the ray meets the surface
    [[nodiscard]] bool leave_out(std::uint64_t primitive, T distance, T cosine) const {
        if (!is_here(distance, cosine)) // a flat surface is never met again; a curved one only from its other side
            return !(distance > T(0)) || (begins_on_surface_ && primitive == left_ && (cosine > T(0)) == along_normal_);
        return primitive == left_ || has_crossed(primitive) == forwards_;
    }

    /// Whether `leave_out` has to be asked at all, which spares the cosine. For curved shapes with a search of their
    /// own: it may begin at `reach()` on the one that was left, and then finds it again at low angles only.
    [[nodiscard]] bool may_leave_out(std::uint64_t primitive, T distance) const {
        return distance <= reach_ || (begins_on_surface_ && primitive == left_);
    }
    [[nodiscard]] bool was_left(std::uint64_t primitive) const { return begins_on_surface_ && primitive == left_; }

    /// The least distance that counts.
    [[nodiscard]] T t_min() const { return -reach_; }
    /// What is not nearer than this does not touch the surface that was left.
    [[nodiscard]] T reach() const { return reach_; }

    /// Whether a hit lies where the ray begins: on one of the surfaces that touch.
    [[nodiscard]] bool is_here(T distance, T cosine) const {
        return begins_on_surface_ && abs(distance * cosine) <= height_ && abs(distance) <= reach_;
    }

    /// The ray leaves a surface.
    ///
    /// @param cosine   between its new direction and the surface's geometric normal
    /// @param height   how far from one another surfaces may be that touch, > 0
    /// @param passed   it goes on through the surface
    /// @param is_here  the surface is one of those that the ray began on
    void leave(std::uint64_t primitive, T cosine, T height, bool passed, bool is_here) {
        if (!is_here || !begins_on_surface_) {
            count_ = 0;
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

    /// A triangle beside the one that was left, of the same surface: the ray has come through it as well.
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
    }
    void remove(std::uint64_t primitive) {
        const auto end = crossed_.begin() + count_;
        count_ = std::remove(crossed_.begin(), end, primitive) - crossed_.begin();
    }

    std::array<std::uint64_t, 8> crossed_{}; ///< on the way that the ray arrived on
    std::ptrdiff_t count_ = 0;
    std::uint64_t left_ = 0;
    T height_ = T(0), reach_ = T(0);
    bool forwards_ = true; ///< on the side of the surfaces that the ray went to, not back where it came from
    bool along_normal_ = false, begins_on_surface_ = false;
};

/// Optional: the scene leaves out primitives, and so lets surfaces touch (Contacts).
template <class S, class V>
concept LetsSurfacesTouch = requires(const S& scene, const V& v, scalar_t<V> t, const Contacts<scalar_t<V>>& contacts) {
    {bool(scene.intersect(v, v, t, t, contacts))};
    { (*scene.intersect(v, v, t, t, contacts)).primitive } -> std::convertible_to<std::uint64_t>;
};

namespace detail {
/// What a photon carries to know where its ray begins.
template <Scalar T>
struct Contact {
    Contacts<T> surfaces;
    std::uint64_t left = 0; ///< the surface that was left last, by its name

    [[nodiscard]] bool begins_on_surface() const { return surfaces.begins_on_surface(); }
};

/// Where surfaces may not touch.
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
