// SPDX-License-Identifier: MIT
/// @file  A mark for short loops that are to become instructions on vectors.
#pragma once

/// Before a loop of a known, small count: it stays a loop. GCC would unroll it first, and then not vectorise it. A macro,
/// as nvcc and Visual Studio warn of pragmas that they do not know.
#if defined(__GNUC__) && !defined(__CUDACC__)
#define NEPHROID_NOT_UNROLLED _Pragma("GCC unroll 1")
#else
#define NEPHROID_NOT_UNROLLED
#endif
