// SPDX-License-Identifier: MIT
#include "common/caustics/options.hpp"

#include "common/caustics/builtin.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <utility>
#include <vector>

namespace nephroid::examples {

namespace {

template <class Kind>
using Names = std::map<std::string, Kind>;

const Names<SequenceKind> sequences = {
    {"halton", SequenceKind::halton}, {"sobol", SequenceKind::sobol}, {"random", SequenceKind::random}};
const Names<KernelKind> kernels = {{"biweight", KernelKind::biweight},
                                   {"epanechnikov", KernelKind::epanechnikov},
                                   {"cone", KernelKind::cone},
                                   {"uniform", KernelKind::uniform},
                                   {"gaussian", KernelKind::gaussian}};
const Names<Layer> layers = {{"all", Layer::all}, {"caustics", Layer::caustics}, {"direct", Layer::direct}};
const Names<bool> switches = {{"on", true}, {"off", false}};
const Names<bool> reflections = {{"one", true}, {"any", false}};

template <class Kind>
[[nodiscard]] const char* name_in(const Names<Kind>& names, Kind kind) {
    const auto found = std::ranges::find_if(names, [&](const auto& entry) { return entry.second == kind; });
    return found == names.end() ? "?" : found->first.c_str();
}

template <class Kind>
[[nodiscard]] Kind chosen(const std::string& option, const std::string& text, const Names<Kind>& names) {
    const auto found = names.find(text);
    if (found != names.end())
        return found->second;
    std::string known;
    for (const auto& [name, kind] : names)
        known += (known.empty() ? "" : ", ") + name;
    throw UsageError(option + ": '" + text + "' is none of " + known);
}

/// A whole number, also written as 1e6.
[[nodiscard]] std::uint64_t whole_number(const std::string& option, const std::string& text, double least) {
    std::size_t used = 0;
    double value = 0;
    try {
        value = std::stod(text, &used);
    } catch (const std::exception&) {
        used = std::string::npos;
    }
    if (used != text.size() || !(value >= least) || !(value <= 1e15) || value != std::floor(value))
        throw UsageError(option + ": '" + text + "' is not a whole number from " +
                         std::to_string(static_cast<std::uint64_t>(least)) + " to 1e15");
    return static_cast<std::uint64_t>(value);
}

void read_size(Options& options, const std::string& text) {
    const auto cross = text.find('x');
    const auto pixels = [](const std::string& number) {
        const std::uint64_t count = whole_number("--size", number, 1);
        if (count > 32768)
            throw UsageError("--size: " + number + " pixels are more than 32768");
        return static_cast<std::size_t>(count);
    };
    options.width = pixels(text.substr(0, cross));
    options.height = cross == std::string::npos ? options.width : pixels(text.substr(cross + 1));
    options.height_given = cross != std::string::npos;
}

void check(const Options& options) {
    if (!std::isfinite(options.smoothing) || !(options.smoothing > 0))
        throw UsageError("--smoothing: " + std::to_string(options.smoothing) + " is not a positive number");
    if (options.samples < 1 || options.samples > 4096)
        throw UsageError("--samples: " + std::to_string(options.samples) + " is not from 1 to 4096");
    if (options.threads > 1024)
        throw UsageError("--threads: " + std::to_string(options.threads) + " is more than 1024");
    if (options.view) {
        const auto& [x_min, x_max, y_min, y_max] = *options.view;
        for (const double bound : *options.view)
            if (!std::isfinite(bound))
                throw UsageError("--view: every bound must be finite");
        if (!(x_min < x_max) || !(y_min < y_max))
            throw UsageError("--view: x_min must be below x_max, and y_min below y_max");
    }
}

} // namespace

const char* name_of(SequenceKind sequence) { return name_in(sequences, sequence); }
const char* name_of(KernelKind kernel) { return name_in(kernels, kernel); }

std::optional<Options> read_options(int argc, const char* const* argv) {
    Options options;
    CLI::App app("Renders caustics by photon differential splatting and says how wrong they are.", "caustics");
    app.add_option("scene", options.scene, "A built-in case (" + builtin_names() + ") or a .glb or .gltf file")
        ->required();
    std::string photons = "20000", emit, size = "512", seed = "0";
    app.add_option("--photons", photons, "Caustic photons wanted [20000]; a pilot pass finds how many to emit");
    app.add_option("--emit", emit, "Photons to emit, instead of --photons");
    app.add_option("--smoothing", options.smoothing, "s: the footprints cover the light's domain s^2 times [8]");
    app.add_option("--size", size, "Pixels: 640x360, or a width, with the height a file's camera wants or the same [512]");
    app.add_option("--samples", options.samples, "Eye paths per pixel [1]");
    std::string kernel = "biweight", sequence = "halton", filter = "on", fresnel = "off", reflection = "any";
    std::string layer = "all", output, json;
    app.add_option("--kernel", kernel, "biweight|epanechnikov|cone|uniform|gaussian [biweight]");
    app.add_option("--sequence", sequence, "halton|sobol|random [halton]");
    app.add_option("--seed", seed, "Of the sequence [0]");
    app.add_option("--threads", options.threads, "0 takes all that the machine has [0]; the picture is the same");
    app.add_option("--pixel-filter", filter, "on|off [on]");
    app.add_option("--fresnel", fresnel, "on|off: reflection losses of a built-in case [off]");
    app.add_option("--reflections", reflection, "one|any: of the ring [any]");
    std::vector<double> view;
    app.add_option("--view", view, "x_min x_max y_min y_max: the film of a built-in case, on the floor")->expected(4);
    app.add_option("--layer", layer, "all|caustics|direct: of a file's picture [all]");
    app.add_option("--output", output, "The picture, .exr, .pfm or .png [the scene's name, .png]");
    app.add_option("--json", json, "A file for the statistics");
    // CLI11 takes -.5 for an option of that name.
    std::vector<std::string> arguments(argv + 1, argv + argc);
    for (std::string& argument : arguments)
        if (argument.starts_with("-."))
            argument.insert(1, 1, '0');
    std::ranges::reverse(arguments); // as it wants them
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return std::nullopt;
    } catch (const CLI::ParseError& error) {
        std::string line = error.what();
        std::ranges::replace(line, '\n', ' ');
        throw UsageError(line + " (--help lists the options)");
    }
    options.photons = whole_number("--photons", photons, 1);
    if (!emit.empty())
        options.emit = whole_number("--emit", emit, 1);
    options.seed = whole_number("--seed", seed, 0);
    read_size(options, size);
    options.kernel = chosen("--kernel", kernel, kernels);
    options.sequence = chosen("--sequence", sequence, sequences);
    options.pixel_filter = chosen("--pixel-filter", filter, switches);
    options.fresnel = chosen("--fresnel", fresnel, switches);
    options.one_reflection = chosen("--reflections", reflection, reflections);
    options.layer = chosen("--layer", layer, layers);
    if (!view.empty())
        options.view = {view[0], view[1], view[2], view[3]};
    options.output = !output.empty() ? output : std::filesystem::path(options.scene).stem().string() + ".png";
    if (!json.empty())
        options.json = json;
    check(options);
    return options;
}

} // namespace nephroid::examples
