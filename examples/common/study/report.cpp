// SPDX-License-Identifier: MIT
#include "common/study/report.hpp"

#include "common/image/file.hpp"

#include <algorithm>
#include <iostream>

namespace nephroid::examples::study {

Report::Report(const Presentation& presentation, const std::string& title) : presentation_(presentation), page_(title) {
    std::filesystem::create_directories(presentation_.output);
    require_writable(path("report.html"));
}

std::filesystem::path Report::folder(const std::string& name) const {
    std::filesystem::create_directories(path(name));
    return path(name);
}

void Report::print(const Table& table, bool is_usual) const {
    const std::vector<std::string>& wanted = presentation_.tables;
    if (wanted.empty() ? is_usual : std::ranges::find(wanted, table.name) != wanted.end())
        examples::print(std::cout, table, presentation_.format);
}

void Report::show(const Table& table) {
    print(table);
    page_.table(table);
}

void Report::show(const std::vector<Table>& tables) {
    for (const Table& table : tables)
        show(table);
}

void Report::say(const std::string& line) const {
    (presentation_.format == TableFormat::text ? std::cout : std::cerr) << line << std::endl;
}

std::vector<Plot> Report::draw(const std::vector<Drawing>& drawings, const std::string& where) const {
    if (!has_gnuplot()) {
        say("note: the plots are left out, gnuplot is missing (Debian: gnuplot-nox)");
        return {};
    }
    return study::draw(path(where), drawings);
}

void Report::write(const std::string& name, const std::string& text) const { write_file(path(name), text); }

void Report::finish() {
    page_.note("Made by <code>" + escaped_for_html(presentation_.command) + "</code> on " +
               escaped_for_html(machine()) + ".");
    write_file(path("report.html"), page_.html());
    say("results, pictures and plots: " + presentation_.output.string() +
        ", all on one page: " + path("report.html").string());
}

} // namespace nephroid::examples::study
