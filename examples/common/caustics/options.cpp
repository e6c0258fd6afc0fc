// SPDX-License-Identifier: MIT
#include "common/caustics/options.hpp"

#include "common/builtin_film.hpp"
#include "common/rooms.hpp"
#include "common/scenes/scenes.hpp"

#include "nephroid/version.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace nephroid::examples {

namespace {

const Names<Method> methods = {
    {"splats", Method::splats}, {"sheets", Method::sheets}, {"published", Method::published}};
const Names<KernelKind> kernels = {{"biweight", KernelKind::biweight},
                                   {"epanechnikov", KernelKind::epanechnikov},
                                   {"cone", KernelKind::cone},
                                   {"uniform", KernelKind::uniform},
                                   {"gaussian", KernelKind::gaussian}};
const Names<bool> switches = {{"on", true}, {"off", false}};
const Names<bool> reflections = {{"one", true}, {"any", false}};

[[nodiscard]] double smoothing_in(const std::string& text) {
    char* end = nullptr;
    const double s = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0')
        throw UsageError("--smoothing: '" + text + "' is neither auto nor cross-validated nor a number");
    return s;
}

/// "-1,-2,0.5" or "-1,-2,0.5,0.53".
[[nodiscard]] Sun sun_in(const std::string& text) {
    const auto refuse = [&](const char* why) { throw UsageError("--sun: '" + text + "' " + why); };
    std::vector<double> numbers;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = (std::min)(text.find(',', at), text.size());
        const std::string part = text.substr(at, comma - at);
        char* end = nullptr;
        numbers.push_back(std::strtod(part.c_str(), &end));
        if (part.empty() || *end != '\0' || !std::isfinite(numbers.back()))
            refuse("is not X,Y,Z or X,Y,Z,SIZE: the direction that its light goes in, and its diameter in degrees");
        at = comma + 1;
    }
    if (numbers.size() != 3 && numbers.size() != 4)
        refuse("is not X,Y,Z or X,Y,Z,SIZE: the direction that its light goes in, and its diameter in degrees");
    Sun sun{{numbers[0], numbers[1], numbers[2]}, numbers.size() == 4 ? numbers[3] : 0};
    const double length = std::hypot(numbers[0], numbers[1], numbers[2]);
    if (!(length > 1e-30) || !std::isfinite(length))
        refuse("has no direction");
    if (!(sun.degrees >= 0 && sun.degrees <= 90))
        refuse("has a diameter that is not from 0 to 90 degrees");
    return sun;
}

[[nodiscard]] double albedo_in(const std::string& text) {
    char* end = nullptr;
    const double albedo = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(albedo > 0 && albedo <= 1))
        throw UsageError("--ground: '" + text + "' is not an albedo above 0 and up to 1");
    return albedo;
}

/// --ground may stand without a number: what follows is then the next argument.
[[nodiscard]] std::vector<const char*> with_albedo(int argc, const char* const* argv) {
    std::vector<const char*> arguments(argv, argv + argc);
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        if (std::string_view(arguments[i]) != "--ground")
            continue;
        char* end = nullptr;
        const char* const next = i + 1 < arguments.size() ? arguments[i + 1] : "";
        const double number = std::strtod(next, &end);
        if (end == next || *end != '\0' || !std::isfinite(number)) // "3d.glb" and "nan" are names of files
            arguments[i] = "--ground=0.8";
    }
    return arguments;
}

/// "2%" or "0.02".
[[nodiscard]] double share_in(const std::string& option, const std::string& text) {
    const bool has_sign = !text.empty() && text.back() == '%';
    const std::string number = has_sign ? text.substr(0, text.size() - 1) : text;
    char* end = nullptr;
    const double share = std::strtod(number.c_str(), &end) * (has_sign ? 0.01 : 1);
    if (number.empty() || *end != '\0' || !(share > 0 && share < 1))
        throw UsageError(option + ": '" + text + "' is not above 0 and below 100%");
    return share;
}

[[nodiscard]] std::string version_text() {
    return "nephroid " + std::to_string(NEPHROID_VERSION_MAJOR) + '.' + std::to_string(NEPHROID_VERSION_MINOR) + '.' +
           std::to_string(NEPHROID_VERSION_PATCH);
}

void refuse_contradictions(const Options& options) {
    if (options.smoothing && (!std::isfinite(*options.smoothing) || !(*options.smoothing > 0)))
        throw UsageError("--smoothing: " + std::to_string(*options.smoothing) + " is not a positive number");
    if (!options.first_order && options.cross_validated)
        throw UsageError("--smoothing: cross-validated chooses one s for all photons and comes with --first-order");
    if (options.first_order && options.curved)
        throw UsageError("--curved: bends what --first-order keeps straight; leave one of them out");
    if (!options.first_order && options.kernel != KernelKind::biweight)
        throw UsageError("--kernel: other kernels than the biweight come with --first-order here");
    if (options.bands && *options.bands != Options::most_bands)
        throw UsageError("--bands: " + std::to_string(*options.bands) + " is not 16, the number that is built in");
    if (options.bands && options.curved)
        throw UsageError("--curved: splats photons in pieces, and so does --bands; leave one of them out");
    if (options.bands && is_builtin(options.scene))
        throw UsageError("--bands: is for files and rooms; the glass of a built-in case does not disperse");
    if (options.bands && options.cross_validated)
        throw UsageError("--smoothing: cross-validated is not for --bands; give s, or leave it to auto");
    if (options.bands && options.error)
        throw UsageError("--bands: makes one pass; leave --error out");
    if (options.samples < 1 || options.samples > 4096)
        throw UsageError("--samples: " + std::to_string(options.samples) + " is not from 1 to 4096");
    check_threads(options.threads);
    if (is_builtin(options.scene) && (options.sun || options.ground || options.environment))
        throw UsageError("--sun, --ground and --environment: are for files; a built-in case has its own");
    if (options.sun && options.ground && !(options.sun->direction[1] < 0))
        throw UsageError("--sun: its light does not go down (y is upwards), so it does not reach the --ground");
    if (options.layers && options.layers->extension() != ".exr" && options.layers->extension() != ".EXR")
        throw UsageError("--layers: '" + options.layers->string() +
                         "' does not end in .exr, which has room for layers");
    if (options.layers && *options.layers == options.output)
        throw UsageError("--layers: '" + options.layers->string() + "' is also the --output; name another file");
    if (options.view)
        check_view(*options.view);
}

/// Options of splats, which sheets would ignore.
void refuse_what_sheets_ignore(const CLI::App& app) {
    for (const char* const name :
         {"--smoothing", "--first-order", "--curved", "--kernel", "--sequence", "--seed", "--pixel-filter", "--bands"})
        if (app.count(name) > 0)
            throw UsageError(std::string(name) + ": is for splats, and --method sheets needs none of it");
}

/// Options that the layer would ignore.
void refuse_what_has_no_effect(const CLI::App& app, const Options& options) {
    const std::string layer = name_in(layer_names(), options.layer);
    const bool has_indirect = options.layer == Layer::all || options.layer == Layer::indirect;
    const bool has_caustics = options.layer == Layer::all || options.layer == Layer::caustics;
    if (!has_indirect && options.bounces)
        throw UsageError("--bounces: --layer " + layer +
                         " has no light between diffuse surfaces; leave one of them out");
    if (options.layer == Layer::indirect && options.bounces == 0u)
        throw UsageError("--bounces: without any, --layer indirect has no light");
    for (const char* const name : {"--method", "--smoothing", "--first-order", "--curved", "--kernel", "--bands"})
        if (!has_caustics && app.count(name) > 0)
            throw UsageError(std::string(name) + ": is for caustics, and --layer " + layer + " has none");
    if (options.layer == Layer::direct && options.error)
        throw UsageError("--error: is for photons, and --layer direct has none");
}

} // namespace

const char* name_of(Method method) { return name_in(methods, method); }

const char* name_of(KernelKind kernel) { return name_in(kernels, kernel); }

std::optional<Options> read_options(int argc, const char* const* argv) {
    Options options;
    CLI::App app("Renders caustics by photon differential splatting and says how wrong they are.", "caustics");
    app.add_option("scene", options.scene,
                   "A built-in case (" + builtin_names() + "), a room (" + names_of_rooms() + "), a scene (" +
                       names_of_scenes() + ") or a .glb or .gltf file")
        ->required();
    app.set_version_flag("--version", version_text());
    std::string photons = "20000", emit, error, size = "512", seed = "0";
    app.add_option("--photons", photons,
                   "Caustic photons wanted [20000]; a pilot pass finds how many to emit. As many are emitted for "
                   "light between diffuse surfaces");
    app.add_option("--error", error,
                   "2%, say: passes of so many photons, until the noise of their mean is below that share of each "
                   "layer's light. The picture so far is written after Ctrl-C");
    app.add_option("--emit", emit, "Photons to emit, instead of --photons");
    std::string method = "splats", smoothing = "auto";
    app.add_option("--method", method,
                   "splats|sheets|published: splats to second order; patches of light between photons, and splats "
                   "where light lies on none; splats where photons land, as Frisvad et al. 2014 do [splats]");
    app.add_option(
        "--smoothing", smoothing,
        "auto, or s: the footprints cover the light's domain s^2 times [auto; 8 with --first-order], or with "
        "--first-order cross-validated: the s at which parts of the photons agree best");
    app.add_flag("--first-order", options.first_order, "The same as --method published");
    app.add_flag("--curved", options.curved, "Splat in pieces where the light bends: for few photons on sharp folds");
    unsigned bands = 0;
    app.add_option(
        "--bands", bands,
        "16: caustics of a file in so many bands of the spectrum, for glass that disperses; in --layers each "
        "has a channel");
    app.add_option("--size", size,
                   "Pixels: 640x360, or a width, with the height a file's camera wants or the same [512]");
    app.add_option("--samples", options.samples, "Eye paths per pixel [1]");
    std::string kernel = "biweight", sequence = "halton", filter = "on", fresnel = "off", reflection = "any";
    std::string layer = "all", bounces, output, layers, json, reference;
    app.add_option("--kernel", kernel, "biweight|epanechnikov|cone|uniform|gaussian [biweight]");
    app.add_option("--sequence", sequence, "halton|sobol|r2|random [halton]");
    app.add_option("--seed", seed, "Of the sequence [0]");
    app.add_option("--threads", options.threads, "0 takes all that the machine has [0]; the picture is the same");
    app.add_option("--pixel-filter", filter, "on|off [on]");
    app.add_option("--fresnel", fresnel, "on|off: reflection losses of a built-in case [off]");
    app.add_option("--reflections", reflection, "one|any: of the ring [any]");
    std::vector<double> view;
    app.add_option("--view", view, "x_min x_max y_min y_max: the film of a built-in case, on the floor")->expected(4);
    app.add_option("--layer", layer, "all|caustics|direct|indirect: of a file's or a room's picture [all]");
    app.add_option("--bounces", bounces,
                   "all or a number: of light between diffuse surfaces, before the one that is seen [all; of a file 0, "
                   "but for --layer indirect]");
    std::string sun, ground, environment;
    app.add_option("--sun", sun,
                   "X,Y,Z[,SIZE]: add one to a file, with the direction that its light goes in (y is upwards) and its "
                   "diameter in degrees; a file without light gets one");
    app.add_option("--ground", ground,
                   "[ALBEDO]: add one to a file below what is specular [0.8]; a file without gets one");
    app.add_option("--environment", environment,
                   "constant|FILE: light from all around a file's scene, the same, or by a picture of longitude and "
                   "latitude (.hdr, .exr, .pfm or .png)");
    app.add_option("--output", output, "The picture, .exr, .pfm or .png [the scene's name, .png]");
    app.add_option("--layers", layers,
                   "An .exr with each layer in channels of its own, and with --error the variance of each pixel");
    app.add_option("--json", json, "A file for the statistics");
    app.add_option("--reference", reference, "A .pfm of the same size to compare with, of many photons, say");
    const std::vector<const char*> arguments = with_albedo(argc, argv);
    if (!parse(app, static_cast<int>(arguments.size()), arguments.data()))
        return std::nullopt;
    if (app.count("--sun") > 0)
        options.sun = sun_in(sun);
    if (app.count("--ground") > 0)
        options.ground = albedo_in(ground);
    if (app.count("--environment") > 0)
        options.environment = environment;
    options.photons = whole_number("--photons", photons, 1);
    if (app.count("--error") > 0)
        options.error = share_in("--error", error);
    if (!emit.empty())
        options.emit = whole_number("--emit", emit, 1);
    options.seed = whole_number("--seed", seed, 0);
    const PictureSize pixels = picture_size(size);
    options.width = pixels.width;
    options.height = pixels.height;
    options.height_given = pixels.height_given;
    if (app.count("--bands") > 0)
        options.bands = bands;
    options.cross_validated = smoothing == "cross-validated";
    if (smoothing != "auto" && !options.cross_validated)
        options.smoothing = smoothing_in(smoothing);
    options.method = chosen("--method", method, methods);
    if (options.method == Method::published)
        options.first_order = true;
    options.kernel = chosen("--kernel", kernel, kernels);
    options.sequence = chosen("--sequence", sequence, sequence_names());
    options.pixel_filter = chosen("--pixel-filter", filter, switches);
    options.fresnel = chosen("--fresnel", fresnel, switches);
    options.one_reflection = chosen("--reflections", reflection, reflections);
    if (!bounces.empty())
        options.bounces = bounces_in(bounces);
    options.layer = chosen("--layer", layer, layer_names());
    if (!view.empty())
        options.view = {view[0], view[1], view[2], view[3]};
    options.output = !output.empty() ? output : std::filesystem::path(options.scene).stem().string() + ".png";
    if (app.count("--layers") > 0)
        options.layers = layers;
    if (!json.empty())
        options.json = json;
    if (!reference.empty())
        options.reference = reference;
    if (options.method == Method::sheets)
        refuse_what_sheets_ignore(app);
    else if (options.first_order && app.count("--method") > 0 && options.method == Method::splats)
        throw UsageError("--first-order: is --method published; leave --method splats out");
    refuse_contradictions(options);
    refuse_what_has_no_effect(app, options);
    return options;
}

} // namespace nephroid::examples
