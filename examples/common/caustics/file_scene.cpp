// SPDX-License-Identifier: MIT
#include "common/caustics/file_scene.hpp"

#include "common/caustics/render.hpp"
#include "common/direct_light.hpp"
#include "common/eye_paths.hpp"
#include "common/scene_from_gltf.hpp"

#include "nephroid/vector/glm.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephroid::examples {

namespace {

using Color = glm::vec3;
using Vertex = EyeVertex<float, Color>;

void check(const Options& options) {
    if (options.view)
        throw UsageError("--view: is for the built-in cases; a file brings its camera");
    if (options.fresnel || options.one_reflection)
        throw UsageError("--fresnel and --reflections: are for the built-in cases; a file brings its materials");
}

void check(const GltfScene<float>& gltf, const Options& options) {
    const auto fail = [&](const std::string& what) { throw std::runtime_error("'" + options.scene + "' " + what); };
    if (gltf.scene.empty())
        fail("has no triangles; add a mesh");
    if (gltf.lamps.empty())
        fail("has no light; add one by KHR_lights_punctual, or a mesh with an emissive material");
    if (!gltf.scene.has_specular())
        fail("has no specular surface, so it has no caustic; add glass (KHR_materials_transmission) or a smooth metal");
}

[[nodiscard]] double luminance(const Color& color) { return (double(color.x) + double(color.y) + double(color.z)) / 3; }

/// The exposure at which nine in ten of the pixels that are not black are below 0.7: caustics may shine, not the walls.
[[nodiscard]] double exposure_of(const std::vector<Color>& pixels) {
    std::vector<double> brightness;
    for (const Color& pixel : pixels)
        if (const double b = luminance(pixel); b > 0)
            brightness.push_back(b);
    if (brightness.empty())
        return 1;
    const auto bright = brightness.begin() + static_cast<std::ptrdiff_t>(brightness.size() * 9 / 10);
    std::nth_element(brightness.begin(), bright, brightness.end());
    return 0.7 / *bright;
}

} // namespace

Rendering render_file(Options& options) {
    check(options);
    Stopwatch total;
    const SceneDescription description = read_gltf(options.scene);
    const GltfScene<float> gltf = scene_from<float>(description);
    check(gltf, options);

    const CameraDescription view =
        description.cameras.empty() ? camera_for(gltf.scene.bounds()) : description.cameras.front();
    if (!options.height_given)
        options.height = static_cast<std::size_t>((std::max)(1.0, std::round(double(options.width) / aspect_of(view))));
    const auto camera = camera_from<float>(view, options.width, options.height);
    ThreadExecutor threads(options.threads);

    Report report;
    report.threads = threads.threads();
    report.notes = gltf.warnings;
    if (description.cameras.empty())
        report.notes.push_back("no camera in the file: the whole scene is shown");
    Stopwatch stopwatch;
    const auto eye = trace_eye_paths(gltf.scene, camera, {.samples = options.samples, .seed = options.seed}, threads);
    report.eye_vertices = eye.vertices.size();
    report.seconds.eye_paths = stopwatch.lap();

    Image<Color> picture(options.width, options.height, Color(0));
    if (options.layer != Layer::caustics) {
        picture.pixels = direct_layer(gltf.scene, gltf.lamps, eye, {.seed = options.seed}, threads);
        report.seconds.direct = stopwatch.lap();
    }
    if (options.layer != Layer::direct) {
        const EyePathMap map(eye.vertices, &Vertex::position, &Vertex::normal);
        report.seconds.map = stopwatch.lap();
        const auto lights = photon_lights(gltf.lamps, gltf.scene);
        splat_caustics_timed<Color>(gltf.scene, lights, map, WalkLimits{}, options, false, threads, report,
                                    [&](std::size_t vertex, const Color& irradiance) {
                                        const Vertex& v = eye.vertices[vertex];
                                        picture.pixels[v.pixel] += irradiance * v.weight;
                                    });
    }
    report.seconds.total = total.lap();

    const double exposure = exposure_of(picture.pixels);
    return {Samples(picture), exposure, std::move(report)};
}

} // namespace nephroid::examples
