// SPDX-License-Identifier: MIT
#include "nephroid/receiver/distance_table.hpp"

#include "nephroid/footprint/kernel.hpp"
#include "nephroid/receiver/free_distances.hpp"

#include "bounce/closed_rooms.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace nephroid::tests::distance_table_test {

using D = glm::dvec3;

namespace {

/// The sum of a kernel over a fine grid of those places in a disk that count as on the surface.
template <class IsReached>
[[nodiscard]] double sum_over_grid(double radius, const IsReached& is_reached) {
    constexpr int n = 500;
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const double x = 2 * (i % n + 0.5) / n - 1, z = 2 * (i / n + 0.5) / n - 1, r2 = x * x + z * z;
        if (r2 < 1 && is_reached(radius * x, radius * z))
            sum += BiweightKernel{}(r2)*4 / double(n * n);
    }
    return sum;
}

/// Checks that all vertices, which look upwards, have the coverage of the region that they reach.
void check_region(const Room<double>& room, const std::vector<D>& places, double reach, double radius) {
    std::vector<RoomVertex<double>> vertices;
    for (const D& place : places)
        vertices.push_back({place, D(0, 1, 0)});
    const auto map = map_of(vertices);
    const FreeDistances<D> distances(map, room, {.reach = reach});
    for (std::size_t slot = 0; slot < places.size(); ++slot) {
        const double sum =
            sum_over_grid(radius, [&](double x, double z) { return distances.reaches(slot, D(x, 0, z)); });
        CAPTURE(map.tree().index(slot));
        CHECK(distances.coverage(slot, radius, BiweightKernel{}) == doctest::Approx(sum).epsilon(0.01));
    }
}

/// A horizontal rectangle.
[[nodiscard]] Wall<double, double> plate(double x, double y, double z, double width, double depth) {
    return {D(x, y, z), D(0, 0, depth), D(width, 0, 0), 0.5};
}

} // namespace

TEST_CASE("distance table: sum and coverage speak of one region on thin strips") {
    for (const double width : {0.03, 0.04, 0.06}) {
        CAPTURE(width);
        Room<double> strip;
        strip.walls = {plate(0, 0, 0, width, 2)};
        check_region(strip, {D(0.1 * width, 0, 1), D(0.3 * width, 0, 0.9), D(0.5 * width, 0, 1.1)}, 0.5, 0.25);
    }
}

TEST_CASE("distance table: sum and coverage speak of one region at steps, gaps and walls") {
    Room<double> room;
    room.walls = {plate(0, 0, 0, 1, 1), plate(-5, -0.05, -5, 11, 11)}; // a low plinth
    check_region(room, {D(0.999, 0, 0.5), D(0.9, 0, 0.9), D(0.02, 0, 0.5)}, 0.7, 0.2);
    room.walls = {plate(0, 0, 0, 0.4, 0.4), plate(0.7, 0, -1, 0.4, 2)}; // a seat beside another
    check_region(room, {D(0.2, 0, 0.2), D(0.39, 0, 0.2), D(0.05, 0, 0.35)}, 1.6, 0.3);
    check_region(furnace_with_block<double>(), {D(0.25, 0, 0.25), D(0.05, 0, 0.1), D(0.61, 0, 0.5)}, 0.6, 0.3);
}

// The edge is at the same distance in all directions but one half, where nothing ends the surface. A disk larger than
// the reach goes on there.
TEST_CASE("distance table: beyond the reach the surface goes on, as far as coverage counts it") {
    detail::DistanceTable<double> table(1, 32, 1);
    for (std::size_t i = 0; i < 16; ++i)
        table.set(0, i, 0.2);
    const double sum = sum_over_grid(2, [&](double x, double y) {
        return table.is_before_end(0, x * x + y * y, detail::compass_point(0.0, 0.0, 1.0, x, y, 0.0));
    });
    const double within = 1 - std::pow(1 - 0.01, 3);
    CHECK(table.coverage(0, 2.0, BiweightKernel{}) == doctest::Approx((1 + within) / 2).epsilon(0.001));
    CHECK(sum == doctest::Approx((1 + within) / 2).epsilon(0.01));
}

TEST_CASE("distance table: at the rim of a low step a half is covered, and no edge is found beyond it") {
    Room<double> room;
    room.walls = {plate(0, 0, 0, 1, 1), plate(-5, -0.05, -5, 11, 11)};
    const std::vector<RoomVertex<double>> rim{{D(0.999, 0, 0.5), D(0, 1, 0)}};
    const auto map = map_of(rim);
    const FreeDistances<D> distances(map, room, {.reach = 0.7});
    for (const double radius : {0.05, 0.15})
        CHECK(distances.coverage(0, radius, BiweightKernel{}) == doctest::Approx(0.5).epsilon(0.02));
    room.walls = {plate(0, 0, 0, 0.4, 0.4), plate(0.7, 0, -1, 0.4, 2)};
    const std::vector<RoomVertex<double>> seat{{D(0.2, 0, 0.2), D(0, 1, 0)}};
    const auto seats = map_of(seat);
    const FreeDistances<D> on_seat(seats, room, {.reach = 1.6});
    for (std::size_t i = 0; i < 32; ++i)
        CHECK(on_seat.distance(0, i) < 0.29);
    CHECK(on_seat.reaches(0, D(0.19, 0, 0)));
    CHECK(!on_seat.reaches(0, D(0.6, 0, 0)));
}

} // namespace nephroid::tests::distance_table_test
