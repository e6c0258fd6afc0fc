// SPDX-License-Identifier: MIT
/// @file  The layers of a glTF scene's picture. Each has a source file of its own, because together they compile
///        slowly.
#pragma once

#include "common/caustics/report.hpp"
#include "common/eye_paths.hpp"
#include "common/image/image.hpp"
#include "common/lamps.hpp"

#include "nephroid/execution/thread_executor.hpp"

namespace nephroid::examples {

using FileScene = Scene<float, glm::vec3>;
using FileLamps = Lamps<float, glm::vec3>;
using FileEyePaths = EyePaths<float, glm::vec3>;

/// Traces the camera's rays to vertices on which light falls, and to emitters.
[[nodiscard]] FileEyePaths see_file_scene(const FileScene& scene, const FileLamps& lamps, const Camera<float>& camera,
                                          const Options& options, ThreadExecutor& threads);

/// The direct layer: light straight from lamps, and emitters.
[[nodiscard]] std::vector<glm::vec3> direct_layer_of(const FileScene& scene, const FileLamps& lamps,
                                                     const FileEyePaths& eye, const Options& options,
                                                     ThreadExecutor& threads);

/// Adds the caustics to a picture, and notes about them to a report.
void add_caustics_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye, const Options& options,
                     ThreadExecutor& threads, Report& report, std::vector<glm::vec3>& pixels);

} // namespace nephroid::examples
