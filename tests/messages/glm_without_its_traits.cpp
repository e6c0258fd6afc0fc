// SPDX-License-Identifier: MIT
// expect: or include nephroid/vector/glm.hpp
#include "nephroid/caustics.hpp"

#include <glm/vec3.hpp>

#include <vector>

struct Vertex {
    glm::vec3 position, normal;
};
const std::vector<Vertex> vertices(1);
const nephroid::EyePathMap map(vertices, &Vertex::position, &Vertex::normal);
