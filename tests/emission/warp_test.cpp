// SPDX-License-Identifier: MIT
#include "nephroid/emission/warp.hpp"

#include "emission/statistics.hpp"
#include "nephroid/emission/cone.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/sphere_direction.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace nephroid::tests::warp_test {

namespace {

using D = glm::dvec3;
constexpr double tau = 2 * std::numbers::pi;

// Counts where a map takes random points; `place` inverts it, by another way, into a square that must be filled evenly.
double chi_square_of(const std::function<std::array<double, 2>(double, double)>& place) {
    constexpr std::size_t n = 8;
    const RandomSequence random(1);
    std::vector<std::size_t> counts(n * n);
    for (std::uint64_t i = 0; i < 64000; ++i) {
        const auto [x, y] = place(random.sample<double>(i, 0), random.sample<double>(i, 1));
        const auto cell = [](double t) { return (std::min)(n - 1, static_cast<std::size_t>(t * double(n))); };
        ++counts[cell(x) * n + cell(y)];
    }
    return tests::chi_square(counts);
}

double turn(double y, double x) { return std::atan2(y, x) / tau + 0.5; }

// |∂m/∂u1 × ∂m/∂u2| by central differences.
double stretch(const std::function<D(double, double)>& map, double u1, double u2) {
    const double h = std::cbrt(std::numeric_limits<double>::epsilon());
    const D d1 = (map(u1 + h, u2) - map(u1 - h, u2)) * (0.5 / h);
    const D d2 = (map(u1, u2 + h) - map(u1, u2 - h)) * (0.5 / h);
    return length(cross(d1, d2));
}

// Calls with points of the square that are off the maps' seams (diagonals, middle lines, the edges) and centre.
void off_the_seams(const std::function<void(double, double)>& visit) {
    const RandomSequence random(2);
    for (std::uint64_t i = 0; i < 400; ++i) {
        const double u1 = random.sample<double>(i, 0), u2 = random.sample<double>(i, 1);
        const double a = std::abs(2 * u1 - 1), b = std::abs(2 * u2 - 1), gap = 0.02;
        if (a > gap && b > gap && a < 1 - gap && b < 1 - gap && std::abs(a - b) > gap && std::abs(a + b - 1) > gap &&
            a + b > 0.2)
            visit(u1, u2);
    }
}

// Truncation: h²/6 times third derivatives, which are below (π/2)³ / r² for the smallest radius r = 0.1 visited,
// and rounding 1/h, both about 1e-16^(2/3); with relative margin 100.
constexpr double slope_tolerance = 5e-9;

const D tilted = normalize(D(1, -2, 0.5));

D cap(double height, double u1, double u2) { return direction_in<D>({tilted, height}, frame_about(tilted), u1, u2); }

D cosine(double u1, double u2) { return cosine_direction(tilted, frame_about(tilted), concentric_disk(u1, u2)); }

} // namespace

TEST_CASE("warp: the concentric disk is filled evenly") {
    const double distance = chi_square_of([](double u1, double u2) -> std::array<double, 2> {
        const auto p = concentric_disk(u1, u2);
        return {p.x * p.x + p.y * p.y, turn(p.y, p.x)};
    });
    CHECK(distance < tests::chi_square_limit(64));
}

TEST_CASE("warp: caps narrow and wide and the whole sphere are filled evenly") {
    for (const double height : {1e-6, 0.3, 1.0, 1.9, 2.0}) {
        CAPTURE(height);
        const double distance = chi_square_of([&](double u1, double u2) -> std::array<double, 2> {
            const D direction = cap(height, u1, u2);
            const Frame<D> frame = frame_about(tilted);
            return {0.5 * length2(D(direction - tilted)) / height,
                    turn(dot(direction, frame.v), dot(direction, frame.u))};
        });
        CHECK(distance < tests::chi_square_limit(64));
    }
}

TEST_CASE("warp: the cosine-weighted hemisphere is filled evenly by its projection") {
    const double distance = chi_square_of([](double u1, double u2) -> std::array<double, 2> {
        const D direction = cosine(u1, u2);
        const Frame<D> frame = frame_about(tilted);
        const double cosine = dot(direction, tilted);
        return {1 - cosine * cosine, turn(dot(direction, frame.v), dot(direction, frame.u))};
    });
    CHECK(distance < tests::chi_square_limit(64));
}

// In a uniformly filled triangle (b1 + b2)² and b2 / (b1 + b2) are independent and uniform.
TEST_CASE("warp: the triangle is filled evenly") {
    const double distance = chi_square_of([](double u1, double u2) -> std::array<double, 2> {
        const auto b = triangle_point(u1, u2);
        return {(b.b1 + b.b2) * (b.b1 + b.b2), b.b2 / (b.b1 + b.b2)};
    });
    CHECK(distance < tests::chi_square_limit(64));
}

TEST_CASE("warp: each map stretches area by the same factor everywhere") {
    off_the_seams([](double u1, double u2) {
        const auto disk = [](double a, double b) { return D(concentric_disk(a, b).x, concentric_disk(a, b).y, 0); };
        CHECK(stretch(disk, u1, u2) == doctest::Approx(std::numbers::pi).epsilon(slope_tolerance));
        const auto triangle = [](double a, double b) { return D(triangle_point(a, b).b1, triangle_point(a, b).b2, 0); };
        CHECK(stretch(triangle, u1, u2) == doctest::Approx(0.5).epsilon(slope_tolerance));
        for (const double height : {0.01, 0.3, 1.0, 1.5, 2.0}) {
            CAPTURE(height);
            const auto sphere = [&](double a, double b) { return cap(height, a, b); };
            // Towards the point opposite to the axis a square root has third derivatives like the -5th power of the
            // cosine of half the angle.
            const double half_cos = std::sqrt(0.5 * (1 + dot(sphere(u1, u2), tilted)));
            CHECK(stretch(sphere, u1, u2) ==
                  doctest::Approx(tau * height).epsilon(slope_tolerance * std::pow(half_cos, -5)));
        }
        const double cos = dot(cosine(u1, u2), tilted);
        // The rim's square root has third derivatives like cos^-5 there, hence the factor.
        CHECK(stretch(cosine, u1, u2) * cos ==
              doctest::Approx(std::numbers::pi).epsilon(slope_tolerance * std::pow(cos, -5)));
    });
}

// By u1 the concentric map has 2 sqrt(1 + π²/16), and onto a hemisphere 2 sqrt(4 + π²/8) at most. The whole
// sphere's angle from the axis is 2 asin r with r = |2 u1 - 1|, steepest at the edge. A jump adds its length.
TEST_CASE("warp: the maps are continuous") {
    constexpr int n = 256;
    constexpr double step = 1.0 / n, steepest = 4.5746;
    const auto check = [&](const std::function<D(double, double)>& map, double bound) {
        double longest = 0;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const double u1 = i * step, u2 = j * step;
                longest = (std::max)({longest, length(D(map(u1 + step, u2) - map(u1, u2))),
                                      length(D(map(u1, u2 + step) - map(u1, u2)))});
            }
        }
        CHECK(longest <= bound * step);
    };
    check([](double a, double b) { return D(concentric_disk(a, b).x, concentric_disk(a, b).y, 0); }, steepest);
    check([](double a, double b) { return D(triangle_point(a, b).b1, triangle_point(a, b).b2, 0); }, steepest);
    check([](double a, double b) { return cap(1.0, a, b); }, steepest);
    check([](double a, double b) { return sphere_direction<D>(a, b); }, 2 * std::acos(1 - 2 * step) / step);
}

TEST_CASE_TEMPLATE("warp: centres and corners and edges go where they belong", T, float, double) {
    using V = glm::vec<3, T>;
    const T epsilon = std::numeric_limits<T>::epsilon();
    const auto centre = concentric_disk(T(0.5), T(0.5));
    CHECK(centre.x == 0);
    CHECK(centre.y == 0);
    const auto corner = concentric_disk(T(1), T(0)); // the diagonal is at 45 degrees
    CHECK(std::abs(corner.x - std::sqrt(T(0.5))) <= 2 * epsilon);
    CHECK(std::abs(corner.y + std::sqrt(T(0.5))) <= 2 * epsilon);

    for (const T u1 : {T(0), T(0.25), T(0.5), T(1) - epsilon, T(1)}) {
        for (const T u2 : {T(0), T(0.25), T(0.5), T(1) - epsilon, T(1)}) {
            CHECK(std::abs(length(sphere_direction<V>(u1, u2)) - 1) <= 8 * epsilon);
            const V up(0, 0, 1);
            const Frame<V> frame = frame_about(up);
            for (const T height : {T(1e-12), T(0.5), T(1), T(2)})
                CHECK(std::abs(length(cap_direction(up, frame, height, concentric_disk(u1, u2))) - 1) <= 8 * epsilon);
            const V low = cosine_direction(up, frame, concentric_disk(u1, u2));
            CHECK(std::abs(length(low) - 1) <= 8 * epsilon);
            CHECK(low.z >= std::sqrt(epsilon) * (1 - epsilon));
            const auto b = triangle_point(u1, u2);
            CHECK(b.b1 >= 0);
            CHECK(b.b2 >= 0);
            CHECK(b.b1 + b.b2 <= 1);
        }
    }
    CHECK(sphere_direction<V>(T(0.5), T(0.5)).z == 1);
    CHECK(sphere_direction<V>(T(0), T(0)).z <= -1 + 4 * epsilon);
}

// A cone of half angle a has height a²/2: its rim is a from the axis, to a few roundings, however small a is.
TEST_CASE_TEMPLATE("warp: the narrowest cone keeps its shape", T, float, double) {
    using V = glm::vec<3, T>;
    for (const T angle : {T(1e-3), T(1e-6), T(1e-12)}) {
        const T sine = std::sin(T(0.5) * angle), height = 2 * sine * sine;
        const V rim = direction_in<V>({V(0, 0, 1), height}, frame_about(V(0, 0, 1)), T(1), T(0.5));
        CHECK(std::abs(rim.x - std::sin(angle)) <= 8 * std::numeric_limits<T>::epsilon() * angle);
        CHECK(rim.y == 0);
    }
}

} // namespace nephroid::tests::warp_test
