// SPDX-License-Identifier: MIT
#include "common/compare/page.hpp"

#include "common/compare/equal.hpp"
#include "common/text.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace nephroid::examples {

namespace {

constexpr const char* style = R"(
:root { color-scheme: light dark; --ink: #1b1d21; --paper: #fdfdfc; --line: #cfd2d6; --soft: #5d636b;
  --stripe: #f2f3f4; }
@media (prefers-color-scheme: dark) {
  :root { --ink: #e4e6e9; --paper: #16181b; --line: #3a3f45; --soft: #9aa1aa; --stripe: #1e2125; }
}
body { margin: 0 auto; padding: 1rem; max-width: 76rem; color: var(--ink); background: var(--paper);
  font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: break-word; }
h1 { line-height: 1.2; } h2 { margin-top: 2.5rem; } p, figcaption { max-width: 60rem; }
figcaption, .note { color: var(--soft); font-size: .875rem; }
img, svg { max-width: 100%; height: auto; } svg { width: 100%; color: var(--ink); }
figure { margin: 0; }
.grid { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fit, minmax(min(100%, 30rem), 1fr)); }
.grid.pictures { grid-template-columns: repeat(auto-fit, minmax(min(100%, 16rem), 1fr)); }
.pictures img { width: 100%; image-rendering: pixelated; }
.wide { overflow-x: auto; border: 1px solid var(--line); border-radius: .25rem; margin: .5rem 0; }
.strip { display: flex; gap: .75rem; padding: .5rem; }
.strip figure { flex: 0 0 11rem; }
.strip img { width: 11rem; max-width: none; image-rendering: pixelated; display: block; }
.strip img + img { margin-top: .25rem; }
table { border-collapse: collapse; font-size: .875rem; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .75rem; text-align: right; white-space: nowrap; }
th { border-bottom: 1px solid var(--line); } tr { background: var(--paper); }
tbody tr:nth-child(even) { background: var(--stripe); }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: inherit; }
@media (max-width: 40rem) {
  th:first-child, td:first-child { white-space: normal; min-width: 7rem; }
}
details { margin: .75rem 0; } summary { cursor: pointer; font-weight: 600; }
code { overflow-wrap: anywhere; }
)";

[[nodiscard]] std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
    return result;
}

[[nodiscard]] std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw std::runtime_error("cannot read '" + path.string() + "'");
    return {std::istreambuf_iterator<char>(file), {}};
}

[[nodiscard]] std::string base64(const std::string& bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned word = 0;
        const std::size_t count = (std::min)(std::size_t(3), bytes.size() - i);
        for (std::size_t j = 0; j < 3; ++j)
            word = word << 8 | (j < count ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            result += j <= count ? digits[word >> (18 - 6 * j) & 63u] : '=';
    }
    return result;
}

[[nodiscard]] std::string image(const std::filesystem::path& png, const std::string& alt) {
    return std::string("<img alt=\"") + escaped(alt) + "\" src=\"data:image/png;base64," + base64(bytes_of(png)) +
           "\">\n";
}

/// The file's <svg> element, its ids made its own, as several share the page.
[[nodiscard]] std::string inline_svg(const Plot& plot, std::size_t number) {
    std::string svg = bytes_of(plot.svg);
    const std::size_t begin = svg.find("<svg");
    if (begin == std::string::npos)
        throw std::runtime_error("'" + plot.svg.string() + "' is no SVG");
    svg.erase(0, begin);
    for (const char* name : {"xmlns=\"", "xmlns:xlink=\""}) // which a page does without
        if (const std::size_t at = svg.find(name); at != std::string::npos)
            svg.erase(at, svg.find('"', at + std::string(name).size()) + 1 - at);
    const std::string prefix = std::string("p") + std::to_string(number) + "-";
    for (const char* reference : {"id='", "id=\"", "href='#", "href=\"#", "url(#"}) {
        const std::string mark = reference;
        for (std::size_t at = svg.find(mark); at != std::string::npos; at = svg.find(mark, at + mark.size()))
            svg.insert(at + mark.size(), prefix);
    }
    return "<figure>\n" + svg + "<figcaption>" + escaped(plot.title) + "</figcaption>\n</figure>\n";
}

[[nodiscard]] std::string html_table(const Table& table) {
    std::string html = std::string("<h3>") + escaped(table.title) + "</h3>\n<p class=\"note\">" +
                       escaped(table.caption) + ".</p>\n<div class=\"wide\"><table>\n<thead><tr>";
    for (const std::string& cell : table.header)
        html += "<th>" + escaped(cell) + "</th>";
    html += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        html += "<tr>";
        for (const std::string& cell : row)
            html += "<td>" + escaped(cell) + "</td>";
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

[[nodiscard]] std::string html_strip(const Strip& strip) {
    std::string html =
        std::string("<h3>") + escaped(strip.title) + "</h3>\n<div class=\"wide\"><div class=\"strip\">\n";
    for (const Exhibit& exhibit : strip.exhibits) {
        html += std::string("<figure>") + image(exhibit.picture, exhibit.title);
        if (!exhibit.difference.empty())
            html += image(exhibit.difference, "difference of " + exhibit.title);
        html += "<figcaption>" + escaped(exhibit.title) + "<br>" + escaped(exhibit.note) + "</figcaption></figure>\n";
    }
    return html + "</div></div>\n";
}

[[nodiscard]] std::string plots_of_kind(const Exhibition& exhibition, const std::string& kind) {
    std::string html = "<div class=\"grid\">\n";
    for (std::size_t i = 0; i < exhibition.plots.size(); ++i)
        if (exhibition.plots[i].svg.filename().string().starts_with(kind))
            html += inline_svg(exhibition.plots[i], i);
    return html + "</div>\n";
}

[[nodiscard]] std::string processor() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            return line.substr(line.find(':') + 2);
    return "a processor that the system does not name";
}

[[nodiscard]] std::string compiler() {
#if defined(__clang__)
    return std::string("clang ") + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__);
#elif defined(__GNUC__)
    return std::string("g++ ") + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__);
#else
    return "another compiler";
#endif
}

[[nodiscard]] std::string introduction(const CompareOptions& options, const Bench& bench, double seconds) {
    const std::string truth = bench.is_exact() ? "the exact irradiance"
                                               : "the reference " + options.reference->filename().string() +
                                                     ", whose own noise is " + text("%.4f", bench.reference_noise()) +
                                                     " of its mean; rel is corrected for it";
    return "<p>Every method gets the same photons and the same eye path vertices, and at each number of photons the "
           "bandwidth that is best for it, found by a sweep. Errors are against " +
           escaped(truth) +
           ": rel is rms(E − E<sub>ref</sub>)/mean(E<sub>ref</sub>); "
           "RMSE and SSIM are of the pictures exposed to half "
           "grey and clipped. Times are of the whole way from the lamp to the picture, the map of eye path vertices or "
           "of "
           "photons included; methods that need no differentials trace without them.</p>\n<p class=\"note\">" +
           text("%zu × %zu pixels, %u eye path%s per pixel, seed %llu, %u threads of ", options.width, options.height,
                options.samples, options.samples == 1 ? "" : "s", static_cast<unsigned long long>(options.seed),
                bench.threads().threads()) +
           escaped(processor()) + ", " + compiler() + text("; %.0f seconds for everything. Made with <code>", seconds) +
           escaped(options.command) + "</code></p>\n";
}

/// Reference, splatting of either order and the first rival, whole.
[[nodiscard]] std::string whole_pictures(const Exhibition& exhibition, const std::vector<Trial>& trials,
                                         std::uint64_t target) {
    std::string html = std::string("<div class=\"grid pictures\">\n<figure>") +
                       image(exhibition.pictures / "reference.png", "reference") +
                       "<figcaption>reference</figcaption></figure>\n";
    for (const char* id : {"splat-auto", "splat", "nearest"})
        for (const Trial& trial : trials)
            if (trial.method->id == id && trial.wanted == target && trial.sequence == trials.front().sequence) {
                const std::string title = trial.method->title + ", " + grouped(target) + " " + name_of(trial.sequence) +
                                          " photons, SSIM " + figure(trial.by(Measure::ssim).errors.ssim);
                html += std::string("<figure>") +
                        image(picture_path(exhibition.pictures, trial, Measure::ssim), title) + "<figcaption>" +
                        escaped(title) + "</figcaption></figure>\n";
            }
    return html + "</div>\n";
}

[[nodiscard]] std::string method_list(const CompareOptions& options) {
    std::string html = "<h2>Methods</h2>\n<ul>\n";
    for (const std::string& id : options.methods) {
        const Method& method = *find_method(id);
        html += "<li><code>" + method.id + "</code>: " + escaped(method.title) + " [" + escaped(method.source) + "], " +
                method.symbol + ": " + escaped(method.bandwidth) + "</li>\n";
    }
    return html + "</ul>\n";
}

} // namespace

std::string html_page(const CompareOptions& options, const Bench& bench, const std::vector<Trial>& trials,
                      const Exhibition& exhibition) {
    std::string html = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>nephroid: " +
                       options.scene + "</title>\n<style>" + style +
                       "</style>\n</head>\n<body>\n<h1>Speed against error: " + options.scene + "</h1>\n" +
                       introduction(options, bench, exhibition.seconds) +
                       whole_pictures(exhibition, trials, target_photons(options));
    html += "<h2>Error against time</h2>\n";
    html += exhibition.plots.empty() ? "<p>The plots are left out: gnuplot was missing.</p>\n"
                                     : plots_of_kind(exhibition, "time-");
    const auto add = [&](const std::string& title, const std::vector<Table>& tables) {
        if (!tables.empty())
            html += "<h2>" + title + "</h2>\n";
        for (const Table& table : tables)
            html += html_table(table);
    };
    add("Equal error", equal_error_tables(options, trials));
    add("Equal time", equal_time_tables(options, trials));
    html += "<h2>Side by side</h2>\n<p class=\"note\">Below each picture where it is wrong, four times brighter: red "
            "where there is too much light, blue where too little.</p>\n";
    for (const Strip& strip : exhibition.strips)
        html += html_strip(strip);
    if (options.photons.size() > 1)
        html += std::string("<h2>Error against photons</h2>\n") + plots_of_kind(exhibition, "photons-") +
                html_table(slope_table(options, trials));
    html += std::string("<h2>Error against bandwidth</h2>\n") + plots_of_kind(exhibition, "bandwidth-");
    html += "<h2>All figures</h2>\n";
    for (const Measure measure : measures)
        html += "<details><summary>" + std::string("Best by ") + name_of(measure) + "</summary>\n" +
                html_table(best_table(trials, measure)) + "</details>\n";
    return html + method_list(options) + "</body>\n</html>\n";
}

} // namespace nephroid::examples
