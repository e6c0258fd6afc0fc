// SPDX-License-Identifier: MIT
/// @file  Pictures on a raster from photons on a grid: nephroid's two ways and those of the papers before it.
#pragma once

#include "nephroid/image/caustic_map.hpp"
#include "nephroid/image/neighbour_tangents.hpp"
#include "nephroid/image/projected_chart.hpp"
#include "nephroid/vector/glm.hpp"

#include <glm/vec3.hpp>

#include <functional>
#include <string>
#include <vector>

namespace nephroid::examples::study::image {

using FloorMap = CausticMap<glm::vec3, float, PlaneChart>;
using GridPhotons = std::vector<Deposit<glm::vec3, float, 2>>;
using GridBuffer = PhotonBuffer<glm::vec3, float>;

/// What thin-lens sizes know of a photon: the first surface's mean curvature over its focal length, and how far the
/// light goes on from there.
struct ThinLens {
    double inverse_image; ///< 1 / d_image, world units; negative behind the surface
    double d_background;  ///< from the first surface to the receiver
};

/// What a method is given.
struct GridScene {
    PlaneChart chart;
    double film_area = 1;         ///< of the raster, world units
    GridBuffer corners;           ///< for sheets
    GridPhotons photons;          ///< of centres, with neighbours' tangents, node by node
    std::vector<ThinLens> lenses; ///< of the same
    double cell = 0;              ///< area of a node's cell across the light, world units
};

struct RasterMethod {
    std::string title;
    double s_least, s_most; ///< what is tried; equal where there is nothing to choose
    std::function<std::vector<float>(const GridScene&, double)> picture;
};

/// Fixed sizes, the papers' two, and nephroid's.
[[nodiscard]] const std::vector<RasterMethod>& raster_methods();

/// The row by row picture of a map.
[[nodiscard]] std::vector<float> pixels_of(const FloorMap& map);

/// Draws photons by ellipses.
[[nodiscard]] std::vector<float> draw_photons(const GridScene& scene, const GridPhotons& photons, double smoothing);

} // namespace nephroid::examples::study::image
