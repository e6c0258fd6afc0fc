// SPDX-License-Identifier: MIT
/// @file  Renders a glTF scene with direct light and caustics.
#pragma once

#include "common/caustics/builtin.hpp"

namespace nephroid::examples {

/// Renders `options.scene`, a .glb or .gltf file, as linear radiance. If the options give no height, the camera
/// does. Light, a ground below the specular surfaces and a camera are assumed if the file lacks them; notes say so, and
/// are printed at once. Throws std::runtime_error with one line for a file that cannot be read, or in which no specular
/// surface makes a caustic; UsageError for options of the built-in cases.
[[nodiscard]] Rendering render_file(Options& options);

} // namespace nephroid::examples
