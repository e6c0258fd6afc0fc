// SPDX-License-Identifier: MIT
/// @file  Parts of a picture by the way of their light: L lamp, S specular surface, D diffuse surface, E eye.
#pragma once

namespace nephroid::examples {

enum class Layer {
    all,
    caustics, ///< L S+ D E
    direct,   ///< L D E, and lamps that are seen
    indirect, ///< L (S* D)+ S* D E
};

} // namespace nephroid::examples
