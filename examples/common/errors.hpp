// SPDX-License-Identifier: MIT
/// @file  Errors of a picture of irradiance, by the measures of the papers and of nephroid's tables.
#pragma once

#include "common/image/image.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace nephroid::examples {

/// Errors against a reference picture.
struct Errors {
    double relative = 0; ///< rms(E - E_ref) / mean(E_ref)
    double rmse = 0;     ///< of the exposed and clipped pictures
    double ssim = 0;     ///< of the same; NaN for pictures smaller than its window
    double energy = 0;   ///< sum(E) / sum(E_ref) - 1
};

/// @param irradiance  width * height pixels, row 0 at the bottom
/// @param reference   as many
/// @return  nothing if the reference is black
[[nodiscard]] std::optional<Errors> errors_against(const std::vector<double>& reference,
                                                   const std::vector<float>& irradiance, std::size_t width,
                                                   std::size_t height);

/// The same for images; of colours, the mean of the channels is compared.
///
/// Throws std::runtime_error that says which sizes do not match, or that a sample is not finite.
[[nodiscard]] std::optional<Errors> errors_against(const Samples& reference, const Samples& picture);

} // namespace nephroid::examples
