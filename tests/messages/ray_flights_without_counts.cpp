// SPDX-License-Identifier: MIT
// expect: nephroid: the flights policy must have counts(flight) const -> bool
#include "messages/renderer.hpp"

#include "nephroid/ray/splat_rays.hpp"

struct Some {};
const auto policies = nephroid::Rays{}.with_flights(Some{});
