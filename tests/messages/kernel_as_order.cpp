// SPDX-License-Identifier: MIT
// expect: nephroid: the order policy must be FirstOrder (splat/splat_policies.hpp), SecondOrder
#include "messages/renderer.hpp"

const auto policies = nephroid::Published{}.with_order(nephroid::BiweightKernel{});
