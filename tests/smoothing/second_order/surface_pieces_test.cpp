// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/surface_pieces.hpp"

#include "nephroid/sequence/halton.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/sphere_direction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

namespace nephroid::tests::surface_pieces_test {

using namespace nephroid::detail;

namespace {

using Pieces = SurfacePieces<glm::dvec3>;

SerialExecutor serial;
const TaskRunner one_by_one(serial);

/// @param surface  surface(u, v) -> PlaceOnSurface
template <class Surface>
[[nodiscard]] std::vector<PlaceOnSurface> points_on(const Surface& surface, std::size_t count = 4000) {
    const HaltonSequence sequence;
    std::vector<PlaceOnSurface> points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back(surface(sequence.sample<double>(i, 0), sequence.sample<double>(i, 1)));
    return points;
}

constexpr Double3 up{0, 0, 1};

/// The points of two pieces, each as a half: piece 0 or 1 by where a point lies.
template <class IsFirst>
void check_halves(const std::vector<PlaceOnSurface>& points, const IsFirst& is_first) {
    const Pieces pieces(points, one_by_one);
    REQUIRE(pieces.sizes().size() == 2);
    for (std::size_t i = 1; i < points.size(); ++i)
        CHECK((pieces[i] == pieces[0]) == (is_first(points[i]) == is_first(points[0])));
}

} // namespace

TEST_CASE("surface pieces: smooth surfaces are whole") {
    CHECK(Pieces(points_on([](double u, double v) {
                     return PlaceOnSurface{{u, v, 0}, up};
                 }),
                 one_by_one)
              .sizes() == std::vector<std::uint32_t>{4000});
    const auto ball = [](double u, double v) {
        const Double3 n = double3(sphere_direction<glm::dvec3>(u, v));
        return PlaceOnSurface{0.3 * n, n};
    };
    CHECK(Pieces(points_on(ball), one_by_one).sizes() == std::vector<std::uint32_t>{4000});
    const auto wave = [](double u, double v) { // slopes up to 0.5, as those of water
        const double slope = 0.5 * std::cos(40 * u), steep = std::hypot(1.0, slope);
        return PlaceOnSurface{{u, v, 0.0125 * std::sin(40 * u)}, {-slope / steep, 0, 1 / steep}};
    };
    CHECK(Pieces(points_on(wave), one_by_one).sizes() == std::vector<std::uint32_t>{4000});
}

// 4000 points on a unit square are 0.016 apart.
TEST_CASE("surface pieces: a step, an edge and a ball above a floor separate them") {
    check_halves(points_on([](double u, double v) {
                     return PlaceOnSurface{{u, v, u < 0.4 ? 0.01 : 0}, up};
                 }),
                 [](const PlaceOnSurface& p) { return p.position.x < 0.4; });
    check_halves(points_on([](double u, double v) {
                     return u < 0.4 ? PlaceOnSurface{{u, v, 0}, up} : PlaceOnSurface{{0.4, v, u - 0.4}, {-1, 0, 0}};
                 }),
                 [](const PlaceOnSurface& p) { return p.normal.z > 0.5; });
    check_halves(points_on([](double u, double v) {
                     const double x = 2 * u - 1, y = 2 * v - 1, rest = 0.25 - x * x - y * y;
                     if (!(rest > 0))
                         return PlaceOnSurface{{x, y, 0}, up};
                     const Double3 n = 2 * Double3{x, y, std::sqrt(rest)};
                     return PlaceOnSurface{{x, y, 1 + std::sqrt(rest)}, n};
                 }),
                 [](const PlaceOnSurface& p) { return p.position.z > 0.5; });
}

TEST_CASE("surface pieces: a further point gets the piece of its neighbours or none") {
    const Pieces pieces(points_on([](double u, double v) {
                            return PlaceOnSurface{{u, v, u < 0.4 ? 0.5 : 0}, up};
                        }),
                        one_by_one);
    REQUIRE(pieces.sizes().size() == 2);
    CHECK(pieces.piece_at({{0.7, 0.5, 0}, up}) == 0); // the larger one
    CHECK(pieces.piece_at({{0.2, 0.5, 0.5}, up}) == 1);
    CHECK(pieces.piece_at({{0.2, 0.5, 0.25}, up}) == Pieces::unknown);
    CHECK(pieces.piece_at({{0.7, 0.5, 0}, {0, 0, -1}}) == Pieces::unknown);
}

} // namespace nephroid::tests::surface_pieces_test
