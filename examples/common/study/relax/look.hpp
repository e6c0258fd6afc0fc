// SPDX-License-Identifier: MIT
/// @file  A photon map looked at with some number of neighbours: the picture, its error, and what it took.
#pragma once

#include "common/errors.hpp"
#include "common/image/image.hpp"
#include "common/study/relax/subject.hpp"

#include "nephroid/gather/photon_map.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace nephroid::examples::study::relax {

struct Look {
    std::size_t neighbours;            ///< k
    double seconds;                    ///< for all vertices of the picture; the least of a few tries where it is short
    Image<Rgb> picture;                ///< linear
    std::optional<Errors> errors;      ///< where the truth is known
    std::vector<EdgeProfile> profiles; ///< of the subject's edges
    std::vector<double> edge_widths;   ///< of the same; world units, NaN where wider than could be seen
};

using Map = PhotonMap<glm::vec3, Color>;

[[nodiscard]] Map map_of(const std::vector<StoredPhoton>& photons);

/// Estimates irradiance by the k nearest photons, by an Epanechnikov kernel as Spencer and Jones 2009 do or another.
[[nodiscard]] Look look(const Subject& subject, const Map& map, std::size_t neighbours, LookKernel kernel,
                        ThreadExecutor& threads);

/// The numbers of neighbours that show least error.
struct BestNeighbours {
    std::size_t relative, rmse; ///< by relative error, and by that of the exposed and clipped pictures
};

/// Tries numbers of neighbours in order, until three in a row are worse than the best by either measure.
/// @param neighbours  at least one, ascending
[[nodiscard]] BestNeighbours best_neighbours(const Subject& subject, const Map& map,
                                             const std::vector<std::size_t>& neighbours, LookKernel kernel,
                                             ThreadExecutor& threads);

} // namespace nephroid::examples::study::relax
