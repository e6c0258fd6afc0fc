// SPDX-License-Identifier: MIT
/// @file  Checks a glTF's JSON before tinygltf parses it, for problems that tinygltf does not check.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace nephroid::examples::gltf {

struct JsonSurvey {
    bool has_animations = false;
    std::size_t buffers_without_uri = 0; ///< each takes a copy of the binary chunk
    std::size_t images = 0;
    std::vector<std::string> used_extensions, required_extensions;
};

/// Renames in place the sections that are not read (skins, animations, and the file's own "extras") by an underscore,
/// and "images" to "extras", so that tinygltf opens no image and keeps their descriptions.
///
/// Fails if the text is nested so deeply that tinygltf's recursion could exhaust the stack, if there are so many
/// materials that their memory is out of proportion, if a section's name is spelt with escapes, or if an image is not
/// an object. Broken JSON is left for the parser to complain of.
JsonSurvey prepare_json(std::span<char> text);

} // namespace nephroid::examples::gltf
