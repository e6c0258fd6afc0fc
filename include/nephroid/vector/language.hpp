// SPDX-License-Identifier: MIT
/// @file  The language that the library needs, C++20: older compilers stop here with one sentence.
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
