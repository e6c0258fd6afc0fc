// SPDX-License-Identifier: MIT
/// @file  The command line options of the program `reference_path_tracer`.
#pragma once

#include "common/command_line.hpp"
#include "common/path_tracer/path_tracer.hpp"
#include "common/path_tracer/room_picture.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace nephroid::examples {

/// A caustic of a case, or a picture of a room.
struct TraceRequest {
    std::string scene;
    PictureSize size{};
    PathTraceOptions tracing;  ///< of a case
    RoomPictureOptions room{}; ///< of a room; without a scene for a case
    unsigned threads = 0;
    std::filesystem::path mean;
    std::optional<std::filesystem::path> standard_error;
};

/// The built-in cases whose light paths can hit.
[[nodiscard]] std::string traceable_names();

/// @return  nothing if the command line asked for help
/// Throws UsageError.
[[nodiscard]] std::optional<TraceRequest> read_trace_request(int argc, const char* const* argv);

} // namespace nephroid::examples
