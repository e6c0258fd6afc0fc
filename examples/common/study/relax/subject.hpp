// SPDX-License-Identifier: MIT
/// @file  What `study relax` relaxes and looks at: photons, where the picture sees them, what is known of the truth.
#pragma once

#include "common/builtin_film.hpp"
#include "common/eye_paths.hpp"
#include "common/study/relax/edge.hpp"
#include "common/study/relax/options.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/vector/glm.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples::study::relax {

using Color = glm::vec3;

/// A photon where it lies. `direction` is that of its flight.
struct StoredPhoton {
    glm::vec3 position, normal, direction;
    Color flux;
};

struct Subject {
    std::vector<StoredPhoton> photons;
    std::vector<EyeVertex<float, Color>> vertices; ///< irradiance there times `weight` is what `pixel` gets
    std::size_t width = 0, height = 0;
    std::optional<FilmRectangle> floor;              ///< that the picture shows, where it is the plane z = 0
    std::optional<std::vector<double>> truth;        ///< irradiance, pixel by pixel
    std::vector<Edge> edges;                         ///< of known place and height
    std::optional<std::array<double, 4>> evenly_lit; ///< a part of the floor to take the spectrum of
    std::function<glm::vec3(std::size_t photon, const glm::vec3& moved)> project; ///< back onto a curved surface
    std::function<bool(const glm::vec3&)>
        on_surface;                 ///< whether a place lies on it; none if it does not end in the picture
    std::vector<std::string> notes; ///< on what is shown otherwise than one might think
};

/// A film's vertices on the floor as a camera's.
[[nodiscard]] std::vector<EyeVertex<float, Color>> eye_vertices(const BuiltinFilm& film);

/// A test pattern or a guide image. Photons go on beyond the picture by a tenth of it, so that it has no border.
/// Throws UsageError for an unknown one, std::runtime_error for an image that cannot be read or is black.
[[nodiscard]] Subject pattern_subject(const Options& options);

/// A built-in case with its exact picture. The wave's photons go on beyond the picture, as the wave does.
[[nodiscard]] Subject builtin_subject(const Options& options, ThreadExecutor& threads);

/// The caustics of a .glb or .gltf file as its camera sees them.
[[nodiscard]] Subject file_subject(const Options& options, ThreadExecutor& threads);

/// Whichever of them the options name.
[[nodiscard]] Subject make_subject(const Options& options, ThreadExecutor& threads);

} // namespace nephroid::examples::study::relax
