// SPDX-License-Identifier: MIT
/// @file  The films of the built-in cases: eye path vertices on the floor, and the exact picture.
#pragma once

#include "common/builtin_cases.hpp"

#include "nephroid/receiver/pixel_footprint.hpp"
#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/glm.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples {

/// "wave-focused, ring, …"
[[nodiscard]] std::string builtin_names();

[[nodiscard]] bool is_builtin(const std::string& name);

/// A film of a built-in case, and its resolution.
struct BuiltinFilm {
    std::string scene; ///< one of `builtin_case_names`
    FilmRectangle view;
    std::size_t width, height;   ///< pixels
    unsigned samples = 1;        ///< eye paths per pixel
    bool fresnel = false;        ///< reflection losses
    bool one_reflection = false; ///< of the ring

    [[nodiscard]] double pixel() const { return (view.x_max - view.x_min) / double(width); }
    [[nodiscard]] std::size_t pixels() const { return width * height; }
};

/// Throws UsageError, with the name of the option, for options that the case does not have.
void check(const BuiltinFilm& film);

/// The limits of walks in a built-in case: no roulette.
[[nodiscard]] WalkLimits walk_limits(const BuiltinFilm& film);

/// Where a film's eye path ends on the floor.
struct FloorVertex {
    glm::vec3 position;
    std::uint32_t pixel;
};

[[nodiscard]] inline glm::vec3 upwards(const FloorVertex&) { return {0, 0, 1}; }

/// The pixel footprint of each of the film's eye paths: its part of the pixel, along the floor's axes.
[[nodiscard]] PixelFootprint<glm::vec3> footprint_of(const BuiltinFilm& film);

/// The film's vertices, pixel by pixel.
/// @param ghosts  for a floor of period 1 along x and y: how far beyond the unit square the film is repeated, so that a
///                footprint over its border finds the vertices on the other side
[[nodiscard]] std::vector<FloorVertex> floor_vertices(const BuiltinFilm& film, std::optional<double> ghosts = {});

/// The distance beyond a periodic floor's border up to which ghosts are needed: the largest radius of a footprint with
/// this smoothing and number of emitted photons, plus two pixels.
[[nodiscard]] double ghost_margin(const BuiltinFilm& film, double smoothing, double emitted);

/// Whether the exact irradiance is known.
[[nodiscard]] bool has_exact_picture(const std::string& scene);

/// The exact irradiance, pixel by pixel, row 0 at the bottom; nothing for a case without an exact solution.
[[nodiscard]] std::optional<std::vector<double>> exact_picture(const BuiltinFilm& film, unsigned threads);

} // namespace nephroid::examples
