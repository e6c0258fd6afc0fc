// SPDX-License-Identifier: MIT
/// @file  Path traced pictures of rooms and of files, by layers of light.
#pragma once

#include "common/image/image.hpp"
#include "common/layer.hpp"
#include "common/path_tracer/layers.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include <functional>
#include <string>

namespace nephroid::examples {

struct RoomPictureOptions {
    std::string scene;         ///< one of `room_names`, or a .glb or .gltf file with a camera and lamps
    std::size_t width, height; ///< pixels
    bool height_given = true;  ///< otherwise the camera gives it
    unsigned eye_paths = 1;    ///< for each pixel
    Layer layer = Layer::all;
    LayerTraceOptions tracing{}; ///< its seed is also that of the eye paths
};

/// Linear radiance in three bands.
struct RoomPicture {
    Samples mean, standard_error; ///< the latter for these eye paths
    std::uint64_t samples = 0;    ///< paths from each vertex of an eye path
};

/// Whether a name is that of a room or of a file.
[[nodiscard]] bool is_room_or_file(const std::string& scene);

/// The eye paths are those of `caustics` with as many samples, so that pictures can be compared pixel by pixel.
///
/// Throws std::runtime_error with one line for a file that cannot be read or that has no camera or no lamps, and what
/// `BouncedPaths` throws for scenes that it does not know. Notes about things that are shown differently from a file go
/// to `note`.
[[nodiscard]] RoomPicture path_trace_room(const RoomPictureOptions& options, ThreadExecutor& threads,
                                          const std::function<void(const std::string&)>& note,
                                          const std::function<bool(const RoomPicture&)>& progress);

} // namespace nephroid::examples
