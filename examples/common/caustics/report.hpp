// SPDX-License-Identifier: MIT
/// @file  The report of `caustics`: a table on the terminal, and the same as JSON.
#pragma once

#include "common/caustics/options.hpp"
#include "common/caustics/passes.hpp"
#include "common/errors.hpp"

#include "nephroid/bounce/splat_global.hpp"
#include "nephroid/sheet/sheet_account.hpp"
#include "nephroid/transport/account.hpp"

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples {

/// Seconds of wall clock for each pass; `other` is the time between passes.
struct Timings {
    double eye_paths = 0, map = 0, pilot = 0, trace = 0, fit = 0, splat = 0, direct = 0, indirect = 0, total = 0;
    [[nodiscard]] double other() const {
        return total - eye_paths - map - pilot - trace - fit - splat - direct - indirect;
    }
};

/// Caustics that were drawn as light sheets.
struct SheetReport {
    SheetAccount account;  ///< of all passes
    double unresolved = 0; ///< SheetStatistics::unresolved, of all passes
    Statistics splats;     ///< of light on no sheet, which was traced again
};

struct Report {
    Statistics statistics;             ///< of caustics
    std::optional<SheetReport> sheets; ///< if they were drawn so
    bool has_caustics = true;          ///< otherwise there was no pass for them: not asked for, or nothing is specular
    std::optional<GlobalSplats> indirect; ///< of all passes; the radius is that of the last
    PassReport caustic_passes, indirect_passes;
    unsigned bounces = 0; ///< off diffuse surfaces before the one that is seen, at most
    Timings seconds;
    std::size_t eye_vertices = 0;
    unsigned threads = 1;
    std::optional<double> smoothing; ///< s of all photons; nothing: chosen for each
    std::optional<Errors> errors;    ///< if the exact picture is known
    std::vector<std::string> notes;  ///< about things that are shown differently from the scene's description
    bool interrupted = false;        ///< the picture has only the photons before the user's interrupt

    /// Photons that lamps emitted, for all layers.
    [[nodiscard]] std::uint64_t photons_emitted() const {
        return statistics.emitted.photons + (indirect ? indirect->statistics.emitted.photons : 0);
    }
    /// Keeps a note, and prints it at once, because the program may fail later.
    void note(const std::string& text);
};

void print_table(std::ostream& out, const Options& options, const Report& report);

/// @return  the report as a JSON object
[[nodiscard]] std::string json_text(const Options& options, const Report& report);

} // namespace nephroid::examples
