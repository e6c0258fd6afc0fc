// SPDX-License-Identifier: MIT
/// @file  Stored photons that can be relaxed, which each file here uses wrongly in one respect.
#pragma once

#include "nephroid/relaxation/relax.hpp"
#include "nephroid/vector/glm.hpp"

#include <list>
#include <vector>

struct Photon {
    glm::vec3 position, normal;
    float flux;
};

inline std::vector<Photon> photons;
inline const auto access_to_photons = nephroid::photon_access(&Photon::position, &Photon::normal, &Photon::flux);
