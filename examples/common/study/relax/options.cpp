// SPDX-License-Identifier: MIT
#include "common/study/relax/options.hpp"

#include "common/builtin_film.hpp"
#include "common/study/relax/pattern.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::examples::study::relax {

namespace {

const Names<bool> switches = {{"on", true}, {"off", false}};
const Names<LookKernel> kernels = {{"epanechnikov", LookKernel::epanechnikov}, {"biweight", LookKernel::biweight}};
const Names<FluxDiffusion> diffusions = {{"none", FluxDiffusion::none},
                                         {"conserving", FluxDiffusion::conserving},
                                         {"weighted-mean", FluxDiffusion::weighted_mean}};

/// "a,b,c" as its words.
[[nodiscard]] std::vector<std::string> words(const std::string& list) {
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = (std::min)(list.find(',', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

/// "10,20,50" as numbers of neighbours, in order and each once.
[[nodiscard]] std::vector<std::size_t> counts(const std::string& option, const std::string& list) {
    std::vector<std::size_t> numbers;
    for (const std::string& word : words(list)) {
        const std::uint64_t number = whole_number(option, word, 2);
        if (number > 100'000)
            throw UsageError(option + ": " + std::to_string(number) + " neighbours are more than 100000");
        numbers.push_back(static_cast<std::size_t>(number));
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

Arguments::Arguments(CLI::App& app) : rho_(RelaxationOptions{}.rho) {
    app.add_option("subjects", subjects_,
                   "Test patterns (" + pattern_names() + "), guide images (.png), built-in cases (" + builtin_names() +
                       "), .glb and .gltf files");
    app.add_flag("--timing", timing_,
                 "Instead of pictures: what relaxing so many random photons of the pattern uniform costs");
    app.add_option("--photons", photons_, "In a pattern's picture, or caustic photons of a scene [50000]");
    app.add_option("--sequence", sequence_,
                   "halton|sobol|r2|random: where the photons come from, or several, such as random,halton [halton]");
    app.add_option("--seed", seed_, "Of the sequence [0]");
    app.add_option("--iterations", iterations_, "Of the relaxation [20]; random photons want 30 to 50");
    app.add_option("--keep-density", keep_,
                   "on|off: aim at the map's own densities, pushed by 12 neighbours and without over-relaxation [off]");
    app.add_option("--over-relaxation", over_relaxation_, "lambda at the first and towards the last iteration [2 1.2]")
        ->expected(2);
    app.add_option("--constrain", constrain_, "on|off: hold photons at features [on]");
    app.add_option("--features", features_, "alpha beta: ratios of density held fully and from which on not at all")
        ->expected(2);
    app.add_option("--rho", rho_, "Moves of so many radii are halved; 0 does not limit them [0.3]");
    app.add_option("--flux-diffusion", diffusion_, "none|conserving|weighted-mean [none]");
    app.add_option("--neighbours", neighbours_,
                   "k of the pictures [10,20,50,250]; chosen: what the relaxation reports, for the relaxed map alone");
    app.add_option("--kernel", kernel_, "epanechnikov|biweight: of all pictures [epanechnikov, as in the paper]");
    app.add_option("--sweep", sweep_, "k among which the unrelaxed map's best is looked for [10 to 500, times 1.4]");
    app.add_option("--size", size_,
                   "Pixels: 640x360, or a width, with the height a file's camera wants or the same [512]");
    app.add_option("--samples", samples_, "Eye paths per pixel [1]");
    app.add_option("--spectrum", spectrum_, "x_min x_max y_min y_max: evenly lit floor to take the spectrum of")
        ->expected(4);
    app.add_option("--threads", threads_, "0 takes all that the machine has [0]; the picture is the same");
}

std::vector<Options> Arguments::read() const {
    if (subjects_.empty() && !timing_)
        throw UsageError("name a subject: a pattern (" + pattern_names() + "), a built-in case (" + builtin_names() +
                         ") or a .png, .glb or .gltf file");
    Options options;
    options.timing = timing_;
    options.photons = whole_number("--photons", photons_, 1);
    options.seed = whole_number("--seed", seed_, 0);
    const std::vector<std::string> sequences = words(sequence_);
    options.sequence = chosen("--sequence", sequences.front(), sequence_names());
    if (chosen("--keep-density", keep_, switches))
        options.relaxation = RelaxationOptions::keeping_density();
    options.relaxation.rho = rho_;
    options.kernel = chosen("--kernel", kernel_, kernels);
    const std::uint64_t rounds = whole_number("--iterations", iterations_, 0);
    if (rounds > 100'000)
        throw UsageError("--iterations: " + iterations_ + " are more than 100000");
    options.relaxation.iterations = static_cast<unsigned>(rounds);
    options.relaxation.constrain = chosen("--constrain", constrain_, switches);
    options.relaxation.flux_diffusion = chosen("--flux-diffusion", diffusion_, diffusions);
    if (!over_relaxation_.empty()) {
        options.relaxation.over_relaxation = over_relaxation_[0];
        options.relaxation.final_relaxation = over_relaxation_[1];
    }
    if (!features_.empty()) {
        options.relaxation.alpha = features_[0];
        options.relaxation.beta = features_[1];
    }
    if (neighbours_ != "chosen")
        options.neighbours = counts("--neighbours", neighbours_);
    options.sweep = counts("--sweep", sweep_);
    const PictureSize pixels = picture_size(size_);
    options.width = pixels.width;
    options.height = pixels.height;
    options.height_given = pixels.height_given;
    options.samples = samples_;
    options.threads = threads_;
    if (!spectrum_.empty())
        options.spectrum = {spectrum_[0], spectrum_[1], spectrum_[2], spectrum_[3]};
    check(options);
    if (timing_)
        return {options};
    std::vector<Options> each;
    for (const std::string& sequence : sequences)
        for (const std::string& subject : subjects_) {
            options.sequence = chosen("--sequence", sequence, sequence_names());
            options.subject = subject;
            each.push_back(options);
        }
    return each;
}

} // namespace nephroid::examples::study::relax
