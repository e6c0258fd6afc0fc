// SPDX-License-Identifier: MIT
#include "common/compare/options.hpp"

#include "common/builtin_film.hpp"
#include "common/compare/methods.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>

namespace nephroid::examples {

namespace {

template <class T>
void keep_first_of_each(std::vector<T>& entries) {
    std::vector<T> kept;
    for (T& entry : entries)
        if (std::ranges::find(kept, entry) == kept.end())
            kept.push_back(std::move(entry));
    entries = std::move(kept);
}

[[nodiscard]] std::vector<std::string> read_methods(const std::string& text) {
    std::vector<std::string> ids;
    if (text.empty()) {
        for (const Method& method : methods())
            if (method.id != "nearest-checked") // slow, as the best k is large and each look-up is sorted
                ids.push_back(method.id);
        return ids;
    }
    for (const std::string& word : listed("--methods", text)) {
        if (word == "all")
            for (const Method& method : methods())
                ids.push_back(method.id);
        else if (find_method(word))
            ids.push_back(word);
        else
            throw UsageError("--methods: '" + word + "' is none of all, " + method_names());
    }
    keep_first_of_each(ids);
    return ids;
}

[[nodiscard]] std::string command_line(int argc, const char* const* argv) {
    std::string command = "compare";
    for (int i = 1; i < argc; ++i)
        command += " " + std::string(argv[i]);
    return command;
}

void check(const CompareOptions& options) {
    if (!is_builtin(options.scene))
        throw UsageError("'" + options.scene + "' is none of " + builtin_names());
    if ((std::min)(options.width, options.height) < 16)
        throw UsageError("--size: less than 16 pixels a side");
    if (options.samples < 1 || options.samples > 64)
        throw UsageError("--samples: " + std::to_string(options.samples) + " is not from 1 to 64");
    if (options.repeats < 1 || options.repeats > 100)
        throw UsageError("--repeats: " + std::to_string(options.repeats) + " is not from 1 to 100");
    check_threads(options.threads);
    if (options.view)
        check_view(*options.view);
    if (options.standard_error && !options.reference)
        throw UsageError("--standard-error: is of a --reference, which is missing");
}

} // namespace

std::vector<std::string> listed(const std::string& option, const std::string& text) {
    std::vector<std::string> words;
    std::istringstream stream(text + ",");
    for (std::string word; std::getline(stream, word, ',');) {
        if (word.empty())
            throw UsageError(option + ": '" + text + "' has an empty entry");
        words.push_back(word);
    }
    return words;
}

std::vector<std::uint64_t> read_photon_counts(const std::string& text) {
    std::vector<std::uint64_t> counts;
    for (const std::string& word : listed("--photons", text))
        counts.push_back(whole_number("--photons", word, 100));
    std::ranges::sort(counts);
    keep_first_of_each(counts);
    if (counts.back() > 100'000'000)
        throw UsageError("--photons: " + std::to_string(counts.back()) + " are more than 1e8, and all are stored");
    return counts;
}

std::vector<SequenceKind> read_sequences(const std::string& text) {
    std::vector<SequenceKind> kinds;
    for (const std::string& word : listed("--sequence", text))
        kinds.push_back(chosen("--sequence", word, sequence_names()));
    keep_first_of_each(kinds);
    return kinds;
}

std::optional<CompareOptions> read_compare_options(int argc, const char* const* argv) {
    CompareOptions options;
    CLI::App app("Measures photon differential splatting and its rivals: error against bandwidth, photons and time.",
                 "compare");
    app.add_option("case", options.scene, "A built-in case: " + builtin_names())->required();
    std::string methods, photons = "20000,200000,1000000", sequence = "halton,random", size = "512", seed = "0";
    app.add_option("--methods", methods,
                   "all, or some of " + method_names() + " [all but nearest-checked, which is slow]");
    app.add_option("--photons", photons, "Caustic photons, several counts [20000,200000,1000000]");
    app.add_option("--sequence", sequence, "Some of halton,sobol,random [halton,random]");
    app.add_option("--seed", seed, "Of the sequences [0]");
    app.add_flag("--sweep", options.sweep, "Also bandwidths far from the best, for the curves of the smallest count");
    app.add_option("--repeats", options.repeats, "Of each timing, at most; less where one takes long [3]");
    app.add_option("--size", size, "Pixels: 640x360 or 512 [512]");
    app.add_option("--samples", options.samples, "Eye paths per pixel [1]");
    app.add_option("--threads", options.threads, "0 takes all that the machine has [0]; errors are the same");
    std::string fresnel = "off", reference, standard_error, output, html;
    app.add_option("--fresnel", fresnel, "on|off: reflection losses [off]");
    std::vector<double> view;
    app.add_option("--view", view, "x_min x_max y_min y_max: the film, on the floor")->expected(4);
    app.add_option("--reference", reference, "A .pfm of irradiance, for a case without an exact picture");
    app.add_option("--standard-error", standard_error, "A .pfm, of the reference's pixels");
    app.add_option("--output", output, "A folder for the figures, plots and pictures [compare-CASE]");
    app.add_option("--html", html, "A file for the report, one page with all in it");
    if (!parse(app, argc, argv))
        return std::nullopt;
    options.methods = read_methods(methods);
    options.photons = read_photon_counts(photons);
    options.sequences = read_sequences(sequence);
    options.seed = whole_number("--seed", seed, 0);
    const PictureSize pixels = picture_size(size);
    options.width = pixels.width;
    options.height = pixels.height;
    options.fresnel = chosen("--fresnel", fresnel, Names<bool>{{"on", true}, {"off", false}});
    if (!view.empty())
        options.view = {view[0], view[1], view[2], view[3]};
    if (!reference.empty())
        options.reference = reference;
    if (!standard_error.empty())
        options.standard_error = standard_error;
    options.output = output.empty() ? "compare-" + options.scene : output;
    if (!html.empty())
        options.html = html;
    options.command = command_line(argc, argv);
    check(options);
    return options;
}

} // namespace nephroid::examples
