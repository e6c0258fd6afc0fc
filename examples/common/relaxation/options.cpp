// SPDX-License-Identifier: MIT
#include "common/relaxation/options.hpp"

#include "common/builtin_film.hpp"
#include "common/relaxation/pattern.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::examples::relaxation {

namespace {

const Names<bool> switches = {{"on", true}, {"off", false}};
const Names<LookKernel> kernels = {{"epanechnikov", LookKernel::epanechnikov}, {"biweight", LookKernel::biweight}};
const Names<FluxDiffusion> diffusions = {{"none", FluxDiffusion::none},
                                         {"conserving", FluxDiffusion::conserving},
                                         {"weighted-mean", FluxDiffusion::weighted_mean}};

/// "10,20,50" as numbers of neighbours, in order and each once.
[[nodiscard]] std::vector<std::size_t> counts(const std::string& option, const std::string& list) {
    std::vector<std::size_t> numbers;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = (std::min)(list.find(',', begin), list.size());
        const std::uint64_t number = whole_number(option, list.substr(begin, end - begin), 2);
        if (number > 100'000)
            throw UsageError(option + ": " + std::to_string(number) + " neighbours are more than 100000");
        numbers.push_back(static_cast<std::size_t>(number));
        begin = end + 1;
    }
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    return numbers;
}

void check(const Options& options) {
    check_threads(options.threads);
    if (options.samples < 1 || options.samples > 4096)
        throw UsageError("--samples: " + std::to_string(options.samples) + " is not from 1 to 4096");
    if (options.spectrum) {
        const auto& [x_min, x_max, y_min, y_max] = *options.spectrum;
        if (!std::isfinite(x_min + x_max + y_min + y_max) || !(x_min < x_max) || !(y_min < y_max))
            throw UsageError("--spectrum: x_min must be below x_max and y_min below y_max, all finite");
    }
    try {
        nephroid::detail::check(options.relaxation, "relax");
    } catch (const std::invalid_argument& error) {
        throw UsageError(error.what());
    }
}

} // namespace

std::optional<Options> read_options(int argc, const char* const* argv) {
    Options options;
    CLI::App app("Relaxes a photon map into blue noise and shows what that does to the picture.", "relaxation");
    app.add_option("subject", options.subject,
                   "A test pattern (" + pattern_names() + "), a guide image (.png), a built-in case (" +
                       builtin_names() + ") or a .glb or .gltf file");
    app.add_flag("--timing", options.timing,
                 "Instead of pictures: what relaxing so many random photons of the pattern uniform costs");
    std::string photons = "50000", seed = "0", iterations = "20", size = "512";
    std::string sequence = "halton", constrain = "on", diffusion = "none", keep = "off", kernel = "epanechnikov";
    std::string neighbours = "10,20,50,250", sweep = "10,14,20,28,40,56,80,112,160,224,320,500", output;
    app.add_option("--photons", photons, "In a pattern's picture, or caustic photons of a scene [50000]");
    app.add_option("--sequence", sequence, "halton|sobol|random: where the photons come from [halton]");
    app.add_option("--seed", seed, "Of the sequence [0]");
    app.add_option("--iterations", iterations, "Of the relaxation [20]; random photons want 30 to 50");
    app.add_option("--keep-density", keep,
                   "on|off: aim at the map's own densities, pushed by 12 neighbours and without over-relaxation [off]");
    std::vector<double> over_relaxation, features, spectrum;
    app.add_option("--over-relaxation", over_relaxation, "lambda at the first and towards the last iteration [2 1.2]")
        ->expected(2);
    app.add_option("--constrain", constrain, "on|off: hold photons at features [on]");
    app.add_option("--features", features, "alpha beta: ratios of density held fully and from which on not at all")
        ->expected(2);
    app.add_option("--rho", options.relaxation.rho, "Moves of so many radii are halved; 0 does not limit them [0.3]");
    app.add_option("--flux-diffusion", diffusion, "none|conserving|weighted-mean [none]");
    app.add_option("--neighbours", neighbours, "k of the pictures [10,20,50,250]");
    app.add_option("--kernel", kernel, "epanechnikov|biweight: of all pictures [epanechnikov, as in the paper]");
    app.add_option("--sweep", sweep, "k among which the unrelaxed map's best is looked for [10 to 500, times 1.4]");
    app.add_option("--size", size,
                   "Pixels: 640x360, or a width, with the height a file's camera wants or the same [512]");
    app.add_option("--samples", options.samples, "Eye paths per pixel [1]");
    app.add_option("--spectrum", spectrum, "x_min x_max y_min y_max: evenly lit floor to take the spectrum of")
        ->expected(4);
    app.add_option("--threads", options.threads, "0 takes all that the machine has [0]; the picture is the same");
    app.add_option("--output", output, "A folder for the pictures, plots and tables [relaxation-SUBJECT]");
    if (!parse(app, argc, argv))
        return std::nullopt;

    if (options.subject.empty() && !options.timing)
        throw UsageError("name a subject: a pattern (" + pattern_names() + "), a built-in case (" + builtin_names() +
                         ") or a .png, .glb or .gltf file");
    options.photons = whole_number("--photons", photons, 1);
    options.seed = whole_number("--seed", seed, 0);
    options.sequence = chosen("--sequence", sequence, sequence_names());
    if (chosen("--keep-density", keep, switches)) {
        const double rho = options.relaxation.rho;
        options.relaxation = RelaxationOptions::keeping_density();
        options.relaxation.rho = rho;
    }
    options.kernel = chosen("--kernel", kernel, kernels);
    const std::uint64_t rounds = whole_number("--iterations", iterations, 0);
    if (rounds > 100'000)
        throw UsageError("--iterations: " + iterations + " are more than 100000");
    options.relaxation.iterations = static_cast<unsigned>(rounds);
    options.relaxation.constrain = chosen("--constrain", constrain, switches);
    options.relaxation.flux_diffusion = chosen("--flux-diffusion", diffusion, diffusions);
    if (!over_relaxation.empty()) {
        options.relaxation.over_relaxation = over_relaxation[0];
        options.relaxation.final_relaxation = over_relaxation[1];
    }
    if (!features.empty()) {
        options.relaxation.alpha = features[0];
        options.relaxation.beta = features[1];
    }
    options.neighbours = counts("--neighbours", neighbours);
    options.sweep = counts("--sweep", sweep);
    const PictureSize pixels = picture_size(size);
    options.width = pixels.width;
    options.height = pixels.height;
    options.height_given = pixels.height_given;
    if (!spectrum.empty())
        options.spectrum = {spectrum[0], spectrum[1], spectrum[2], spectrum[3]};
    options.output = !output.empty() ? output : "relaxation-" + std::filesystem::path(options.subject).stem().string();
    check(options);
    return options;
}

} // namespace nephroid::examples::relaxation
