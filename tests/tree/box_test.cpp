// SPDX-License-Identifier: MIT
#include "nephroid/tree/box.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::box_test {

TEST_CASE("box: boxes that touch overlap and flat ones do too") {
    const Box<float> unit{{0, 0, 0}, {1, 1, 1}};
    CHECK(unit.overlaps({{1, 1, 1}, {2, 2, 2}}));
    CHECK(unit.overlaps({{0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5f}}));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Box<float> beside = unit;
        beside.low[axis] = 1.001f, beside.high[axis] = 2;
        CHECK(!unit.overlaps(beside));
        CHECK(!beside.overlaps(unit));
    }
}

TEST_CASE("box: grows to hold others and an empty one becomes the first of them") {
    Box<double> box = detail::empty_box<double>();
    CHECK(!box.overlaps({{-1, -1, -1}, {1, 1, 1}}));
    box.add({{1, 2, 3}, {4, 5, 6}});
    CHECK(box.low == std::array<double, 3>{1, 2, 3});
    box.add({{0, 3, 0}, {1, 9, 1}});
    CHECK(box.low == std::array<double, 3>{0, 2, 0});
    CHECK(box.high == std::array<double, 3>{4, 9, 6});
}

} // namespace nephroid::tests::box_test
