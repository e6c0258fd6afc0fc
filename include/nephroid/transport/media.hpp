// SPDX-License-Identifier: MIT
/// @file  Media inside of media: which of them fills a point, and which of their surfaces light notices.
#pragma once

#include "nephroid/vector/language.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// The media that contain a point. Where several overlap, the one with the highest priority fills the point, so that a
/// model of water may extend into the glass around it. Among media of equal priority the one entered last does, as for
/// bodies inside of others. A value type; a scene's `medium` may be this:
///
/// ```cpp
/// struct Adapter {
///     using medium = nephroid::Media;
///
///     Scattering scatter(const MyHit& hit, const Vec3& direction, auto& random, const medium& media) const {
///         const auto at = media.at_surface_of(hit.material_id, hit.material->priority, enters(hit, direction));
///         if (!at.is_real())
///             return {.event = nephroid::Event::pass, .medium = at.beyond};
///         const float eta = index_of(at.before) / index_of(at.after); // 1 for Media::none
///         ...
///         return {nephroid::Event::refract, weight, eta, at.beyond}; // reflect leaves the medium as it is
///     }
///     Colour transmittance(const medium& media, float distance) const { ... media.here() ... }
///     medium medium_at(const Vec3& position) const; // where lamps may lie in a medium (transport/scene.hpp)
/// };
/// ```
///
/// Source: Schmidt and Budge 2002, "Simple nested dielectrics in ray traced images".
class Media {
public:
    static constexpr std::int32_t none = -1; ///< no medium: air
    static constexpr std::size_t most = 8;   ///< at one point; further ones are ignored

    /// The media on both sides of a surface.
    struct Surface;

    /// The medium that fills the point.
    [[nodiscard]] constexpr std::int32_t here() const { return count_ > 0 ? entries_[0].medium : none; }

    [[nodiscard]] constexpr bool has(std::int32_t medium) const {
        for (std::size_t i = 0; i < count_; ++i)
            if (entries_[i].medium == medium)
                return true;
        return false;
    }

    /// @param medium    >= 0
    /// @param priority  where media overlap the one of the highest priority fills the point, and of equal ones the one
    ///                  that was entered last
    constexpr void enter(std::int32_t medium, std::int32_t priority = 0) {
        if (count_ == most)
            return;
        std::size_t i = count_++;
        for (; i > 0 && priority >= entries_[i - 1].priority; --i)
            entries_[i] = entries_[i - 1];
        entries_[i] = {medium, priority};
    }

    /// @return  whether the point was in the medium
    constexpr bool leave(std::int32_t medium) {
        for (std::size_t i = 0; i < count_; ++i)
            if (entries_[i].medium == medium) {
                for (--count_; i < count_; ++i)
                    entries_[i] = entries_[i + 1];
                return true;
            }
        return false;
    }

    /// @param medium   the one on the inner side of the surface
    /// @param priority  of that medium, as for `enter`
    /// @param enters   whether the light arrives from outside of it. Light that leaves a medium not known here is taken
    ///                 to have come from that medium
    [[nodiscard]] constexpr Surface at_surface_of(std::int32_t medium, std::int32_t priority, bool enters) const;

    friend constexpr bool operator==(const Media& a, const Media& b) {
        for (std::size_t i = 0; i < most; ++i)
            if (a.medium(i) != b.medium(i))
                return false;
        return true;
    }

private:
    struct Entry {
        std::int32_t medium = none, priority = 0;
    };
    [[nodiscard]] constexpr std::int32_t medium(std::size_t i) const { return i < count_ ? entries_[i].medium : none; }

    std::array<Entry, most> entries_{}; // the first one fills the point
    std::size_t count_ = 0;
};

struct Media::Surface {
    std::int32_t before, after; ///< the media on both sides, or none
    Media beyond;               ///< the media of light that has passed the surface

    /// Whether light notices the surface. It does not where the same medium fills both sides.
    [[nodiscard]] constexpr bool is_real() const { return before != after; }
};

constexpr Media::Surface Media::at_surface_of(std::int32_t medium, std::int32_t priority, bool enters) const {
    Media on_this_side = *this, beyond = *this;
    if (enters) {
        beyond.enter(medium, priority);
    } else if (!beyond.leave(medium)) {
        on_this_side.enter(medium, priority);
    }
    return {on_this_side.here(), beyond.here(), beyond};
}

} // namespace nephroid
