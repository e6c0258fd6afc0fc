// SPDX-License-Identifier: MIT
/// @file  A mark for short loops that the compiler should turn into vector instructions.
#pragma once

#include "nephroid/vector/language.hpp"

/// Before a loop with a small, known count: the compiler keeps the loop. Otherwise GCC unrolls it and does not
/// vectorise it. This is a macro because nvcc and Visual Studio warn of pragmas that they do not know.
#if defined(__GNUC__) && !defined(__CUDACC__)
#define NEPHROID_NOT_UNROLLED _Pragma("GCC unroll 1")
#else
#define NEPHROID_NOT_UNROLLED
#endif
