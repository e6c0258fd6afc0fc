// SPDX-License-Identifier: MIT
/// @file  Rays and optics in wide precision, as the program `numerics` has them: the tests' reference.
#pragma once

#include "common/numerics/space.hpp"

namespace nephroid::tests {

using namespace examples::numerics;

} // namespace nephroid::tests
