// SPDX-License-Identifier: MIT
/// @file  A glTF scene as a picture: what its camera sees by direct light and through caustics.
#pragma once

#include "common/caustics/builtin.hpp"

namespace nephroid::examples {

/// Renders `options.scene`, a .glb or .gltf file, as linear radiance. Without a height in the options the camera sets
/// it. Throws std::runtime_error with one line for a file that cannot be read or has no light, camera, diffuse or
/// specular surface, UsageError for options that are those of the built-in cases.
[[nodiscard]] Rendering render_file(Options& options);

} // namespace nephroid::examples
