// SPDX-License-Identifier: MIT
#include "nephroid/gather/free_distance_coverage.hpp"

#include "nephroid/gather/fixed_range.hpp"

#include "bounce/closed_rooms.hpp"
#include "gather/stored_photons.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::free_distance_coverage_test {

using V = glm::dvec3;

// Even light of irradiance 1 on the floor of a box, z = 0 here. Without coverage a border shows half of it.
TEST_CASE("free distance coverage: an estimate from stored photons is even up to the walls") {
    static_assert(DiskCoverage<FreeDistanceCoverage<V>, V>);
    Room<double> room = furnace<double>();
    for (Wall<double, double>& wall : room.walls) // y up to z up
        for (V* const v : {&wall.corner, &wall.u, &wall.v})
            *v = V(v->z, v->x, v->y);
    std::vector<tests::Stored<V>> photons;
    for (int i = 0; i < 64 * 64; ++i)
        photons.push_back(tests::on_floor<V>((i % 64 + 0.5) / 64, (i / 64 + 0.5) / 64, 1.0 / (64 * 64)));
    const auto stored = tests::map_of_stored(photons);
    const auto vertices = room.vertices(32, {2});
    const auto map = map_of(vertices);
    const FreeDistances<V> distances(map, room);
    const FixedRange bare(stored, {.range = 0.2});
    const FixedRange covered(stored, {.range = 0.2}, BiweightKernel{},
                             FreeDistanceCoverage{distances, BiweightKernel{}});
    const V up{0, 0, 1};
    double least = 2, most = 0, darkest = 2;
    for (const RoomVertex<double>& vertex : vertices) {
        const double e = covered(vertex.position, up);
        least = e < least ? e : least;
        most = e > most ? e : most;
        darkest = bare(vertex.position, up) < darkest ? bare(vertex.position, up) : darkest;
    }
    CHECK(least > 0.97); // 32 directions: a hundredth in a corner, and as much by the lattice
    CHECK(most < 1.03);
    CHECK(darkest < 0.35);
}

TEST_CASE("free distance coverage: it is at least a twentieth") {
    Room<double> strip;
    strip.walls = {{V(0), V(0.005, 0, 0), V(0, 2, 0), 0.5}};
    const std::vector<RoomVertex<double>> vertices{{V(0.0025, 1, 0), V(0, 0, 1)}};
    const auto map = map_of(vertices);
    const FreeDistances<V> distances(map, strip, {.reach = 0.5});
    CHECK(distances.coverage(0, 0.4, BiweightKernel{}) < 0.05);
    CHECK(FreeDistanceCoverage<V>(distances)(vertices[0].position, V(0, 0, 1), 0.4) == 0.05);
}

} // namespace nephroid::tests::free_distance_coverage_test
