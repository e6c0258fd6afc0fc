// SPDX-License-Identifier: MIT
/// @file  Pictures for looking at: the best of each method, crops of them, and where they are wrong.
#pragma once

#include "common/image/image.hpp"
#include "common/study/page.hpp"
#include "common/study/trial.hpp"

namespace nephroid::examples::study::compare {

/// A square of a film, in pixels from its lower left corner.
struct Crop {
    std::size_t x, y, side;
};

/// Where a picture, exposed, has the most contrast.
/// @param side  in pixels, at most the picture's own
[[nodiscard]] Crop busiest_crop(const Bench& bench, std::size_t side);

[[nodiscard]] Samples cropped(const Bench& bench, const std::vector<float>& irradiance, const Crop& crop);

/// The difference of the exposed pictures, four times brighter: red where there is too much light, blue where too
/// little.
[[nodiscard]] Samples difference(const Bench& bench, const std::vector<float>& irradiance, const Crop& crop);

/// Writes the best pictures of a trial by RMSE and by SSIM, METHOD-SEQUENCE-PHOTONS-MEASURE.png.
void write_pictures(const std::filesystem::path& folder, const Bench& bench, const Trial& trial);

/// The name of such a file.
[[nodiscard]] std::filesystem::path picture_path(const std::filesystem::path& folder, const Trial& trial,
                                                 Measure measure);

/// Writes crops of all methods side by side, the reference first, for every sequence, by RMSE and by SSIM: of the
/// trials at the target count, which must still have their pictures. And each strip as one picture: the reference and
/// the methods, below them their differences; strip-SEQUENCE-MEASURE.png.
[[nodiscard]] std::vector<Strip> write_strips(const std::filesystem::path& folder, const Options& options,
                                              const Bench& bench, const std::vector<Trial>& trials);

} // namespace nephroid::examples::study::compare
