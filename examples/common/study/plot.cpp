// SPDX-License-Identifier: MIT
#include "common/study/plot.hpp"

#include "common/image/file.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace nephroid::examples::study {

namespace {

constexpr std::array colours = {"#e03c31", "#b01060", "#e56aa0", "#f08c2e", "#a08a20", "#2f7fd6", "#23a6b8",
                                "#7a62d8", "#35a050", "#c850a8", "#8a8f99", "#a9744f", "#5f8f2a"};

/// A string in gnuplot's single quotes.
[[nodiscard]] std::string gnuplot_string(const std::string& text) {
    std::string result = "'";
    for (const char c : text)
        result += c == '\'' ? std::string("''") : std::string(1, c);
    return result + "'";
}

/// The least and the most of the numbers in one column of the data.
struct Extent {
    double least = std::numeric_limits<double>::infinity(), most = 0;
};
[[nodiscard]] Extent extent_of(const std::vector<Curve>& curves, std::size_t column) {
    Extent extent;
    for (const Curve& curve : curves) {
        std::istringstream rows(curve.data);
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

/// A logarithmic axis as long as its data, where gnuplot's would go on to whole decades.
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

[[nodiscard]] std::string axes_script(const Drawing& drawing, const std::vector<Curve>& curves) {
    const Axes& axes = drawing.axes;
    std::string script = "reset\nset terminal svg size 480,460 dynamic noenhanced font 'sans-serif,13'\n"
                         "set encoding utf8\nset output " +
                         gnuplot_string(drawing.name + ".svg") +
                         "\nset grid lc rgb '#808080' lw 0.3\nset border lw 0.7\n"
                         "set key outside bottom center horizontal maxcols 2 samplen 1.5 font ',11'\nset rmargin 4\n"
                         "set xlabel " +
                         gnuplot_string(axes.x) + " offset 0,0.8\nset ylabel " + gnuplot_string(axes.y) + "\n";
    if (axes.are_logarithmic)
        script += "set logscale xy\n" + fitted_axis('x', extent_of(curves, 0)) + fitted_axis('y', extent_of(curves, 1));
    return script + axes.more;
}

/// @return  nothing if there is nothing to be seen
[[nodiscard]] std::string script_of(const Drawing& drawing) {
    std::vector<Curve> curves = drawing.curves;
    std::erase_if(curves, [](const Curve& curve) { return curve.data.empty(); });
    if (curves.empty())
        return "";
    std::string script = axes_script(drawing, curves), plot;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const std::string block = "$d" + std::to_string(i);
        script += block + " << END\n" + curves[i].data + "END\n";
        plot += (i == 0 ? "" : ", \\\n  ") + block + " using " + drawing.axes.columns + " with " + curves[i].look +
                " title " + gnuplot_string(curves[i].title);
    }
    for (const std::string& formula : drawing.axes.formulas)
        plot += ", \\\n  " + formula;
    return script + "plot " + plot + "\nunset output\n\n";
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

[[nodiscard]] std::string row_of(std::initializer_list<double> values, double least) {
    std::string line;
    for (const double value : values) {
        if (!(value > least) || !std::isfinite(value))
            return "";
        line += text("%.9g ", value);
    }
    return line + "\n";
}

} // namespace

std::string data_row(std::initializer_list<double> values) {
    return row_of(values, -std::numeric_limits<double>::infinity());
}

std::string positive_row(std::initializer_list<double> values) { return row_of(values, 0); }

std::string curve_colour(std::size_t number) { return std::string("'") + colours[number % colours.size()] + "'"; }

bool has_gnuplot() {
#if defined(_WIN32)
    return std::system("gnuplot --version >NUL 2>&1") == 0;
#else
    return std::system("gnuplot --version >/dev/null 2>&1") == 0;
#endif
}

std::vector<Plot> draw(const std::filesystem::path& folder, const std::vector<Drawing>& drawings) {
    std::vector<Plot> plots;
    std::string script = "# Drawn by: gnuplot plots.gp\n";
    for (const Drawing& drawing : drawings)
        if (const std::string own = script_of(drawing); !own.empty()) {
            script += own;
            plots.push_back({drawing.title, folder / (drawing.name + ".svg")});
        }
    if (plots.empty() || !has_gnuplot())
        return {};
    std::filesystem::create_directories(folder);
    write_file(folder / "plots.gp", script);
    const std::string command =
        std::string("cd -- ") + shell_quoted(folder.string()) + " && gnuplot plots.gp 2>gnuplot.log";
    if (std::system(command.c_str()) != 0)
        throw std::runtime_error("gnuplot failed; it says why in '" + (folder / "gnuplot.log").string() + "'");
    for (const Plot& plot : plots)
        let_page_choose_ink(plot.svg);
    return plots;
}

} // namespace nephroid::examples::study
