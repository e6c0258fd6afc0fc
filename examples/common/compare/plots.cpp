// SPDX-License-Identifier: MIT
#include "common/compare/plots.hpp"

#include "common/compare/equal.hpp"
#include "common/image/file.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace nephroid::examples {

namespace {

/// Of middle lightness, to be seen on white and on black; by the method's place in `methods()`.
constexpr std::array colours = {"#e03c31", "#b01060", "#e56aa0", "#f08c2e", "#a08a20", "#2f7fd6",
                                "#23a6b8", "#7a62d8", "#35a050", "#c850a8", "#8a8f99", "#a9744f"};

[[nodiscard]] std::size_t place_of(const Method& method) { return std::size_t(&method - methods().data()); }

/// One method's line.
struct Line {
    const Method* method;
    std::string title;
    std::string data; ///< rows of numbers
};

struct Axes {
    std::string x, y;
    std::string more;    ///< gnuplot's commands
    std::string columns; ///< of the data, as "using" wants them
    std::string style;   ///< "linespoints", …
};

[[nodiscard]] std::string cost_name(Measure measure) {
    return measure == Measure::ssim ? "1 − SSIM" : measure == Measure::rmse ? "clipped RMSE" : "rel";
}

/// A string in gnuplot's single quotes.
[[nodiscard]] std::string gnuplot_string(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// The least and the most of the numbers in one column of the lines.
struct Extent {
    double least = std::numeric_limits<double>::infinity(), most = 0;
};
[[nodiscard]] Extent extent_of(const std::vector<Line>& lines, std::size_t column) {
    Extent extent;
    for (const Line& line : lines) {
        std::istringstream rows(line.data);
        for (std::string row; std::getline(rows, row);) {
            std::istringstream numbers(row);
            double number = 0;
            for (std::size_t i = 0; i <= column; ++i)
                numbers >> number;
            extent = {(std::min)(extent.least, number), (std::max)(extent.most, number)};
        }
    }
    return extent;
}

/// An axis as long as its data, where gnuplot's would go on to whole decades, with tics at 1, 2 and 5 if it is short.
[[nodiscard]] std::string fitted_axis(char axis, const Extent& extent) {
    const double low = extent.least / 1.2, high = extent.most * 1.2;
    const std::string name(1, axis);
    std::string commands = std::string("set ") + name + text("range [%.6g:%.6g]\nset ", low, high) + name + "tics ";
    if (high / low > 200)
        return commands + "autofreq\n";
    std::string tics;
    for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
        for (const double digit : {1, 2, 5})
            if (digit * decade >= low && digit * decade <= high)
                tics += text(tics.empty() ? "%.6g" : ",%.6g", digit * decade);
    return commands + "(" + tics + ")\n";
}

/// @return  nothing if there is nothing to be seen
[[nodiscard]] std::string script(const std::string& name, const Axes& axes, std::vector<Line> lines) {
    std::erase_if(lines, [](const Line& line) { return line.data.empty(); });
    if (lines.empty())
        return "";
    std::string text = "reset\nset terminal svg size 480,460 dynamic noenhanced font 'sans-serif,13'\n"
                       "set encoding utf8\nset output " +
                       gnuplot_string(name + ".svg") +
                       "\nset logscale xy\nset grid lc rgb '#808080' lw 0.3\nset border lw 0.7\n"
                       "set key outside bottom center horizontal maxcols 2 samplen 1.5 font ',11'\nset rmargin 4\n"
                       "set xlabel " +
                       gnuplot_string(axes.x) + " offset 0,0.8\nset ylabel " + gnuplot_string(axes.y) + "\n" +
                       fitted_axis('x', extent_of(lines, 0)) + fitted_axis('y', extent_of(lines, 1)) + axes.more;
    std::string plot = "plot ";
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::size_t place = place_of(*lines[i].method);
        const std::string block = "$d" + std::to_string(i);
        text += block + " << END\n" + lines[i].data + "END\n";
        plot += (i == 0 ? "" : ", \\\n  ") + block + " using " + axes.columns + " with " + axes.style + " lc rgb '" +
                colours[place % colours.size()] + "' lw " + (place == 0 ? "3" : "1.5") + " pt " +
                std::to_string(place == 0 ? 7 : 4 + place % 10) + " ps 0.7 title " + gnuplot_string(lines[i].title);
    }
    return text + plot + "\nunset output\n\n";
}

/// A row of numbers; nothing for what a logarithmic axis cannot show.
[[nodiscard]] std::string row(std::initializer_list<double> values) {
    std::string line;
    for (const double value : values) {
        if (!(value > 0) || !std::isfinite(value))
            return "";
        line += text("%.9g ", value);
    }
    return line + "\n";
}

[[nodiscard]] std::string time_plot(const std::string& name, const CompareOptions& options,
                                    const std::vector<Trial>& trials, SequenceKind sequence, Measure measure) {
    std::vector<Line> lines;
    for (const std::string& id : options.methods) {
        Line line{find_method(id), id, ""};
        for (const Trial* trial : trials_of(trials, id, sequence)) {
            const Timing& timing = trial->by(measure).timing;
            line.data += row({timing.seconds.total(), trial->cost(measure), timing.least, timing.most});
        }
        lines.push_back(std::move(line));
    }
    return script(name, {"seconds (bars: fastest and slowest run)", cost_name(measure), "", "1:2:3:4", "xerrorlines"},
                  lines);
}

[[nodiscard]] std::string photon_plot(const std::string& name, const CompareOptions& options,
                                      const std::vector<Trial>& trials, SequenceKind sequence, Measure measure) {
    std::vector<Line> lines;
    for (const std::string& id : options.methods) {
        const auto own = trials_of(trials, id, sequence);
        const auto slope = slope_of(own, measure);
        Line line{find_method(id), id + (slope ? text(" (%.2f)", *slope) : ""), ""};
        for (const Trial* trial : own)
            line.data += row({double(trial->wanted), trial->cost(measure)});
        lines.push_back(std::move(line));
    }
    return script(
        name,
        {"caustic photons (slope in brackets)", cost_name(measure), "set format x '%.0s%c'\n", "1:2", "linespoints"},
        lines);
}

[[nodiscard]] std::string bandwidth_plot(const std::string& name, const CompareOptions& options,
                                         const std::vector<Trial>& trials, SequenceKind sequence, Measure measure) {
    std::vector<Line> lines;
    for (const std::string& id : options.methods) {
        const Method& method = *find_method(id);
        const Trial& trial = *trials_of(trials, id, sequence).front();
        const Best& best = trial.by(Measure::relative);
        Line line{&method,
                  id + (method.symbol.empty() ? std::string()
                                              : std::string(", ") + bandwidth_text(*best.method, best.bandwidth)),
                  ""};
        for (const auto& [bandwidth, errors] : std::ranges::find(trial.sweeps, best.method, &Sweep::method)->errors)
            line.data += row({bandwidth / best.bandwidth, cost_of(errors, measure)});
        lines.push_back(std::move(line));
    }
    return script(
        name, {"bandwidth over the one with the least rel (named below)", cost_name(measure), "", "1:2", "linespoints"},
        lines);
}

[[nodiscard]] std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
    return text;
}

/// gnuplot writes its default ink as black.
void let_page_choose_ink(const std::filesystem::path& svg) {
    std::ifstream file(svg, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(file)), {});
    file.close();
    for (const char* quote : {"'", "\""})
        for (const char* ink : {"stroke=", "fill=", "color="})
            text = replaced(std::move(text), ink + std::string(quote) + "black" + quote,
                            ink + std::string(quote) + "currentColor" + quote);
    write_file(svg, text);
}

/// For a POSIX shell.
[[nodiscard]] std::string shell_quoted(const std::string& text) {
    return std::string("'") + replaced(text, "'", "'\\''") + "'";
}

} // namespace

bool has_gnuplot() {
#if defined(_WIN32)
    return std::system("gnuplot --version >NUL 2>&1") == 0;
#else
    return std::system("gnuplot --version >/dev/null 2>&1") == 0;
#endif
}

std::vector<Plot> draw_plots(const std::filesystem::path& folder, const CompareOptions& options,
                             const std::vector<Trial>& trials) {
    std::filesystem::create_directories(folder);
    std::vector<Plot> plots;
    std::string text = "# Drawn by: gnuplot plots.gp\n";
    using Draw =
        std::string (*)(const std::string&, const CompareOptions&, const std::vector<Trial>&, SequenceKind, Measure);
    const auto add = [&](const std::string& kind, const std::string& title, Draw draw) {
        for (const Measure measure : measures)
            for (const SequenceKind sequence : options.sequences) {
                const std::string name = kind + "-" + name_of(measure) + "-" + name_of(sequence);
                const std::string script = draw(name, options, trials, sequence, measure);
                if (script.empty())
                    continue;
                text += script;
                plots.push_back({cost_name(measure) + " against " + title + ", " + name_of(sequence) + " photons",
                                 folder / (name + ".svg")});
            }
    };
    add("time", "time", time_plot);
    if (options.photons.size() > 1)
        add("photons", "the number of photons", photon_plot);
    add("bandwidth", "bandwidth, " + grouped(options.photons.front()), bandwidth_plot);
    write_file(folder / "plots.gp", text);

    const std::string command =
        std::string("cd -- ") + shell_quoted(folder.string()) + " && gnuplot plots.gp 2>gnuplot.log";
    if (std::system(command.c_str()) != 0)
        throw std::runtime_error("gnuplot failed; it says why in '" + (folder / "gnuplot.log").string() + "'");
    for (const Plot& plot : plots)
        let_page_choose_ink(plot.svg);
    return plots;
}

} // namespace nephroid::examples
