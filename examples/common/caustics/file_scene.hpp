// SPDX-License-Identifier: MIT
/// @file  Renders a glTF scene or a room with direct light, caustics and light between diffuse surfaces.
#pragma once

#include "common/caustics/builtin.hpp"

namespace nephroid::examples {

/// Renders `options.scene`, a .glb or .gltf file, as linear radiance. If the options give no height, the camera
/// does. Light, a ground below the specular surfaces and a camera are assumed if the file lacks them; notes say so, and
/// are printed at once. Throws std::runtime_error with one line for a file that cannot be read, or in which no specular
/// surface makes a caustic; UsageError for options of the built-in cases.
[[nodiscard]] Rendering render_file(Options& options);

/// Renders a built-in room (common/rooms.hpp), with light of all bounces unless the options say otherwise. Throws
/// UsageError for options of the built-in cases and of files.
[[nodiscard]] Rendering render_room(Options& options);

} // namespace nephroid::examples
