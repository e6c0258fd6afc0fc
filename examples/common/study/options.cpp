// SPDX-License-Identifier: MIT
#include "common/study/options.hpp"

#include "common/builtin_film.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>
#include <utility>

namespace nephroid::examples::study {

namespace {

template <class T>
void keep_first_of_each(std::vector<T>& entries) {
    std::vector<T> kept;
    for (T& entry : entries)
        if (std::ranges::find(kept, entry) == kept.end())
            kept.push_back(std::move(entry));
    entries = std::move(kept);
}

[[nodiscard]] std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words)
        text += (text.empty() ? "" : ", ") + word;
    return text;
}

void check(const Options& options) {
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
    keep_first_of_each(words);
    return words;
}

std::vector<std::uint64_t> read_photon_counts(const std::string& text, const std::string& option) {
    std::vector<std::uint64_t> counts;
    for (const std::string& word : listed(option, text))
        counts.push_back(whole_number(option, word, 100));
    std::ranges::sort(counts);
    keep_first_of_each(counts);
    if (counts.back() > 100'000'000)
        throw UsageError(option + ": " + std::to_string(counts.back()) + " are more than 1e8, and all are stored");
    return counts;
}

std::vector<SequenceKind> read_sequences(const std::string& text) {
    std::vector<SequenceKind> kinds;
    for (const std::string& word : listed("--sequence", text))
        kinds.push_back(chosen("--sequence", word, sequence_names()));
    return kinds;
}

MeasuringArguments::MeasuringArguments(CLI::App& app, const Defaults& defaults)
    : photons_(defaults.photons), size_(defaults.size), threads_(defaults.threads), repeats_(defaults.repeats) {
    app.add_option("--photons", photons_, "Caustic photons, several counts [" + photons_ + "]");
    app.add_option("--sequence", sequence_, "Some of halton,sobol,r2,random [halton,random]");
    app.add_option("--seed", seed_, "Of the sequences [0]");
    app.add_option("--repeats", repeats_,
                   "Of each timing, at most; less where one takes long [" + std::to_string(repeats_) + "]");
    app.add_option("--size", size_, "Pixels: 640x360 or 512 [" + size_ + "]");
    app.add_option("--samples", samples_, "Eye paths per pixel [1]");
    app.add_option("--threads", threads_,
                   "0 takes all that the machine has [" + std::to_string(threads_) + "]; errors are the same");
    app.add_option("--fresnel", fresnel_, "on|off: reflection losses [off]");
    app.add_option("--view", view_, "x_min x_max y_min y_max: the film, on the floor")->expected(4);
    app.add_option("--reference", reference_, "A .pfm of irradiance, for a case without an exact picture");
    app.add_option("--standard-error", standard_error_, "A .pfm, of the reference's pixels");
}

Options MeasuringArguments::read() const {
    Options options;
    options.photons = read_photon_counts(photons_);
    options.sequences = read_sequences(sequence_);
    options.seed = whole_number("--seed", seed_, 0);
    options.repeats = repeats_;
    const PictureSize pixels = picture_size(size_);
    options.width = pixels.width;
    options.height = pixels.height;
    options.samples = samples_;
    options.threads = threads_;
    options.fresnel = chosen("--fresnel", fresnel_, Names<bool>{{"on", true}, {"off", false}});
    if (!view_.empty())
        options.view = {view_[0], view_[1], view_[2], view_[3]};
    if (!reference_.empty())
        options.reference = reference_;
    if (!standard_error_.empty())
        options.standard_error = standard_error_;
    check(options);
    return options;
}

PresentationArguments::PresentationArguments(CLI::App& app, std::vector<std::string> tables)
    : known_(std::move(tables)) {
    app.add_option("--output", output_, "A folder for figures, plots, pictures and a page, report.html [study-…]");
    app.add_flag("--markdown", markdown_, "Print the tables as Markdown, and nothing else");
    app.add_option("--table", tables_, "Which tables to print, some of " + joined(known_) + " [most]");
}

Presentation PresentationArguments::read(const std::string& output, const std::string& command) const {
    Presentation presentation{output_.empty() ? output : output_, TableFormat::text, {}, command};
    if (markdown_)
        presentation.format = TableFormat::markdown;
    if (!tables_.empty())
        presentation.tables = listed("--table", tables_);
    for (const std::string& name : presentation.tables)
        if (std::ranges::find(known_, name) == known_.end())
            throw UsageError("--table: '" + name + "' is none of " + joined(known_));
    return presentation;
}

} // namespace nephroid::examples::study
