// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/area_border.hpp"

#include "smoothing/second_order/area_maps.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::area_border_test {

using namespace nephroid::detail;
using tests::area_samples;

// 6^4 cells of 16 photons, 1296 of them about a cell. Means and shares of so many vary by 1.5/sqrt(1296/4) at most:
// 0.08.
TEST_CASE("area border: a plane across the domain is found") {
    const auto all = area_samples<HaltonSequence>(6 * 6 * 6 * 6 * 16);
    const AreaCells cells(all, {6, 6, 6, 6});
    const std::size_t cell = cells.cell_at({2, 3, 2, 3});
    for (const double distance : {-0.5, 0.0, 0.5, 1.0}) {
        const auto border = border_near(
            cells, cell, all, [&](std::uint32_t i) { return cells.from_middle(cell, all[i], false)[2] < distance; });
        REQUIRE(border);
        CHECK(border->outwards[2] > 0.98);
        CHECK(std::abs(border->distance - distance) < 0.08);
        // Seen from two cells back it is two cells further.
        const AreaBorder seen = border->seen_from({2, 3, 2, 3}, {2, 3, 0, 3});
        CHECK(seen.distance == doctest::Approx(border->distance + 2 * border->outwards[2]).epsilon(1e-12));
    }
    CHECK(!border_near(cells, cell, all, [](std::uint32_t) { return true; }));
    CHECK(!border_near(cells, cell, all, [](std::uint32_t) { return false; }));
    CHECK(!border_near(cells, cell, all, [](std::uint32_t i) { return i % 7 != 3; })); // amid the others
}

TEST_CASE("area border: the domain has borders along the axes with several cells") {
    const auto all = area_samples<HaltonSequence>(1 * 2 * 16 * 8 * 16);
    const AreaCells cells(all, {1, 2, 16, 8});
    const auto everywhere = [](std::uint32_t) { return true; };
    CHECK(!border_near(cells, cells.cell_at({0, 0, 5, 4}), all, everywhere));
    const auto border = border_near(cells, cells.cell_at({0, 1, 15, 4}), all, everywhere);
    REQUIRE(border);
    CHECK(border->outwards[2] > 0.98);
    CHECK(std::abs(border->distance - 0.5) < 0.1); // half a cell away
}

} // namespace nephroid::tests::area_border_test
