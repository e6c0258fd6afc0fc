// SPDX-License-Identifier: MIT
/// @file  Plots by gnuplot.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace nephroid::examples::study {

/// One line of a plot.
struct Curve {
    std::string title;
    std::string data; ///< rows of numbers
    std::string look; ///< gnuplot's words for it: "lines lc rgb '#2f7fd6' lw 2"
};

struct Axes {
    std::string x, y;                       ///< what they are labelled with
    bool are_logarithmic = false;           ///< as long as their data, with a tic at 1, 2 and 5 where they are short
    std::string columns = "1:2";            ///< of the data, as "using" wants them
    std::string more = "";                  ///< further commands
    std::vector<std::string> formulas = {}; ///< curves that are functions of x, as gnuplot writes them
};

/// A plot to be drawn.
struct Drawing {
    std::string name;  ///< of the file, without ".svg"
    std::string title; ///< for people
    Axes axes;
    std::vector<Curve> curves; ///< those without data are left out; without any, the plot is
};

/// A plot that has been drawn.
struct Plot {
    std::string title;
    std::filesystem::path svg;
};

/// A row of data; empty if one of the values is not finite.
[[nodiscard]] std::string data_row(std::initializer_list<double> values);
/// The same for logarithmic axes: empty as well if a value is not positive.
[[nodiscard]] std::string positive_row(std::initializer_list<double> values);

/// A colour of middle lightness, to be seen on white and on black, as gnuplot's "rgb" wants it.
[[nodiscard]] std::string curve_colour(std::size_t number);

/// Whether there is a gnuplot to call.
[[nodiscard]] bool has_gnuplot();

/// Writes `folder`/plots.gp with all data in it, and lets gnuplot draw the .svg files beside it. The ink is
/// `currentColor`, so that a page chooses it. Nothing is drawn where there is no gnuplot.
/// Throws std::runtime_error if gnuplot fails.
[[nodiscard]] std::vector<Plot> draw(const std::filesystem::path& folder, const std::vector<Drawing>& drawings);

} // namespace nephroid::examples::study
