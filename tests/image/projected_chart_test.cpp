// SPDX-License-Identifier: MIT
#include "nephroid/image/projected_chart.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <glm/vec3.hpp>

#include <cmath>
#include <stdexcept>

namespace nephroid::tests::projected_chart_test {

namespace {

using Vec3 = glm::dvec3;

/// Looks along rays, finds the points again, and compares the gradients with differences and the matrix with both.
template <class C>
void check_chart(const C& chart) {
    for (const double x : {0.5, 7.25, 30.0})
        for (const double y : {1.5, 12.0, 19.5})
            for (const double distance : {0.5, 2.0}) {
                const RasterRay ray = chart.ray(x, y);
                CHECK(length(ray.direction) == doctest::Approx(1).epsilon(1e-14));
                const ChartVector point = ray.origin + distance * ray.direction;
                const auto place = chart.place(point);
                REQUIRE(place.has_value());
                CHECK(place->x == doctest::Approx(x).epsilon(1e-12));
                CHECK(place->y == doctest::Approx(y).epsilon(1e-12));
                // Central differences with h = cbrt(epsilon) are good to h², relative to the third derivative.
                const double h = 6e-6;
                for (const ChartVector& step : {ChartVector{h, 0, 0}, ChartVector{0, h, 0}, ChartVector{0, 0, h}}) {
                    const auto after = chart.place(point + step), before = chart.place(point - step);
                    const double scale = length(place->x_gradient) + length(place->y_gradient);
                    CHECK(std::abs((after->x - before->x) / 2 - dot(place->x_gradient, step)) < 1e-8 * scale * h);
                    CHECK(std::abs((after->y - before->y) / 2 - dot(place->y_gradient, step)) < 1e-8 * scale * h);
                }
                const auto m = chart.matrix();
                const auto row = [&](std::size_t i) {
                    return m[4 * i] * point.x + m[4 * i + 1] * point.y + m[4 * i + 2] * point.z + m[4 * i + 3];
                };
                CHECK(row(0) / row(3) == doctest::Approx(x).epsilon(1e-12));
                CHECK(row(1) / row(3) == doctest::Approx(y).epsilon(1e-12));
                CHECK(row(2) == doctest::Approx(place->depth).epsilon(1e-12));
            }
}

} // namespace

TEST_CASE("raster charts: what a line of sight meets lies where it looks, and gradients are derivatives") {
    check_chart(PlaneChart(Vec3(1, 2, 3), Vec3(2, 0.5, 0), Vec3(0.3, 1, 1), 32, 20));
    check_chart(ViewChart(Vec3(3, -2, 1), Vec3(0, 0, 0.5), Vec3(0, 0, 1), 0.8, 32, 20));
    check_chart(LightChart(Vec3(0, 1, 4), Vec3(0.5, 0, 0), 1.5, 32));
    check_chart(LightChart::along(Vec3(1, 2, -3), Vec3(0.5, 0, 0), 1.5, 32));
}

TEST_CASE("raster charts: a plane's corner and edges are those of the raster") {
    const PlaneChart chart(Vec3(1, 2, 3), Vec3(2, 0, 0), Vec3(1, 1, 0), 40, 10);
    const auto place = chart.place({1 + 0.25 * 2 + 0.5, 2 + 0.5, 3});
    REQUIRE(place.has_value());
    CHECK(place->x == doctest::Approx(10));
    CHECK(place->y == doctest::Approx(5));
    CHECK(place->depth == doctest::Approx(0));
    CHECK(place->area_scale({0, 0, 1}) == doctest::Approx(40 * 10 / 2.0)); // texels over the parallelogram's area
}

TEST_CASE("raster charts: what is behind the eye has no place, and the sphere of receivers is in sight") {
    const ViewChart view(Vec3(0, 0, 2), Vec3(0, 0, 0), Vec3(0, 1, 0), 1, 16, 16);
    CHECK(!view.place({0, 0, 2.5}).has_value());
    CHECK(view.place({0, 0, 1}).has_value());
    const LightChart lamp(Vec3(0, 0, 3), Vec3(0, 0, 0), 1, 100),
        sun = LightChart::along(Vec3(0, 0, -1), Vec3(0), 1, 100);
    for (const LightChart& chart : {lamp, sun})
        for (double angle = 0; angle < 6.28; angle += 0.1) {
            const auto place = chart.place({0.999 * std::cos(angle), 0.999 * std::sin(angle), 0});
            REQUIRE(place.has_value());
            CHECK(place->x >= 0);
            CHECK(place->x <= 100);
            CHECK(place->y >= 0);
            CHECK(place->y <= 100);
        }
}

TEST_CASE("raster charts: degenerate ones are refused") {
    CHECK_THROWS_AS(PlaneChart(Vec3(0), Vec3(1, 0, 0), Vec3(2, 0, 0), 4, 4), std::invalid_argument);
    CHECK_THROWS_AS(PlaneChart(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), 0, 4), std::invalid_argument);
    CHECK_THROWS_AS(ViewChart(Vec3(0), Vec3(0, 0, 1), Vec3(0, 0, 1), 1, 4, 4), std::invalid_argument);
    CHECK_THROWS_AS(ViewChart(Vec3(0), Vec3(0, 0, 1), Vec3(0, 1, 0), 3.2, 4, 4), std::invalid_argument);
    CHECK_THROWS_AS(LightChart(Vec3(0), Vec3(0, 0, 1), 1.5, 4), std::invalid_argument);
    CHECK_THROWS_AS((void)LightChart::along(Vec3(0), Vec3(0), 1, 4), std::invalid_argument);
}

} // namespace nephroid::tests::projected_chart_test
