// SPDX-License-Identifier: MIT
/// @file  tinygltf's declarations, without its warnings; the code itself is in the library that is linked.
#pragma once

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#endif
#include <tiny_gltf.h> // IWYU pragma: export
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
