// SPDX-License-Identifier: MIT
#include "common/caustics/file_scene.hpp"

#include "common/caustics/assume.hpp"
#include "common/caustics/file_layers.hpp"
#include "common/image/read_environment.hpp"
#include "common/rooms.hpp"
#include "common/scene_from_gltf.hpp"
#include "common/scenes/scenes.hpp"
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
        throw UsageError("--view: is for the built-in cases; files and rooms bring their camera");
    if (options.fresnel || options.one_reflection)
        throw UsageError(
            "--fresnel and --reflections: are for the built-in cases; files and rooms bring their materials");
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
    if (gltf.scene.empty())
        throw std::runtime_error("'" + options.scene + "' has no triangles; add a mesh");
    const CameraDescription view = camera_of(description, additions, gltf.scene, options, report);
    return render_layers(options, {std::move(gltf.scene), std::move(gltf.lamps), view}, std::move(report), total);
}

Rendering render_room(Options& options) {
    check(options);
    if (options.sun || options.ground || options.environment)
        throw UsageError("--sun, --ground and --environment: are for files; a room has a lamp and a floor");
    Stopwatch total;
    const bool is_open = is_scene(options.scene);
    auto room = is_open ? built_in_scene<float>(options.scene).value() : built_in_room<float>(options.scene).value();
    return render_layers(
        options, {std::move(room.scene), std::move(room.lamps), room.camera, is_open ? 0 : all_bounces}, {}, total);
}

} // namespace nephroid::examples
