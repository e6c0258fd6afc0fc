// SPDX-License-Identifier: MIT
#include "common/study/compare/page.hpp"

#include "common/study/bench.hpp"
#include "common/study/compare/pictures.hpp"
#include "common/text.hpp"

namespace nephroid::examples::study::compare {

namespace {

[[nodiscard]] std::string truth_of(const Options& options, const Bench& bench) {
    if (bench.is_exact())
        return "the exact irradiance";
    return escaped_for_html("the reference " + options.reference->filename().string() + ", whose own noise is " +
                            text("%.4f", bench.reference_noise()) + " of its mean; rel is corrected for it");
}

} // namespace

void begin_page(Page& page, const Options& options, const Bench& bench, const std::vector<Trial>& trials,
                const std::filesystem::path& pictures) {
    page.paragraph(
        "Every method gets the same photons and the same eye path vertices, and at each number of photons the "
        "bandwidth that is best for it, found by a sweep. Errors are against " +
        truth_of(options, bench) +
        ": rel is rms(E − E<sub>ref</sub>)/mean(E<sub>ref</sub>); RMSE and SSIM are of the pictures exposed "
        "to half grey and clipped. Times are of the whole way from the lamp to the picture, the map of eye "
        "path vertices or of photons included; methods that need no differentials trace without them.");
    page.note(text("%zu × %zu pixels, %u eye path%s per pixel, seed %llu, %u threads", options.width, options.height,
                   options.samples, options.samples == 1 ? "" : "s", static_cast<unsigned long long>(options.seed),
                   bench.threads().threads()));
    std::vector<Exhibit> whole = {{"reference", "", pictures / "reference.png", {}}};
    const std::uint64_t target = target_photons(options);
    for (const char* id : {"splat-auto", "splat", "nearest"})
        for (const Trial& trial : trials)
            if (trial.method->id == id && trial.wanted == target && trial.sequence == trials.front().sequence)
                whole.push_back({trial.method->title + ", " + grouped(target) + " " + name_of(trial.sequence) +
                                     " photons, SSIM " + error_text(trial.by(Measure::ssim).errors.ssim),
                                 "",
                                 picture_path(pictures, trial, Measure::ssim),
                                 {}});
    page.pictures(whole);
}

void end_page(Page& page, const Options& options) {
    page.heading("Methods");
    std::string list = "<ul>\n";
    for (const std::string& id : options.methods) {
        const Method& method = *find_method(id);
        list += "<li><code>" + method.id + "</code>: " + escaped_for_html(method.title) + " [" +
                escaped_for_html(method.source) + "]" +
                (method.symbol.empty() ? "" : ", " + method.symbol + ": " + escaped_for_html(method.bandwidth)) +
                "</li>\n";
    }
    page.paragraph(list + "</ul>");
}

} // namespace nephroid::examples::study::compare
