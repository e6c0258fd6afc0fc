// SPDX-License-Identifier: MIT
#include "common/second_order/options.hpp"

#include "common/builtin_film.hpp"

#include "nephroid/smoothing/policies.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::examples::second_order {

namespace {

const std::string exact_cases = "wave-focused,wave-prefocal,ring,ring-zoom,ball,ball-point";

[[nodiscard]] std::vector<std::string> read_cases(const std::string& text) {
    std::vector<std::string> cases;
    for (const std::string& word : listed("--cases", text)) {
        if (!is_builtin(word))
            throw UsageError("--cases: '" + word + "' is none of " + builtin_names());
        if (std::ranges::find(cases, word) == cases.end())
            cases.push_back(word);
    }
    return cases;
}

void check(const Options& options) {
    if ((std::min)(options.each.width, options.each.height) < 16)
        throw UsageError("--size: less than 16 pixels a side");
    check_threads(options.each.threads);
    if (!(options.fixed_smoothing > 0) || !std::isfinite(options.fixed_smoothing))
        throw UsageError("--fixed-smoothing: it must be positive and finite");
    if (options.each.fresnel &&
        std::ranges::any_of(options.cases, [](const std::string& name) { return name.starts_with("ring"); }))
        throw UsageError("--fresnel: the ring is a perfect mirror; leave it out of --cases");
}

} // namespace

std::optional<Options> read_options(int argc, const char* const* argv) {
    Options options{{}, {}, default_smoothing, {}};
    CLI::App app(
        "Holds second-order splatting, which chooses its footprints, against first order at the best smoothing "
        "there is, on cases whose caustics are known exactly. Prints Markdown.",
        "second_order");
    std::string cases = exact_cases, photons = "5000,20000,80000,320000,1280000", sequence = "halton,random";
    std::string size = "256", seed = "0", fresnel = "off", csv;
    options.each.threads = 1;
    app.add_option("--cases", cases, "Some of " + exact_cases + " [all]");
    app.add_option("--photons", photons, "Caustic photons, several counts [5000,20000,80000,320000,1280000]");
    app.add_option("--sequence", sequence, "Some of halton,sobol,random [halton,random]");
    app.add_option("--size", size, "Pixels: 640x360 or 256 [256]");
    app.add_option("--seed", seed, "Of the sequences [0]");
    app.add_option("--fresnel", fresnel, "on|off: reflection losses of water and glass [off]");
    app.add_option("--fixed-smoothing", options.fixed_smoothing, "s of the slopes at a fixed s [8]");
    app.add_option("--threads", options.each.threads, "0 takes all that the machine has [1]; errors are the same");
    app.add_option("--csv", csv, "A file for all figures");
    if (!parse(app, argc, argv))
        return std::nullopt;
    options.cases = read_cases(cases);
    options.each.photons = read_photon_counts(photons);
    options.each.sequences = read_sequences(sequence);
    const PictureSize pixels = picture_size(size);
    options.each.width = pixels.width;
    options.each.height = pixels.height;
    options.each.seed = whole_number("--seed", seed, 0);
    options.each.fresnel = chosen("--fresnel", fresnel, Names<bool>{{"on", true}, {"off", false}});
    options.each.repeats = 1; // a median of several would take as many times as long
    if (!csv.empty())
        options.csv = csv;
    check(options);
    return options;
}

} // namespace nephroid::examples::second_order
