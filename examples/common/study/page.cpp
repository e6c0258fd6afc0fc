// SPDX-License-Identifier: MIT
#include "common/study/page.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace nephroid::examples::study {

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
    return std::string("<img alt=\"") + escaped_for_html(alt) + "\" src=\"data:image/png;base64," +
           base64(bytes_of(png)) + "\">\n";
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
    return "<figure>\n" + svg + "<figcaption>" + escaped_for_html(plot.title) + "</figcaption>\n</figure>\n";
}

[[nodiscard]] std::string html_figure(const Exhibit& exhibit) {
    std::string html = std::string("<figure>") + image(exhibit.picture, exhibit.title);
    if (!exhibit.difference.empty())
        html += image(exhibit.difference, "difference of " + exhibit.title);
    return html + "<figcaption>" + escaped_for_html(exhibit.title) +
           (exhibit.note.empty() ? "" : "<br>" + escaped_for_html(exhibit.note)) + "</figcaption></figure>\n";
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

} // namespace

Page::Page(const std::string& title) : title_(escaped_for_html(title)) {}

void Page::heading(const std::string& text) { body_ += "<h2>" + escaped_for_html(text) + "</h2>\n"; }

void Page::paragraph(const std::string& html) { body_ += "<p>" + html + "</p>\n"; }

void Page::note(const std::string& html) { body_ += "<p class=\"note\">" + html + "</p>\n"; }

void Page::table(const Table& table) { body_ += html_of(table); }

void Page::folded_table(const std::string& summary, const Table& table) {
    body_ += "<details><summary>" + escaped_for_html(summary) + "</summary>\n" + html_of(table) + "</details>\n";
}

void Page::plots(const std::vector<Plot>& plots) {
    if (plots.empty()) {
        paragraph("The plots are left out: gnuplot was missing.");
        return;
    }
    body_ += "<div class=\"grid\">\n";
    for (const Plot& plot : plots)
        body_ += inline_svg(plot, plots_++);
    body_ += "</div>\n";
}

void Page::pictures(const std::vector<Exhibit>& exhibits) {
    body_ += "<div class=\"grid pictures\">\n";
    for (const Exhibit& exhibit : exhibits)
        body_ += html_figure(exhibit);
    body_ += "</div>\n";
}

void Page::strip(const Strip& strip) {
    body_ += std::string("<h3>") + escaped_for_html(strip.title) + "</h3>\n";
    body_ += "<div class=\"wide\"><div class=\"strip\">\n";
    for (const Exhibit& exhibit : strip.exhibits)
        body_ += html_figure(exhibit);
    body_ += "</div></div>\n";
}

std::string Page::html() const {
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>nephroid: " +
           title_ + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" + title_ + "</h1>\n" + body_ +
           "</body>\n</html>\n";
}

std::string machine() { return processor() + ", " + compiler(); }

} // namespace nephroid::examples::study
