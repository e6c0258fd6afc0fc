// SPDX-License-Identifier: MIT
/// @file  Finding a method's best bandwidth, for each measure of error, with few evaluations.
#pragma once

#include "common/errors.hpp"

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace nephroid::examples::study {

enum class Measure { relative, rmse, ssim };
inline constexpr std::array<Measure, 3> measures = {Measure::relative, Measure::rmse, Measure::ssim};

/// "rel", "RMSE" or "SSIM".
[[nodiscard]] const char* name_of(Measure measure);

/// As tables show it: for SSIM larger is better.
[[nodiscard]] double value_of(const Errors& errors, Measure measure);

/// What is to be small: rel, RMSE, 1 - SSIM. Infinite where the measure is not defined.
[[nodiscard]] double cost_of(const Errors& errors, Measure measure);

/// A geometric grid of bandwidths and the errors at some of its points.
class BandwidthSweep {
public:
    struct Grid {
        double expected;       ///< bandwidth at the grid's middle, > 0
        double least, most;    ///< beyond these nothing is tried; the nearest of them where `expected` is beyond
        double ratio;          ///< > 1, between neighbours
        bool is_whole = false; ///< round to whole numbers
    };
    /// The errors of a picture made with a bandwidth.
    using Evaluate = std::function<Errors(double bandwidth)>;

    BandwidthSweep(Grid grid, Evaluate evaluate);

    /// The bandwidth with the least cost: looks at four points about the expected one, and walks downhill from the best
    /// that is known in strides of four, two and one points of the grid; about nine evaluations. SSIM often has a
    /// second valley at wider kernels: hence the look. Of more valleys than it sees this gives the bottom of one.
    [[nodiscard]] double best(Measure measure);

    /// Evaluates every second point within so many points of the middle.
    void cover(int reach);

    /// All that has been evaluated, by bandwidth.
    [[nodiscard]] const std::map<double, Errors>& evaluated() const { return evaluated_; }

private:
    [[nodiscard]] bool is_on_grid(int point) const;
    [[nodiscard]] double bandwidth(int point) const;
    [[nodiscard]] double cost(int point, Measure measure);

    Grid grid_;
    Evaluate evaluate_;
    std::map<double, Errors> evaluated_;
    std::map<int, double> points_; ///< bandwidths of those that have been evaluated
};

} // namespace nephroid::examples::study
