// SPDX-License-Identifier: MIT
/// @file  The built-in cases of `caustics`: their picture is the irradiance on the floor, compared with the exact one.
#pragma once

#include "common/builtin_film.hpp"
#include "common/caustics/report.hpp"
#include "common/image/image.hpp"

namespace nephroid::examples {

/// A picture and what is known about it.
struct Rendering {
    Samples picture;
    double exposure; ///< that shows the picture well as a .png
    Report report;
};

/// Renders a built-in case, without direct light.
/// Throws UsageError for options that the case does not have.
[[nodiscard]] Rendering render_builtin(const Options& options);

} // namespace nephroid::examples
