// SPDX-License-Identifier: MIT
/// @file  What the files here include, precompiled for them all. Without nephroid/vector/glm.hpp, which one must lack.
#pragma once

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/light_set.hpp"
#include "nephroid/relaxation/relax.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/splat/splat_photons.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <list>
#include <optional>
#include <vector>
