// SPDX-License-Identifier: MIT
#include "common/relaxation/pictures.hpp"

#include "common/image/file.hpp"
#include "common/text.hpp"

#include <cstdlib>

namespace nephroid::examples::relaxation {

namespace {

/// Runs gnuplot on a script, in the folder that it writes to. False where there is none or it fails.
[[nodiscard]] bool plot(const std::filesystem::path& folder, const std::string& script) {
    std::string quoted = "'";
    for (const char c : folder.string())
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    quoted += "'";
#if defined(_WIN32)
    return false;
#else
    const std::string command = "cd " + quoted + " && gnuplot " + script + " >/dev/null 2>&1";
    return std::system(command.c_str()) == 0;
#endif
}

/// Frequency over the principal one, power, anisotropy in dB; before, then after.
void write_spectrum(const std::filesystem::path& folder, const BlueNoise& before, const BlueNoise& after) {
    std::string data = "# frequency/principal power anisotropy_dB, before and, below, after\n";
    for (const BlueNoise* noise : {&before, &after}) {
        for (const Annulus& annulus : noise->annuli)
            if (annulus.frequency >= BlueNoise::least_frequency())
                data += text("%g %g %g\n", annulus.frequency / noise->principal, annulus.power,
                             decibels(annulus.anisotropy));
        data += "\n\n";
    }
    write_file(folder / "spectrum.dat", data);
    write_file(folder / "spectrum.gp", R"(set terminal svg size 760,760 font 'sans-serif,14' background '#ffffff'
set output 'spectrum.svg'
set multiplot layout 2,1
set xrange [0:2]
set key top right
set grid
set xlabel 'frequency / principal frequency'
set ylabel 'power (white noise: 1)'
set yrange [0:*]
plot 'spectrum.dat' index 0 using 1:2 with lines lc '#999999' title 'before', \
     'spectrum.dat' index 1 using 1:2 with lines lc '#1f5faa' lw 2 title 'after'
set ylabel 'anisotropy / dB'
set yrange [-20:5]
plot -10 with lines lc '#cc3333' title 'white noise', \
     'spectrum.dat' index 0 using 1:3 with lines lc '#999999' title 'before', \
     'spectrum.dat' index 1 using 1:3 with lines lc '#1f5faa' lw 2 title 'after'
)");
}

/// An index of the data file for each look and edge: offset and irradiance, inwards.
void write_edges(const std::filesystem::path& folder, const Subject& subject, const Study& study) {
    std::string data = "# offset irradiance\n",
                script = R"(set terminal svg size 760,520 font 'sans-serif,14' background '#ffffff'
set grid
set key bottom right
set xlabel 'distance from the edge, inwards'
set ylabel 'irradiance'
)";
    int index = 0;
    for (std::size_t edge = 0; edge < subject.edges.size(); ++edge) {
        script += "set output 'edge-" + subject.edges[edge].name + ".svg'\nplot ";
        for (const auto& [name, map, width] :
             {std::tuple("before", &study.before, 1), std::tuple("after", &study.after, 2)})
            for (const Look& look : map->looks) {
                const EdgeProfile& profile = look.profiles[edge];
                for (std::size_t i = 0; i < profile.irradiance.size(); ++i)
                    data += text("%g %g\n", profile.offset(i), profile.irradiance[i]);
                data += "\n\n";
                script += text("'edges.dat' index %d with lines lw %d title '%s, k = %zu', ", index++, width, name,
                               look.neighbours);
            }
        script += text("(x < 0 ? %g : %g) with lines lc '#000000' dt 2 title 'exact'\n", subject.edges[edge].outside,
                       subject.edges[edge].inside);
    }
    write_file(folder / "edges.dat", data);
    write_file(folder / "edges.gp", script);
}

} // namespace

std::vector<std::string> write_plots(const std::filesystem::path& folder, const Subject& subject, const Study& study) {
    std::vector<std::string> scripts;
    if (study.before.blue_noise && study.after.blue_noise) {
        write_spectrum(folder, *study.before.blue_noise, *study.after.blue_noise);
        scripts.push_back("spectrum.gp");
    }
    if (!subject.edges.empty()) {
        write_edges(folder, subject, study);
        scripts.push_back("edges.gp");
    }
    std::vector<std::string> notes;
    for (const std::string& script : scripts)
        if (!plot(folder, script))
            notes.push_back("gnuplot did not run, so " + (folder / script).string() + " is not plotted");
    return notes;
}

} // namespace nephroid::examples::relaxation
