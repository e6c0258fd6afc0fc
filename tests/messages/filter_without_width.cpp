// SPDX-License-Identifier: MIT
// expect: nephroid: the filter policy must be PixelFilter, NoPixelFilter, or a type
#include "messages/renderer.hpp"

const auto policies = nephroid::Published{}.with_filter(nephroid::BiweightKernel{});
