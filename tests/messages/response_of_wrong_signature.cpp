// SPDX-License-Identifier: MIT
// expect: nephroid: the response cannot be called as response(std::size_t vertex, const V& direction)
#include "messages/renderer.hpp"

auto shiny = nephroid::sums<float>(map, [](const V& direction) { return direction.z; });
