// SPDX-License-Identifier: MIT
// expect: nephroid: the kernel policy cannot be called as kernel(radius2) const
#include "messages/renderer.hpp"

const auto policies = nephroid::Published{}.with_kernel(nephroid::FirstOrder{}); // not that policy
