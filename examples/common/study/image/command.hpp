// SPDX-License-Identifier: MIT
/// @file  `study image`: photons on a grid drawn onto a raster, beside the methods of the papers before: error on cases
///        that are known exactly, and flicker of water that moves.
#pragma once

#include "common/study/image/rivals.hpp"
#include "common/table.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nephroid::examples::study::image {

struct Options {
    std::vector<std::size_t> nodes; ///< of the grid, about
    std::size_t size = 512;         ///< pixels a side
    unsigned threads = 1;           ///< of the truth; pictures are drawn by one
};

struct FlickerOptions {
    std::size_t frames = 30, size = 256, nodes = 141, truth = 1024; ///< nodes, truth: a side
    double step = 0.03;                                             ///< of time from one frame to the next
    std::string strip;                                              ///< a .png of frames side by side; empty: none
};

/// The error of each method at its best s, on the focused wave and on the ring's inside.
[[nodiscard]] Table error_table(const Options& options);

/// The flicker of each method at the s that is best for what is seen.
[[nodiscard]] Table flicker_table(const FlickerOptions& options);

class Command {
public:
    explicit Command(CLI::App& app);
    Command(const Command&) = delete;
    Command& operator=(const Command&) = delete;

    /// Throws UsageError.
    void run() const;

private:
    std::string what_ = "errors", nodes_ = "19881", format_ = "text", strip_;
    std::size_t size_ = 0, frames_ = 30, truth_ = 1024;
    double step_ = 0.03;
};

} // namespace nephroid::examples::study::image
