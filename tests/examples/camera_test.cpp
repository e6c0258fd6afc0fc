// SPDX-License-Identifier: MIT
#include "common/camera.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <utility>

namespace nephroid::examples::camera_test {

namespace {

template <class T>
constexpr T rounding = 8 * std::numeric_limits<T>::epsilon();

template <class T>
typename Camera<T>::Pose looking_down() {
    return {{1, 2, 5}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
}

template <class T>
bool close(const Vec3<T>& a, const Vec3<T>& b) {
    return nephroid::length(Vec3<T>(a - b)) <= rounding<T> * (1 + nephroid::length(b));
}

struct Grid {
    unsigned n, columns, rows;
};

} // namespace

TEST_CASE_TEMPLATE("camera: a pinhole's rays fan out by its vertical angle", T, float, double) {
    const T angle = T(0.8), t = std::tan(angle / 2);
    const auto camera = Camera<T>::perspective(looking_down<T>(), angle, 200, 100);
    CHECK(camera.width() == 200);
    CHECK(camera.height() == 100);
    CHECK(close(camera.ray(100, 50).direction, Vec3<T>(0, 0, -1)));
    CHECK(close(camera.ray(100, 100).direction, nephroid::normalize(Vec3<T>(0, t, -1)))); // the upper edge
    CHECK(close(camera.ray(100, 0).direction, nephroid::normalize(Vec3<T>(0, -t, -1))));
    CHECK(close(camera.ray(200, 50).direction, nephroid::normalize(Vec3<T>(2 * t, 0, -1)))); // pixels are square
    CHECK(camera.ray(13, 87).origin == Vec3<T>(1, 2, 5));
}

TEST_CASE_TEMPLATE("camera: an orthographic one's rays are parallel and span its film", T, float, double) {
    const auto camera = Camera<T>::orthographic(looking_down<T>(), T(0.5), 64, 32);
    for (const auto& [x, y] : {std::pair<T, T>{0, 0}, {64, 32}, {16, 8}})
        CHECK(camera.ray(x, y).direction == Vec3<T>(0, 0, -1));
    CHECK(close(camera.ray(0, 0).origin, Vec3<T>(0, T(1.5), 5)));
    CHECK(close(camera.ray(64, 32).origin, Vec3<T>(2, T(2.5), 5)));
}

// Straight down onto a floor 5 below a pinhole a pixel is 5 times as large as on the film, wherever it lies there. The
// rays' directions are rounded, which the floor shows by 5 over the cosine squared, two for each side.
TEST_CASE_TEMPLATE("camera: what a part of the film sees of a floor is the film's part enlarged", T, float, double) {
    const T angle = T(0.8), pixel = 2 * std::tan(angle / 2) / 100;
    const auto camera = Camera<T>::perspective(looking_down<T>(), angle, 200, 100);
    for (const auto& [x, y] : {std::pair<T, T>{100, 50}, {T(3.5), T(99.5)}, {T(150.25), T(20.75)}}) {
        const Ray<T> ray = camera.ray(x, y);
        const Vec3<T> position = ray.origin + (5 / -ray.direction.z) * ray.direction;
        const auto seen = camera.footprint(x, y, T(0.5), T(1), position, {0, 0, 1});
        const T tolerance = 40 * rounding<T>;
        CHECK(nephroid::length(Vec3<T>(seen.u - Vec3<T>(T(2.5) * pixel, 0, 0))) <= tolerance);
        CHECK(nephroid::length(Vec3<T>(seen.v - Vec3<T>(0, 5 * pixel, 0))) <= tolerance);
    }
}

TEST_CASE("camera: what is no film and no angle is refused") {
    const auto pose = looking_down<float>();
    CHECK_THROWS_AS(static_cast<void>(Camera<float>::perspective(pose, 0.5f, 0, 10)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Camera<float>::perspective(pose, 3.2f, 10, 10)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Camera<float>::perspective(pose, 0.0f, 10, 10)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Camera<float>::orthographic(pose, 0.0f, 10, 10)), std::invalid_argument);
}

TEST_CASE_TEMPLATE("camera: a pixel's only sample is its centre", T, float, double) {
    const auto at = pixel_sample<T>(77, 0, 1, 5);
    CHECK(at.x == T(0.5));
    CHECK(at.y == T(0.5));
}

TEST_CASE_TEMPLATE("camera: a pixel's samples lie in the cells of a grid and differ from pixel to pixel", T, float,
                   double) {
    for (const auto& [n, columns, rows] : {Grid{4, 2, 2}, {6, 3, 2}, {7, 7, 1}, {16, 4, 4}}) {
        std::set<std::pair<int, int>> cells;
        for (unsigned k = 0; k < n; ++k) {
            const auto at = pixel_sample<T>(3, k, n, 9);
            CHECK(at.x >= 0);
            CHECK(at.y >= 0);
            CHECK(at.x <= 1);
            CHECK(at.y <= 1);
            cells.insert({int(at.x * T(columns)), int(at.y * T(rows))});
            CHECK(at.x != pixel_sample<T>(4, k, n, 9).x);
            CHECK(at.x != pixel_sample<T>(3, k, n, 10).x);
        }
        CHECK(cells.size() == n);
    }
}

} // namespace nephroid::examples::camera_test
