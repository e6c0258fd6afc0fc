// SPDX-License-Identifier: MIT
#include "common/gltf/enclosure.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace nephroid::examples::gltf {
namespace {

/// The vertices' indices, the same for all vertices at one position.
std::vector<std::uint32_t> welded(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size()), place(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t i) { return std::tuple(positions[i].x, positions[i].y, positions[i].z); };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < order.size(); ++i)
        place[order[i]] = i > 0 && key(order[i]) == key(order[i - 1]) ? place[order[i - 1]] : order[i];
    return place;
}

/// Whether the edges, each with its direction as a sign, cancel.
bool cancel(std::vector<std::array<std::uint32_t, 3>>& edges) {
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
        std::ptrdiff_t sum = 0;
        const std::size_t first = i;
        for (; i < edges.size() && edges[i][0] == edges[first][0] && edges[i][1] == edges[first][1]; ++i)
            sum += edges[i][2] == 0 ? 1 : -1;
        if (sum != 0)
            return false;
    }
    return true;
}
} // namespace

Enclosure enclosure_of(const MeshDescription& mesh) {
    const std::vector<std::uint32_t> place = welded(mesh.positions);
    std::vector<std::array<std::uint32_t, 3>> edges;
    edges.reserve(3 * mesh.triangles.size());
    double six_volumes = 0;
    const glm::dvec3 base(mesh.positions.front());
    for (const auto& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = place[t[i]], to = place[t[(i + 1) % 3]];
            if (from != to)
                edges.push_back({(std::min)(from, to), (std::max)(from, to), from < to ? 0u : 1u});
        }
        const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positions[t[i]]) - base; };
        six_volumes += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
    }
    return {cancel(edges), six_volumes / 6};
}

} // namespace nephroid::examples::gltf
