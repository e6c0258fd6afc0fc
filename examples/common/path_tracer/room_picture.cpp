// SPDX-License-Identifier: MIT
#include "common/path_tracer/room_picture.hpp"

#include "common/rooms.hpp"
#include "common/scene_from_gltf.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephroid::examples {

namespace {

using Color = Vec3<double>;

struct TracedScene {
    Scene<double> scene;
    Lamps<double, Color> lamps;
    CameraDescription camera;
};

[[nodiscard]] TracedScene open_scene(const std::string& name, const std::function<void(const std::string&)>& note) {
    if (auto room = built_in_room<double>(name))
        return {std::move(room->scene), std::move(room->lamps), room->camera};
    const SceneDescription description = read_gltf(name);
    GltfScene<double> gltf = scene_from<double>(description);
    for (const std::string& warning : gltf.warnings)
        note(warning);
    const auto fail = [&](const char* what) { throw std::runtime_error("'" + name + "' has no " + what); };
    if (gltf.scene.empty())
        fail("triangles; add a mesh");
    if (description.cameras.empty())
        fail("camera; add one");
    if (gltf.lamps.empty())
        fail("lamps; add a material that emits, or a light");
    return {std::move(gltf.scene), std::move(gltf.lamps), description.cameras.front()};
}

[[nodiscard]] Color part_of(const LightLayers<Color>& layers, Layer layer) {
    switch (layer) {
    case Layer::caustics:
        return layers.caustic;
    case Layer::direct:
        return layers.direct;
    case Layer::indirect:
        return layers.indirect;
    default:
        return layers.sum();
    }
}

/// @param emitted  lamps that the pixels see: a part of the direct layer
[[nodiscard]] RoomPicture picture_of(const TracedLayers<Color>& traced, const std::vector<Color>& emitted,
                                     const RoomPictureOptions& options, std::size_t height) {
    Image<glm::vec3> mean(options.width, height, glm::vec3(0)), error = mean;
    const bool shows_lamps = options.layer == Layer::all || options.layer == Layer::direct;
    for (std::size_t i = 0; i < emitted.size(); ++i) {
        const bool all = options.layer == Layer::all;
        mean.pixels[i] = glm::vec3(part_of(traced.mean[i], options.layer) + (shows_lamps ? emitted[i] : Color(0)));
        error.pixels[i] = glm::vec3(all ? traced.sum_error[i] : part_of(traced.standard_error[i], options.layer));
    }
    return {Samples(mean), Samples(error), traced.samples};
}

} // namespace

bool is_room_or_file(const std::string& scene) {
    return is_room(scene) || scene.ends_with(".glb") || scene.ends_with(".gltf");
}

RoomPicture path_trace_room(const RoomPictureOptions& options, ThreadExecutor& threads,
                            const std::function<void(const std::string&)>& note,
                            const std::function<bool(const RoomPicture&)>& progress) {
    const TracedScene traced = open_scene(options.scene, note);
    const std::size_t height =
        options.height_given
            ? options.height
            : static_cast<std::size_t>((std::max)(1.0, std::round(double(options.width) / aspect_of(traced.camera))));
    const auto camera = camera_from<double>(traced.camera, options.width, height);
    Background<double, Color> background;
    if (!traced.lamps.environments.empty())
        background = [&traced](const Color& direction) { return traced.lamps.background(direction); };
    const auto eye = trace_eye_paths(traced.scene, camera, {.samples = options.eye_paths, .seed = options.tracing.seed},
                                     threads, background);
    const auto layers = path_trace_layers(
        traced.scene, traced.lamps, eye.vertices, options.width * height, options.tracing, threads,
        [&](const TracedLayers<Color>& so_far) { return progress(picture_of(so_far, eye.emitted, options, height)); });
    return picture_of(layers, eye.emitted, options, height);
}

} // namespace nephroid::examples
