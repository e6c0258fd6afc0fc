// SPDX-License-Identifier: MIT
/// @file  The library's version. CMake and Meson read it from here.
#pragma once

#include "nephroid/vector/language.hpp"

#define NEPHROID_VERSION_MAJOR 0
#define NEPHROID_VERSION_MINOR 2
#define NEPHROID_VERSION_PATCH 0

/// One number to compare with: `#if NEPHROID_VERSION >= 200` is 0.2.0 or later.
#define NEPHROID_VERSION (10000 * NEPHROID_VERSION_MAJOR + 100 * NEPHROID_VERSION_MINOR + NEPHROID_VERSION_PATCH)
