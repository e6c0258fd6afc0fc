// SPDX-License-Identifier: MIT
/// @file  The built-in cases of `caustics`: their picture is the irradiance on the floor, compared with the exact one.
#pragma once

#include "common/builtin_film.hpp"
#include "common/caustics/report.hpp"
#include "common/image/image.hpp"

namespace nephroid::examples {

/// A part of a picture's light.
struct RenderedLayer {
    std::string name;
    Samples picture;
    std::vector<float> variance; ///< of each pixel's mean over the channels; empty if there was a single pass
};

/// A picture and what is known about it.
struct Rendering {
    Samples picture;
    double exposure; ///< that shows the picture well as a .png
    Report report;
    std::vector<RenderedLayer> layers; ///< the picture is their sum, but for the films of single bands
};

/// Renders a built-in case, without direct light.
/// Throws UsageError for options that the case does not have.
[[nodiscard]] Rendering render_builtin(const Options& options);

} // namespace nephroid::examples
