// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/group_cells.hpp"

#include "smoothing/second_order/maps.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::group_cells_test {

using namespace nephroid::detail;
using tests::Samples;

TEST_CASE("group cells: cells are small only for stratified photons that all take one path") {
    CHECK(detail::photons_per_cell(true, 1) < EmissionCells::photons_per_cell);
    CHECK(detail::photons_per_cell(true, 0.99) == EmissionCells::photons_per_cell);
    CHECK(detail::photons_per_cell(false, 1) == EmissionCells::photons_per_cell);
    CHECK(detail::photons_per_cell(false, 0.5) == EmissionCells::photons_per_cell);
}

// Bilinear weights bring back a linear function between the outermost middles, and its slope; a few roundings of
// numbers up to the 20 cells of a side.
TEST_CASE("group cells: nodes interpolate linear functions exactly") {
    const detail::GroupCells cells(EmissionCells(tests::lattice(60, 60), 1, false, 9));
    const auto linear = [](const std::array<double, 2>& at) { return 2 + 3 * at[0] - 5 * at[1]; };
    for (const auto& sample : Samples{{0.3, 0.4}, {0.031, 0.96}, {0.5, 0.5}, {0.77, 0.123}}) {
        double value = 0, by_first = 0, by_second = 0;
        for (const detail::InterpolationNode& node : cells.nodes_around(sample)) {
            const double f = linear(cells.grid().middle(node.square));
            value += node.weight * f;
            by_first += node.slope[0] * f;
            by_second += node.slope[1] * f;
        }
        CHECK(value == doctest::Approx(linear(sample)).epsilon(1e-14));
        CHECK(by_first == doctest::Approx(3).epsilon(1e-12));
        CHECK(by_second == doctest::Approx(-5).epsilon(1e-12));
    }
}

TEST_CASE("group cells: squares without photons are neither cells nor neighbours") {
    const Samples samples{{0.1, 0.1}, {0.9, 0.1}, {0.1, 0.9}, {0.9, 0.9}, {0.5, 0.9}, {0.5, 0.1}};
    const detail::GroupCells cells(EmissionCells(samples, 1, false, 6.0 / 9)); // 3 × 3 squares
    REQUIRE(cells.grid().size() == 9);
    CHECK(cells.size() == 6);
    CHECK(cells.cell_in(4) == nullptr);
    const detail::GroupCell* corner = cells.cell_in(0);
    REQUIRE(corner != nullptr);
    CHECK(cells.index_of(*corner) == 0);
    double weights = 0;
    std::size_t count = 0;
    cells.for_each_around(*corner, [&](const detail::GroupCell& cell, double weight) {
        CHECK(cell.square < 2);
        weights += weight;
        ++count;
    });
    CHECK(count == 2); // itself, and the one beside it: nothing above
    CHECK(weights == 4 + 2);
}

} // namespace nephroid::tests::group_cells_test
