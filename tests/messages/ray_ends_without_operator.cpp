// SPDX-License-Identifier: MIT
// expect: nephroid: the ends policy must have operator()(const BehindEnd<T>&) const -> bool
#include "messages/renderer.hpp"

#include "nephroid/ray/splat_rays.hpp"

struct Never {
    static constexpr bool reaches_behind_plane = false;
};
const auto policies = nephroid::Rays{}.with_ends(Never{});
