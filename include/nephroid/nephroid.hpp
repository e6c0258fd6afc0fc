// SPDX-License-Identifier: MIT
/// @file  The whole library but for the vectors: include nephroid/vector/glm.hpp beside it, or specialise
///        `nephroid::vector_traits` for your own (nephroid/vector/traits.hpp).
#pragma once

#include "nephroid/differential/curvature.hpp"
#include "nephroid/differential/reemission.hpp"
#include "nephroid/differential/reflection.hpp"
#include "nephroid/differential/refraction.hpp"
#include "nephroid/differential/transfer.hpp"
#include "nephroid/emission/sequence/halton.hpp"
#include "nephroid/emission/sequence/random.hpp"
#include "nephroid/emission/sequence/sobol.hpp"
#include "nephroid/emission/standard_lights.hpp"
#include "nephroid/estimate/caustics.hpp"
#include "nephroid/footprint/ellipse.hpp"
#include "nephroid/footprint/kernel.hpp"
#include "nephroid/footprint/policies.hpp"
#include "nephroid/map/eye_path_map.hpp"
#include "nephroid/quality/error.hpp"
#include "nephroid/quality/exposure.hpp"
#include "nephroid/quality/ssim.hpp"
#include "nephroid/transport/executor.hpp"
#include "nephroid/transport/walk.hpp"
