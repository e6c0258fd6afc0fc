// SPDX-License-Identifier: MIT
/// @file  Points for benchmarks: eye path vertices and photons on a unit square, and nanoflann's tree over them.
#pragma once

#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/vector/glm.hpp"

#include <nanoflann.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace nephroid::examples::benchmarks {

using Vec = glm::vec3;

struct Vertex {
    Vec position;
    Vec normal{0, 0, 1};
};

/// side² vertices, one at a random position in each cell of a grid, row by row: eye paths with one sample per pixel.
[[nodiscard]] inline std::vector<Vertex> film_vertices(std::size_t side) {
    const RandomSequence sequence(7);
    std::vector<Vertex> vertices;
    vertices.reserve(side * side);
    for (std::size_t i = 0; i < side * side; ++i) {
        Sampler<RandomSequence> draw(sequence, i);
        const float x = float(i % side) + draw.next<float>(), y = float(i / side) + draw.next<float>();
        vertices.push_back({Vec(x, y, 0) / float(side)});
    }
    return vertices;
}

/// Positions on the unit square, in the order of the photons.
template <class Sequence>
[[nodiscard]] std::vector<Vec> places(std::size_t count, const Sequence& sequence) {
    std::vector<Vec> result;
    result.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        Sampler<Sequence> draw(sequence, i);
        const float x = draw.template next<float>();
        result.push_back({x, draw.template next<float>(), 0});
    }
    return result;
}

/// An array of points as nanoflann asks for them.
struct Cloud {
    const std::vector<Vec>* points;
    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points->size(); }
    [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const { return (*points)[i][int(axis)]; }
    template <class Bounds>
    bool kdtree_get_bbox(Bounds&) const {
        return false;
    }
};

using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3, std::uint32_t>;

[[nodiscard]] inline std::vector<Vec> positions_of(const std::vector<Vertex>& vertices) {
    std::vector<Vec> positions;
    positions.reserve(vertices.size());
    for (const Vertex& vertex : vertices)
        positions.push_back(vertex.position);
    return positions;
}

} // namespace nephroid::examples::benchmarks
