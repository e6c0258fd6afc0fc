// SPDX-License-Identifier: MIT
/// @file  The library's version, read from here by CMake and Meson too, and the language that the library needs.
#pragma once

#if defined(_MSVC_LANG)
#define NEPHROID_LANGUAGE _MSVC_LANG
#else
#define NEPHROID_LANGUAGE __cplusplus
#endif
#if NEPHROID_LANGUAGE < 202002L
#error "nephroid needs C++20: compile with -std=c++20 (Visual Studio: /std:c++20, CMake: cxx_std_20)"
#include "nephroid needs C++20" // no such file: compilers stop here instead of listing thousands of errors
#endif
#undef NEPHROID_LANGUAGE

#define NEPHROID_VERSION_MAJOR 0
#define NEPHROID_VERSION_MINOR 2
#define NEPHROID_VERSION_PATCH 0

/// One number to compare with: `#if NEPHROID_VERSION >= 200` is 0.2.0 or later.
#define NEPHROID_VERSION (10000 * NEPHROID_VERSION_MAJOR + 100 * NEPHROID_VERSION_MINOR + NEPHROID_VERSION_PATCH)
