// SPDX-License-Identifier: MIT
#include "nephroid/tree/divided_points.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::divided_points_test {

// Down to leaves, with coordinates that are the same for many.
TEST_CASE_TEMPLATE("divided points: each half lies on its side and no point is lost", T, float, double) {
    tests::Draws draw(85);
    constexpr std::size_t count = 3000, leaf_size = 16;
    detail::DividedPoints<T> points(leaf_size);
    for (std::size_t i = 0; i < count; ++i) {
        const T x = T(int(draw.in(0, 40))), y = T(draw.in(0, 1));
        points.add({x, y, T(0)}, std::uint32_t(i));
    }
    std::vector<std::array<std::size_t, 2>> pending{{0, count}};
    while (!pending.empty()) {
        const auto [begin, end] = pending.back();
        pending.pop_back();
        const Box<T> box = points.bounds(begin, end);
        if (end - begin <= leaf_size)
            continue;
        const std::size_t middle = points.halve(begin, end, box);
        REQUIRE(middle > begin);
        REQUIRE(middle < end);
        // Across the longest side of the box.
        const std::size_t axis = box.high[0] - box.low[0] >= box.high[1] - box.low[1] ? 0 : 1;
        CHECK(points.bounds(begin, middle).high[axis] <= points.bounds(middle, end).low[axis]);
        pending.push_back({begin, middle});
        pending.push_back({middle, end});
    }
    std::vector<int> seen(count);
    for (std::size_t i = 0; i < count; ++i)
        ++seen[points[i].index()];
    for (const int times : seen)
        CHECK(times == 1);
}

} // namespace nephroid::tests::divided_points_test
