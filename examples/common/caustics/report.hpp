// SPDX-License-Identifier: MIT
/// @file  What `caustics` says at the end: the table on the terminal, and the same as JSON.
#pragma once

#include "common/caustics/options.hpp"
#include "common/errors.hpp"

#include "nephroid/transport/account.hpp"

#include <iosfwd>
#include <vector>

namespace nephroid::examples {

/// Seconds of wall clock, pass by pass; `other` is what happens between them.
struct Timings {
    double eye_paths = 0, map = 0, pilot = 0, trace = 0, fit = 0, splat = 0, direct = 0, total = 0;
    [[nodiscard]] double other() const { return total - eye_paths - map - pilot - trace - fit - splat - direct; }
};

struct Report {
    Statistics statistics;
    Timings seconds;
    std::size_t eye_vertices = 0;
    unsigned threads = 1;
    std::optional<double> smoothing; ///< s of all photons; nothing: chosen for each
    std::optional<Errors> errors;    ///< where the truth is known
    std::vector<std::string> notes;  ///< on what is shown otherwise than the scene says
    bool interrupted = false;        ///< the picture has the photons that there were when the user wanted no more

    /// Keeps a note, and prints it at once: what follows may fail.
    void note(const std::string& text);
};

void print_table(std::ostream& out, const Options& options, const Report& report);

/// @return  the report as a JSON object
[[nodiscard]] std::string json_text(const Options& options, const Report& report);

} // namespace nephroid::examples
