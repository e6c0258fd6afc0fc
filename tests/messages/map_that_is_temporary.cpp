// SPDX-License-Identifier: MIT
// expect any: deleted function
#include "messages/renderer.hpp"

auto dangling = nephroid::sums<float>(nephroid::EyePathMap<V>(vertices, &Vertex::position, &Vertex::normal));
