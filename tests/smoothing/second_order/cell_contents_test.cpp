// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/cell_contents.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::cell_contents_test {

using namespace nephroid::detail;

TEST_CASE("cell contents: each photon is in its cell and in order") {
    constexpr std::size_t cells = 7, count = 1000;
    const auto cell_of = [](std::size_t i) { return i * i % cells; }; // the squares: 0, 1, 2 and 4
    const CellContents contents(cells, count, cell_of);
    std::size_t met = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        std::size_t at_least = 0;
        for (const std::uint32_t i : contents[cell]) {
            CHECK(cell_of(i) == cell);
            CHECK(i >= at_least);
            at_least = i + 1;
        }
        met += contents[cell].size();
    }
    CHECK(met == count);
    CHECK(contents[3].empty());
    CHECK(contents[6].empty());
}

TEST_CASE("cell contents: no photons leave all cells empty") {
    const CellContents contents(2, 0, [](std::size_t) { return std::size_t(0); });
    CHECK(contents[0].empty());
    CHECK(contents[1].empty());
}

} // namespace nephroid::tests::cell_contents_test
