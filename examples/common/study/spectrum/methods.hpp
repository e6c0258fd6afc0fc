// SPDX-License-Identifier: MIT
/// @file  The ways to colour a caustic that `study spectrum` compares, and the truth.
#pragma once

#include "common/study/spectrum/water.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples::study::spectrum {

struct Subject {
    std::vector<Pixel> pixels;
    EyePathMap<V> map;

    explicit Subject(std::size_t size) : pixels(pixels_of(size)), map(pixels, &Pixel::position, &Pixel::normal) {}
};

/// A way to make the picture from so many walks.
struct Method {
    std::string name;
    bool chooses = false; ///< its own smoothing
    /// @param smoothing  nothing: chosen for each photon
    Picture (*picture)(const Subject&, std::uint64_t walks, std::optional<double> smoothing, ThreadExecutor&);
};

[[nodiscard]] const std::vector<Method>& methods();

/// From light sheets, at three wavelengths in each band.
[[nodiscard]] Picture truth(const Subject& subject, ThreadExecutor& executor);

/// rms(picture − truth) over the mean of the truth, over all pixels and bands; or over the means of three groups of
/// bands.
[[nodiscard]] double error_in_bands(const Picture& picture, const Picture& truth);
[[nodiscard]] double error_in_three_colours(const Picture& picture, const Picture& truth);

} // namespace nephroid::examples::study::spectrum
