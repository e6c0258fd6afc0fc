// SPDX-License-Identifier: MIT
/// @file  Writes output files atomically: they appear complete or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace nephroid::examples {

/// Writes a file atomically: a temporary file in the same folder is written and then renamed. Other programs see the
/// old file or the new one. If anything fails, such as on a full disk, the old file is unchanged and the temporary one
/// removed.
///
/// @param path   of a file to create or replace; a symbolic link is followed. Its folder must exist
/// @param bytes  the whole content
/// Throws std::runtime_error, one line with the path and the reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Checks before a long render whether `write_file` can write to a path. Leaves no file behind and changes none.
///
/// Throws what `write_file` would. Success is no guarantee, because the disk can fill up later.
void require_writable(const std::filesystem::path& path);

} // namespace nephroid::examples
