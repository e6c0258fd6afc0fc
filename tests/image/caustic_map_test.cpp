// SPDX-License-Identifier: MIT
#include "nephroid/image/caustic_map.hpp"

#include "nephroid/image/projected_chart.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <glm/vec3.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace nephroid::tests::caustic_map_test {

namespace {

using Vec3 = glm::dvec3;
using Map = CausticMap<Vec3, double, PlaneChart>;

[[nodiscard]] Map map_of(bool repeats = false) {
    Map map(PlaneChart(Vec3(0), Vec3(2, 0, 0), Vec3(0, 2, 0), 16, 16, repeats));
    for (std::size_t j = 0; j < 16; ++j)
        for (std::size_t i = 0; i < 16; ++i)
            map.texel(i, j).irradiance = 3 + double(i) + 10 * double(j);
    return map;
}

} // namespace

TEST_CASE("caustic map: between texels the irradiance is linear") {
    const Map map = map_of();
    for (const double x : {0.1, 0.77, 1.2})
        for (const double y : {0.2, 1.0, 1.8})
            CHECK(map.at({x, y, 0}, {0, 0, 1}) == doctest::Approx(3 + (8 * x - 0.5) + 10 * (8 * y - 0.5)));
    // At its border the texels that there are count.
    CHECK(map.at({0.01, 0.01, 0}, {0, 0, 1}) == doctest::Approx(3));
}

TEST_CASE("caustic map: a point above it, of another side, outside or without place gets no light") {
    const Map map = map_of();
    CHECK(map.at({1, 1, 0.02}, {0, 0, 1}) > 0); // within a texel's side, 1/8
    CHECK(map.at({1, 1, 0.3}, {0, 0, 1}) == 0);
    CHECK(map.at({1, 1, 0}, {0, 0, -1}) == 0);
    CHECK(map.at({3, 1, 0}, {0, 0, 1}) == 0);
    CHECK(map.at({std::numeric_limits<double>::quiet_NaN(), 1, 0}, {0, 0, 1}) == 0);
}

TEST_CASE("caustic map: a pattern goes on beyond its tile") {
    const Map map = map_of(true);
    for (const double x : {0.3, 1.99})
        for (const Vec3 normal : {Vec3(0, 0, 1), Vec3(0.196, 0, 0.981)}) // a shading normal
            CHECK(map.at({x + 4, 1 - 2, 0}, normal) == doctest::Approx(map.at({x, 1, 0}, normal)));
}

TEST_CASE("caustic map: its flux is irradiance times area, of texels that see a surface") {
    CHECK(map_of().flux() == doctest::Approx(4 * (3 + 7.5 + 75))); // the mean over 2 × 2
    // A view whose left half sees nothing.
    CausticMap<Vec3, double, ViewChart> view(ViewChart(Vec3(0, 0, 2), Vec3(0), Vec3(0, 1, 0), 1, 8, 8),
                                             [](const RasterRay& ray) -> std::optional<ReceiverPoint> {
                                                 const double t = -ray.origin.z / ray.direction.z;
                                                 const ChartVector p = ray.origin + t * ray.direction;
                                                 if (p.x < 0)
                                                     return std::nullopt;
                                                 return ReceiverPoint{p, {0, 0, 1}};
                                             });
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t j = 0; j < 8; ++j)
            view.texel(i, j).irradiance = 1;
    const double half = 2 * std::tan(0.5);
    CHECK(view.flux() == doctest::Approx(2 * half * half)); // half of the square that it sees
    CHECK(view.texel(7, 3).depth == doctest::Approx(2));
}

} // namespace nephroid::tests::caustic_map_test
