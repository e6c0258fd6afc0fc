// SPDX-License-Identifier: MIT
#include "nephroid/image/raster_tiles.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

namespace nephroid::tests::raster_tiles_test {

namespace {

using detail::RasterBox;
using detail::RasterTiles;
using detail::RasterWindow;

constexpr std::size_t columns = 150, rows = 70;

/// How often each texel is visited, each by a box of its own shift.
[[nodiscard]] std::vector<int> visits(const RasterBox& box, bool repeats, std::vector<char>* arrived = nullptr) {
    RasterTiles tiles(columns, rows, repeats);
    SerialExecutor serial;
    std::vector<int> count(columns * rows, 0);
    const std::vector<RasterBox> boxes{box};
    const auto result = tiles.draw(
        boxes,
        [&](std::size_t, const RasterWindow& w) {
            for (std::size_t j = w.row; j < w.row + w.rows; ++j)
                for (std::size_t i = w.column; i < w.column + w.columns; ++i)
                    ++count[j * columns + i];
            return w.columns > 0 && w.rows > 0;
        },
        serial);
    if (arrived)
        *arrived = result;
    return count;
}

} // namespace

TEST_CASE("raster tiles: a box is drawn into each texel that it overlaps, once") {
    const RasterBox box{10.5, 3.25, 140.5, 66.75};
    const auto count = visits(box, false);
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i)
            CHECK(count[j * columns + i] == int(i >= 10 && i <= 140 && j >= 3 && j <= 66));
}

TEST_CASE("raster tiles: beyond the raster there is nothing to draw, and on a pattern it is somewhere else") {
    std::vector<char> arrived;
    const RasterBox box{-20, 75, -10, 80};
    for (const int n : visits(box, false, &arrived))
        CHECK(n == 0);
    CHECK(arrived[0] == 0);
    const auto count = visits(box, true, &arrived);
    CHECK(arrived[0] == 1);
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i)
            CHECK(count[j * columns + i] == int(i >= 130 && i <= 140 && j >= 5 && j <= 10));
}

TEST_CASE("raster tiles: boxes that are empty, endless or no numbers are left out") {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    for (const bool repeats : {false, true})
        for (const RasterBox& box : {RasterBox{}, RasterBox{0, 0, inf, 1}, RasterBox{nan, 0, 1, 1}}) {
            std::vector<char> arrived;
            for (const int n : visits(box, repeats, &arrived))
                CHECK(n == 0);
            CHECK(arrived[0] == 0);
        }
}

} // namespace nephroid::tests::raster_tiles_test
