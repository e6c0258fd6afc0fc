// SPDX-License-Identifier: MIT
/// @file  Parts of a picture by the way of their light: L lamp, S specular surface, D diffuse surface, E eye.
#pragma once

#include "common/command_line.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace nephroid::examples {

enum class Layer {
    all,
    caustics, ///< L S+ D E
    direct,   ///< L D E, and lamps that are seen
    indirect, ///< L (S* D)+ S* D E
};

[[nodiscard]] inline const Names<Layer>& layer_names() {
    static const Names<Layer> names = {
        {"all", Layer::all}, {"caustics", Layer::caustics}, {"direct", Layer::direct}, {"indirect", Layer::indirect}};
    return names;
}

/// Off diffuse surfaces before the one that is seen. Roulette ends nearly all paths long before, unless a closed room
/// absorbs nothing; its light is infinite.
inline constexpr unsigned all_bounces = 4096;

/// The number of bounces that --bounces asks for: "3" or "all". Throws UsageError.
[[nodiscard]] inline unsigned bounces_in(const std::string& text) {
    const std::uint64_t most = all_bounces;
    return static_cast<unsigned>(text == "all" ? most : (std::min)(whole_number("--bounces", text, 0), most));
}

} // namespace nephroid::examples
