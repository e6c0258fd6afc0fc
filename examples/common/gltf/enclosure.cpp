// SPDX-License-Identifier: MIT
#include "common/gltf/enclosure.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>

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

/// The same for all vertices that lie at one position but for rounding, as those at the poles of a sphere do, whose
/// radius there is not quite 0. Source of the hash: Teschner et al. 2003.
std::vector<std::uint32_t> welded_to_rounding(const std::vector<glm::vec3>& positions) {
    double largest = 0; // of the coordinates
    for (const glm::vec3& p : positions)
        largest = (std::max)({largest, double{std::abs(p.x)}, double{std::abs(p.y)}, double{std::abs(p.z)}});
    const double apart = 4 * double{std::numeric_limits<float>::epsilon()} * largest, cell = 4 * apart;
    if (!(largest > 0)) // all lie at one position, and no cell has a size
        return welded(positions);
    const auto cell_of = [cell](const glm::dvec3& p) {
        const auto along = [cell](double x) {
            return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell)));
        };
        return along(p.x) * 73856093u ^ along(p.y) * 19349663u ^ along(p.z) * 83492791u;
    };
    std::unordered_multimap<std::uint64_t, std::uint32_t> first_of_cells;
    std::vector<std::uint32_t> place(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        place[i] = i;
        const glm::dvec3 p(positions[i]);
        for (unsigned side = 0; side < 8; ++side) { // the cells that its surroundings reach into
            const auto sign = [side](unsigned axis) { return (side >> axis & 1u) != 0 ? 1.0 : -1.0; };
            const glm::dvec3 corner = p + apart * glm::dvec3(sign(0), sign(1), sign(2));
            const auto [begin, end] = first_of_cells.equal_range(cell_of(corner));
            for (auto found = begin; found != end; ++found)
                if (const glm::dvec3 d = glm::abs(glm::dvec3(positions[found->second]) - p);
                    (std::max)({d.x, d.y, d.z}) <= apart)
                    place[i] = (std::min)(place[i], found->second); // whatever the order of the hash table
        }
        if (place[i] == i)
            first_of_cells.emplace(cell_of(p), i);
    }
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

/// @param place  of each vertex: the first one at its position
bool closes(const MeshDescription& mesh, const std::vector<std::uint32_t>& place) {
    std::vector<std::array<std::uint32_t, 3>> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& t : mesh.triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = place[t[i]], to = place[t[(i + 1) % 3]];
            if (from != to)
                edges.push_back({(std::min)(from, to), (std::max)(from, to), from < to ? 0u : 1u});
        }
    return !edges.empty() && cancel(edges);
}
} // namespace

Enclosure enclosure_of(const MeshDescription& mesh) {
    double six_volumes = 0;
    const glm::dvec3 base(mesh.positions.front());
    for (const auto& t : mesh.triangles) {
        const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positions[t[i]]) - base; };
        six_volumes += glm::dot(corner(0), glm::cross(corner(1), corner(2)));
    }
    const bool is_closed = closes(mesh, welded(mesh.positions)) || closes(mesh, welded_to_rounding(mesh.positions));
    return {is_closed, six_volumes / 6};
}

} // namespace nephroid::examples::gltf
