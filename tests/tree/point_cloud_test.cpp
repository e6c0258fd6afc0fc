// SPDX-License-Identifier: MIT
#include "nephroid/tree/point_cloud.hpp"

#include <doctest/doctest.h>

#include <array>

namespace nephroid::tests::point_cloud_test {

TEST_CASE("point cloud: is centred on the median and a stray point far away does not move it") {
    detail::PointCloud<float> cloud;
    for (int i = 0; i < 101; ++i)
        cloud.points.push_back({float(i), float(2 * i), 5});
    cloud.points[7] = {1e30f, -1e30f, 5};
    const std::array<float, 3> origin = detail::centre_on_median(cloud);
    CHECK(origin[0] >= 49);
    CHECK(origin[0] <= 51);
    CHECK(cloud.points[3] == std::array<float, 3>{3 - origin[0], 6 - origin[1], 0});
    detail::PointCloud<float> empty;
    CHECK(detail::centre_on_median(empty) == std::array<float, 3>{0, 0, 0});
}

} // namespace nephroid::tests::point_cloud_test
