// SPDX-License-Identifier: MIT
/// @file  Output files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace nephroid::examples {

/// Writes a file whole: to a temporary one beside it, which then takes its name. Whoever looks sees the old file or the
/// new one; when anything fails, a full disk included, the old one is untouched and the temporary one is removed.
///
/// @param path   of a file to create or replace; a symbolic link is followed. Its folder must exist
/// @param bytes  the whole content
/// Throws std::runtime_error, one line with the path and the reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Finds out before a long render that `write_file` could not write afterwards. Leaves no file behind and changes none.
///
/// Throws what `write_file` would. Passing is no promise: the disk can still fill up.
void require_writable(const std::filesystem::path& path);

} // namespace nephroid::examples
