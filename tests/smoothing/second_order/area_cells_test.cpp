// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/area_cells.hpp"

#include "smoothing/second_order/area_maps.hpp"

#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::area_cells_test {

using namespace nephroid::detail;
using tests::area_samples;

TEST_CASE("area cells: each photon is in the cell of its sample") {
    const auto all = area_samples<RandomSequence>(3000);
    const AreaCells cells(all, {3, 1, 4, 5});
    REQUIRE(cells.size() == 60);
    std::vector<int> met(all.size());
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        CHECK(cells.cell_at(cells.coordinates_of(cell)) == cell);
        for (const std::uint32_t i : cells.photons(cell)) {
            ++met[i];
            CHECK(cells.cell_of(all[i]) == cell);
            const AreaSample step = cells.from_middle(cell, all[i], false);
            for (const double x : step)
                CHECK(std::abs(x) <= 0.5 + 1e-12);
            CHECK(cells.from_middle(cell, all[i], true)[1] == 0); // one cell is not fine
        }
    }
    CHECK(met == std::vector<int>(all.size(), 1));
}

// 16 photons in each of 4096 cells.
TEST_CASE("area cells: axes with more change get more cells") {
    const auto counts = [](AreaSample need) { return AreaCells::counts_for(65536, need); };
    CHECK(counts({1, 1, 1, 1}) == AreaCells::CellCoordinates{8, 8, 8, 8});
    CHECK(counts({1, 1, 4, 4}) == AreaCells::CellCoordinates{4, 4, 16, 16});
    CHECK(counts({0, 0, 5, 5}) == AreaCells::CellCoordinates{1, 1, 64, 64});
    CHECK(counts({0, 0, 4, 1}) == AreaCells::CellCoordinates{1, 1, 128, 32});
    CHECK(counts({0, 3, 0, 0}) == AreaCells::CellCoordinates{1, 4096, 1, 1});
    CHECK(counts({2, 2e9, 2e9, 2}) == AreaCells::CellCoordinates{1, 64, 64, 1});
    // What says nothing.
    CHECK(counts({0, 0, 0, 0}) == AreaCells::CellCoordinates{8, 8, 8, 8});
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK(counts({infinity, 1, 1, 1}) == AreaCells::CellCoordinates{8, 8, 8, 8});
    CHECK(AreaCells::counts_for(0, {1, 1, 1, 1}) == AreaCells::CellCoordinates{1, 1, 1, 1});
}

// Multilinear weights make a linear function of the middles' places, and its slopes, wherever they do not end at a
// border.
TEST_CASE("area cells: nodes interpolate linear functions exactly") {
    const AreaCells cells({}, {4, 1, 5, 2});
    const AreaSample slope{2, 0, -3, 0.5};
    const auto value = [&](const AreaSample& at) { return 1 + slope[0] * at[0] + slope[2] * at[2] + slope[3] * at[3]; };
    for (const AreaSample& at : area_samples<RandomSequence>(200)) {
        double sum = 0, weights = 0;
        AreaSample slopes{};
        const AreaSample inside{0.125 + 0.75 * at[0], at[1], 0.1 + 0.8 * at[2], 0.25 + 0.5 * at[3]};
        cells.for_each_node(inside, [&](std::size_t cell, double weight, const AreaSample& by) {
            const auto place = cells.coordinates_of(cell);
            AreaSample middle;
            for (std::size_t axis = 0; axis < 4; ++axis)
                middle[axis] = (double(place[axis]) + 0.5) / double(cells.counts()[axis]);
            sum += weight * value(middle);
            weights += weight;
            for (std::size_t axis = 0; axis < 4; ++axis)
                slopes[axis] += by[axis] * value(middle);
        });
        CHECK(weights == doctest::Approx(1).epsilon(1e-14));
        CHECK(sum == doctest::Approx(value(inside)).epsilon(1e-13));
        for (std::size_t axis = 0; axis < 4; ++axis)
            CHECK(slopes[axis] == doctest::Approx(slope[axis]).epsilon(1e-12));
    }
    // At the corners of the domain a single cell is left.
    for (const double at : {0.0, std::nextafter(1.0, 0.0)}) {
        double weights = 0;
        cells.for_each_node({at, at, at, at},
                            [&](std::size_t, double weight, const AreaSample&) { weights += weight; });
        CHECK(weights == 1);
    }
}

TEST_CASE("area cells: the cells around a cell are those that touch it") {
    const AreaCells cells({}, {3, 1, 4, 5});
    std::size_t inside = 0, beyond = 0;
    cells.for_each_around(cells.cell_at({1, 0, 0, 2}), [&](const std::array<int, 4>& step, std::size_t other) {
        if (other == cells.size()) {
            ++beyond;
            return;
        }
        ++inside;
        CHECK(cells.coordinates_of(other) ==
              AreaCells::CellCoordinates{std::size_t(1 + step[0]), 0, std::size_t(step[2]), std::size_t(2 + step[3])});
    });
    CHECK(inside == 3 * 1 * 2 * 3);
    CHECK(inside + beyond == 81);
}

} // namespace nephroid::tests::area_cells_test
