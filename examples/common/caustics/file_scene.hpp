// SPDX-License-Identifier: MIT
/// @file  A glTF scene as a picture: what its camera sees by direct light and through caustics.
#pragma once

#include "common/caustics/builtin.hpp"

namespace nephroid::examples {

/// Renders `options.scene`, a .glb or .gltf file, as linear radiance. Without a height in the options the camera sets
/// it. What the file lacks is assumed: light, something below what is specular, a camera; notes say so, and are printed
/// at once. Throws std::runtime_error with one line for a file that cannot be read, or has no specular surface that
/// sends light anywhere; UsageError for options that are those of the built-in cases.
[[nodiscard]] Rendering render_file(Options& options);

} // namespace nephroid::examples
