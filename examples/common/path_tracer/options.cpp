// SPDX-License-Identifier: MIT
#include "common/path_tracer/options.hpp"

#include "common/rooms.hpp"
#include "common/text.hpp"

#include <CLI/CLI.hpp>

#include <cmath>

namespace nephroid::examples {

namespace {

/// What is asked of a room or a file. Throws UsageError if it is asked of a caustic on a floor.
void read_room(TraceRequest& request, const CLI::App& app, const std::string& bounces, const std::string& layer) {
    RoomPictureOptions& room = request.room;
    room.layer = chosen("--layer", layer, layer_names());
    const bool has_bounces = is_room(request.scene) || room.layer == Layer::indirect; // by default, as in `caustics`
    room.tracing.bounces = app.count("--bounces") > 0 ? bounces_in(bounces) : has_bounces ? all_bounces : 0;
    if (room.eye_paths < 1 || room.eye_paths > 4096)
        throw UsageError("--eye-paths: " + std::to_string(room.eye_paths) + " is not from 1 to 4096");
    if (!is_room_or_file(request.scene)) {
        if (app.count("--layer") + app.count("--eye-paths") > 0 ||
            (app.count("--bounces") > 0 && room.tracing.bounces > 0))
            throw UsageError("--layer, --bounces and --eye-paths: are for the rooms " + names_of_rooms() +
                             " and files; the picture of a case is its caustic");
        return;
    }
    if (app.count("--reflections") > 0)
        throw UsageError("--reflections: is for the ring");
    if (app.count("--bounces") > 0 && (room.layer == Layer::direct || room.layer == Layer::caustics))
        throw UsageError(std::string("--bounces: --layer ") + name_in(layer_names(), room.layer) +
                         " has no light between diffuse surfaces; leave one of them out");
    if (request.tracing.samples < 2)
        throw UsageError("--samples: a room and a file take at least 2, as 1 tells no standard error");
    room.scene = request.scene;
    room.width = request.size.width, room.height = request.size.height;
    room.height_given = request.size.height_given;
    room.tracing.samples = request.tracing.samples;
    room.tracing.seconds = request.tracing.seconds;
    room.tracing.seed = request.tracing.seed;
}

} // namespace

std::string traceable_names() {
    std::string names;
    for (const std::string_view name : builtin_case_names)
        if (!builtin_case<double, double>(name, false)->emitters.empty())
            names += (names.empty() ? "" : ", ") + std::string(name);
    return names;
}

std::optional<TraceRequest> read_trace_request(int argc, const char* const* argv) {
    TraceRequest request;
    std::string size = "256", samples = "4096", seed = "0", output, standard_error, reflections = "any";
    std::string bounces, layer = "all";
    CLI::App app("Path traces light from lamps that have area, with a standard error for each pixel: the caustic of a "
                 "case on its floor, or what a camera sees of a room, by layers.",
                 "reference_path_tracer");
    app.add_option("case", request.scene,
                   "A built-in case whose light has area (" + traceable_names() + "), a room (" + names_of_rooms() +
                       ") or a .glb or .gltf file")
        ->required();
    app.add_option("--size", size,
                   "Pixels: 512x256, or a width, with the height a file's camera wants or the same [256]");
    app.add_option("--samples", samples, "Paths from each pixel, in a room from each eye path [4096]");
    app.add_option("--seconds", request.tracing.seconds, "Begin no further pass after these [no limit]");
    app.add_option("--reflections", reflections, "one|any: leave out what would be reflected twice [any]");
    app.add_option("--layer", layer,
                   "all|direct|caustics|indirect: of a room; direct light meets nothing before the surface that is "
                   "seen, caustics mirrors and glass alone, indirect light a diffuse surface [all]");
    app.add_option("--bounces", bounces,
                   "Off diffuse surfaces before the one that is seen: a number or all [all; of a file 0, but for "
                   "--layer indirect]");
    app.add_option("--eye-paths", request.room.eye_paths, "Of a room, for each pixel [1]");
    app.add_option("--seed", seed, "Of the random numbers [0]");
    app.add_option("--threads", request.threads, "0 takes all that the machine has [0]; the picture is the same");
    app.add_option("--output", output, "The picture, .pfm, .exr or .png [the case's name, .pfm]");
    app.add_option("--standard-error", standard_error, "A file for the standard error of each pixel");
    if (!parse(app, argc, argv))
        return std::nullopt;

    request.size = picture_size(size);
    request.tracing.samples = whole_number("--samples", samples, 1);
    request.tracing.seed = whole_number("--seed", seed, 0);
    if (!(request.tracing.seconds >= 0))
        throw UsageError("--seconds: " + text("%g", request.tracing.seconds) + " is not a number from 0 up");
    if (chosen("--reflections", reflections, Names<bool>{{"one", true}, {"any", false}}))
        request.tracing.specular_events = 1;
    check_threads(request.threads);
    read_room(request, app, bounces, layer);
    request.mean = output.empty() ? std::filesystem::path(request.scene).stem().string() + ".pfm" : output;
    if (!standard_error.empty())
        request.standard_error = standard_error;
    return request;
}

} // namespace nephroid::examples
