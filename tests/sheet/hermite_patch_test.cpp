// SPDX-License-Identifier: MIT
#include "nephroid/sheet/hermite_patch.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::hermite_patch_test {

using namespace nephroid::detail;

namespace {

/// A patch of a map with these derivatives.
template <class Map, class Change>
[[nodiscard]] PatchCorners corners_of(const Map& map, const Change& along_u, const Change& along_v) {
    PatchCorners corners;
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            corners[i][j] = {map(double(i), double(j)), along_u(double(i), double(j)), along_v(double(i), double(j))};
    return corners;
}

} // namespace

TEST_CASE("Hermite patch: cubics along each axis and u²v, uv² are reproduced exactly") {
    const auto map = [](double u, double v) {
        return Double3{u * u * u - 2 * v + u * u * v, v * v * v + 3 * u * v * v, 1 + u * v - u};
    };
    using Change = Double3 (*)(double, double);
    const Change along_u = [](double u, double v) { return Double3{3 * u * u + 2 * u * v, 3 * v * v, v - 1}; };
    const Change along_v = [](double u, double v) { return Double3{-2 + u * u, 3 * v * v + 6 * u * v, u}; };
    const HermitePatch patch(corners_of(map, along_u, along_v));
    for (double u = 0; u <= 1; u += 0.125)
        for (double v = 0; v <= 1; v += 0.125)
            CHECK(length(patch(u, v) - map(u, v)) <= 1e-14); // numbers up to 4, some twenty roundings
}

TEST_CASE("Hermite patch: neighbours share the curve between them") {
    PatchCorners left{};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            left[i][j] = {{double(i) + 0.1 * double(j), double(j), 0.3 * double(i * j)},
                          {1.2, 0.3 * double(j), 0.1},
                          {0.2 * double(i), 0.9, -0.4}};
    PatchCorners right = left;
    for (std::size_t j = 0; j < 2; ++j) {
        right[0][j] = left[1][j];
        right[1][j].position = left[1][j].position + Double3{1.5, 0.2, 0.1};
        right[1][j].along_u = {0.4, 0.5, 0.6};
    }
    const HermitePatch a(left), b(right);
    for (double v = 0; v <= 1; v += 0.25)
        CHECK(length(a(1, v) - b(0, v)) <= 1e-15);
}

} // namespace nephroid::tests::hermite_patch_test
