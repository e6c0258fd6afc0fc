// SPDX-License-Identifier: MIT
#include "common/study/relax/pictures.hpp"

#include "common/text.hpp"

namespace nephroid::examples::study::relax {

namespace {

const std::string before_look = "lines lc rgb '#8a8f99'", after_look = "lines lc rgb '#2f7fd6' lw 2";

[[nodiscard]] Drawing power_plot(const BlueNoise& before, const BlueNoise& after) {
    Drawing drawing{"spectrum-power",
                    "power of the photons' spectrum",
                    {"frequency / principal frequency", "power (white noise: 1)"},
                    {}};
    drawing.axes.more = "set xrange [0:2]\nset yrange [0:*]\n";
    for (const auto& [title, noise, look] :
         {std::tuple("before", &before, before_look), std::tuple("after", &after, after_look)}) {
        Curve curve{title, "", look};
        for (const Annulus& annulus : noise->annuli)
            if (annulus.frequency >= BlueNoise::least_frequency())
                curve.data += data_row({annulus.frequency / noise->principal, annulus.power});
        drawing.curves.push_back(std::move(curve));
    }
    return drawing;
}

[[nodiscard]] Drawing anisotropy_plot(const BlueNoise& before, const BlueNoise& after) {
    Drawing drawing{"spectrum-anisotropy",
                    "anisotropy of the photons' spectrum",
                    {"frequency / principal frequency", "anisotropy / dB"},
                    {}};
    drawing.axes.more = "set xrange [0:2]\nset yrange [-20:5]\n";
    drawing.axes.formulas = {"-10 with lines lc rgb '#e03c31' title 'white noise'"};
    for (const auto& [title, noise, look] :
         {std::tuple("before", &before, before_look), std::tuple("after", &after, after_look)}) {
        Curve curve{title, "", look};
        for (const Annulus& annulus : noise->annuli)
            if (annulus.frequency >= BlueNoise::least_frequency())
                curve.data += data_row({annulus.frequency / noise->principal, decibels(annulus.anisotropy)});
        drawing.curves.push_back(std::move(curve));
    }
    return drawing;
}

/// Irradiance across the edge, inwards, as every look has it.
[[nodiscard]] Drawing edge_plot(const Subject& subject, const BeforeAndAfter& measured, std::size_t number) {
    const Edge& edge = subject.edges[number];
    Drawing drawing{
        "edge-" + edge.name, "the edge of the " + edge.name, {"distance from the edge, inwards", "irradiance"}, {}};
    drawing.axes.formulas = {
        text("(x < 0 ? %g : %g) with lines lc rgb '#808080' dt 2 title 'exact'", edge.outside, edge.inside)};
    std::size_t colour = 0;
    for (const auto& [name, map, width] :
         {std::tuple("before", &measured.before, 1), std::tuple("after", &measured.after, 2)})
        for (const Look& look : map->looks) {
            const EdgeProfile& profile = look.profiles[number];
            Curve curve{text("%s, k = %zu", name, look.neighbours), "",
                        "lines lc rgb " + curve_colour(colour++) + " lw " + std::to_string(width)};
            for (std::size_t i = 0; i < profile.irradiance.size(); ++i)
                curve.data += data_row({profile.offset(i), profile.irradiance[i]});
            drawing.curves.push_back(std::move(curve));
        }
    return drawing;
}

} // namespace

std::vector<Drawing> drawings(const Subject& subject, const BeforeAndAfter& measured) {
    std::vector<Drawing> all;
    if (measured.before.blue_noise && measured.after.blue_noise) {
        all.push_back(power_plot(*measured.before.blue_noise, *measured.after.blue_noise));
        all.push_back(anisotropy_plot(*measured.before.blue_noise, *measured.after.blue_noise));
    }
    for (std::size_t edge = 0; edge < subject.edges.size(); ++edge)
        all.push_back(edge_plot(subject, measured, edge));
    return all;
}

} // namespace nephroid::examples::study::relax
