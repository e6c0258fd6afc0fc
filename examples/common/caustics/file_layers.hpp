// SPDX-License-Identifier: MIT
/// @file  The layers of the picture of a file or a room. Each has a source file of its own, because together they
///        compile slowly.
#pragma once

#include "common/camera_from_gltf.hpp"
#include "common/caustics/builtin.hpp"
#include "common/caustics/report.hpp"
#include "common/eye_paths.hpp"
#include "common/image/image.hpp"
#include "common/lamps.hpp"
#include "common/stopwatch.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/receiver/sums.hpp"

namespace nephroid::examples {

using FileScene = Scene<float, glm::vec3>;
using FileLamps = Lamps<float, glm::vec3>;
using FileEyePaths = EyePaths<float, glm::vec3>;
using FileMap = EyePathMap<glm::vec3>;
using FileLayer = PassedLayer<glm::vec3>;

/// What a picture is made of.
struct LayeredScene {
    FileScene scene;
    FileLamps lamps;
    CameraDescription camera;
    unsigned bounces = 0; ///< if the options ask for no other number
};

/// Renders linear radiance. If the options give no height, the camera does. Throws std::runtime_error with one line for
/// a scene in which the options' layers have no light.
///
/// @param report  so far
/// @param total   since the program began
[[nodiscard]] Rendering render_layers(Options& options, const LayeredScene& seen, Report report, Stopwatch& total);

/// Traces the camera's rays to vertices on which light falls, and to emitters.
[[nodiscard]] FileEyePaths see_file_scene(const FileScene& scene, const FileLamps& lamps, const Camera<float>& camera,
                                          const Options& options, ThreadExecutor& threads);

/// The direct layer: light straight from lamps, and emitters.
[[nodiscard]] std::vector<glm::vec3> direct_layer_of(const FileScene& scene, const FileLamps& lamps,
                                                     const FileEyePaths& eye, const Options& options,
                                                     ThreadExecutor& threads);

/// The pixels of a film on which the light at eye path vertices is seen.
[[nodiscard]] inline std::vector<glm::vec3> pixels_of(const Sums<glm::vec3, glm::vec3>& sums, const FileEyePaths& eye,
                                                      const Options& options) {
    std::vector<glm::vec3> pixels(options.width * options.height, glm::vec3(0));
    sums.for_each([&](std::size_t vertex, const glm::vec3& irradiance) {
        pixels[eye.vertices[vertex].pixel] += irradiance * eye.vertices[vertex].weight;
    });
    return pixels;
}

/// The caustics, and what is said of them in a report.
///
/// @param map  of the vertices of `eye`
[[nodiscard]] FileLayer caustic_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye,
                                         const FileMap& map, const Options& options, ThreadExecutor& threads,
                                         Report& report);

/// The same, drawn as light sheets.
///
/// @param map  of the vertices of `eye`, with their footprints
[[nodiscard]] FileLayer sheet_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye,
                                       const FileMap& map, const Options& options, ThreadExecutor& threads,
                                       Report& report);

/// The caustics in bands of the spectrum, and as colours.
///
/// @param films  gets a film for each band, if the options ask for layers
[[nodiscard]] FileLayer spectral_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye,
                                          const FileMap& map, const Options& options, ThreadExecutor& threads,
                                          Report& report, std::vector<RenderedLayer>& films);

/// The light that at least one diffuse surface has scattered.
///
/// @param bounces  the most, off diffuse surfaces before the one that is seen
[[nodiscard]] FileLayer indirect_layer_of(const FileScene& scene, const FileLamps& lamps, const FileEyePaths& eye,
                                          const FileMap& map, const Options& options, unsigned bounces,
                                          ThreadExecutor& threads, Report& report);

} // namespace nephroid::examples
