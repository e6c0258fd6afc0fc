// SPDX-License-Identifier: MIT
/// @file  Adds a sun, a ground or a camera to a file's scene, if the user asks for it or nothing would be seen without.
#pragma once

#include "common/caustics/options.hpp"
#include "common/gltf.hpp"

#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples {

/// What was added to the scene.
struct Additions {
    std::vector<std::string> assumed;  ///< a sentence for each addition that the user did not ask for
    std::optional<float> ground_level; ///< y, if a ground was added
};

/// Adds the sun and the ground that the options ask for. Without such options it adds a sun if the scene has neither
/// lamps nor an environment, and a ground if the scene has no diffuse surfaces, or has no lamps and no diffuse surface
/// below the specular ones.
///
/// The ground lies just below the lowest point of the specular surfaces, and extends over 50 times the scene's size.
[[nodiscard]] Additions add_sun_and_ground(SceneDescription& scene, const Options& options);

/// The corners of the region that a camera should show: the specular surfaces, and their shadows from directional lamps
/// on the ground. In a scene without specular surfaces, all meshes.
[[nodiscard]] std::vector<glm::vec3> points_of_interest(const SceneDescription& scene, const Additions& additions);

} // namespace nephroid::examples
