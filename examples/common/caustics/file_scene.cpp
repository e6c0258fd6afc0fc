// SPDX-License-Identifier: MIT
#include "common/caustics/file_scene.hpp"

#include "common/caustics/assume.hpp"
#include "common/caustics/file_layers.hpp"
#include "common/image/read_environment.hpp"
#include "common/image/room_exposure.hpp"
#include "common/scene_from_gltf.hpp"
#include "common/stopwatch.hpp"

#include "nephroid/vector/glm.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephroid::examples {

namespace {

using Color = glm::vec3;

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
    if (!gltf.scene.has_specular())
        fail("has no specular surface, so it has no caustic; add glass (KHR_materials_transmission) or a smooth metal");
}

/// Reads the file. The reader's warnings become notes, even if the file cannot be read.
[[nodiscard]] SceneDescription described(const Options& options, Report& report) {
    try {
        SceneDescription description = read_gltf(options.scene);
        for (const std::string& warning : description.warnings)
            report.note(warning);
        return description;
    } catch (const UnreadableGltf& error) {
        for (const std::string& warning : error.warnings)
            report.note(warning);
        throw;
    }
}

/// The file's first camera, or a camera that shows the specular surfaces and their light.
[[nodiscard]] CameraDescription camera_of(const SceneDescription& description, const Additions& additions,
                                          const FileScene& scene, const Options& options, Report& report) {
    if (!description.cameras.empty())
        return description.cameras.front();
    report.note("no camera in the file: assumed one that shows what is specular and its light");
    Box<float> box;
    for (const glm::vec3& corner : points_of_interest(description, additions))
        box.add(corner);
    CameraDescription camera =
        camera_for(box, options.height_given ? double(options.width) / double(options.height) : 1);
    step_inside(camera, scene, 0.5f * (box.min + box.max));
    return camera;
}

[[nodiscard]] std::shared_ptr<const Environment<float, Color>> environment_of(const std::string& name) {
    using Around = Environment<float, Color>;
    if (name == "constant")
        return std::make_shared<const Around>(Around::constant(Color(1)));
    try {
        return std::make_shared<const Around>(Around::picture(read_environment(name)));
    } catch (const std::invalid_argument& error) {
        throw std::runtime_error("'" + name + "': " + error.what());
    }
}

} // namespace

Rendering render_file(Options& options) {
    check(options);
    Stopwatch total;
    Report report;
    SceneDescription description = described(options, report);
    const Additions additions = add_sun_and_ground(description, options);
    for (const std::string& sentence : additions.assumed)
        report.note(sentence);
    GltfScene<float> gltf = scene_from<float>(description);
    for (std::size_t i = description.warnings.size(); i < gltf.warnings.size(); ++i)
        report.note(gltf.warnings[i]);
    if (options.environment)
        gltf.lamps.environments.push_back(environment_of(*options.environment));
    check(gltf, options);

    const CameraDescription view = camera_of(description, additions, gltf.scene, options, report);
    if (!options.height_given)
        options.height = static_cast<std::size_t>((std::max)(1.0, std::round(double(options.width) / aspect_of(view))));
    const auto camera = camera_from<float>(view, options.width, options.height);
    ThreadExecutor threads(options.threads);
    report.threads = threads.threads();
    Stopwatch stopwatch;
    const FileEyePaths eye = see_file_scene(gltf.scene, gltf.lamps, camera, options, threads);
    report.eye_vertices = eye.vertices.size();
    report.seconds.eye_paths = stopwatch.lap();

    Image<Color> picture(options.width, options.height, Color(0));
    if (options.layer != Layer::caustics) {
        picture.pixels = direct_layer_of(gltf.scene, gltf.lamps, eye, options, threads);
        report.seconds.direct = stopwatch.lap();
    }
    if (options.layer != Layer::direct)
        add_caustics_of(gltf.scene, gltf.lamps, eye, options, threads, report, picture.pixels);
    report.seconds.total = total.lap();

    Samples samples(picture);
    const double exposure = room_exposure(samples);
    return {std::move(samples), exposure, std::move(report)};
}

} // namespace nephroid::examples
