// SPDX-License-Identifier: MIT
/// @file  What is added to a file's scene, asked for or because nothing would be seen without: sun, ground, camera.
#pragma once

#include "common/caustics/options.hpp"
#include "common/gltf.hpp"

#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples {

/// What was added, and what of it nobody asked for.
struct Additions {
    std::vector<std::string> assumed;  ///< a sentence each
    std::optional<float> ground_level; ///< y, where a ground was added
};

/// Adds the sun and the ground that the options ask for. Without them: a sun to a scene without lamps and environment;
/// a ground to a scene in which nothing is diffuse, or without lamps of its own and without anything diffuse below what
/// is specular.
///
/// The ground lies just below the lowest point of what is specular, as far as 50 times the scene's size.
[[nodiscard]] Additions add_sun_and_ground(SceneDescription& scene, const Options& options);

/// The corners of what a camera should show: what is specular, and where light from directional lamps takes its shadow
/// on the ground; all meshes of a scene without anything specular.
[[nodiscard]] std::vector<glm::vec3> points_of_interest(const SceneDescription& scene, const Additions& additions);

} // namespace nephroid::examples
