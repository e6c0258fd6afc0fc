// SPDX-License-Identifier: MIT
#include "common/shapes.hpp"

#include "examples/worlds.hpp"

#include "nephroid/vector/frame.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace nephroid::examples::shapes_test {

using namespace nephroid::examples::testing;
using nephroid::dot;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Real real_pi = std::numbers::pi_v<Real>;

template <class T>
constexpr Real epsilon = Real(std::numeric_limits<T>::epsilon());

/// A surface as the zeros of a function whose gradient has about unit length there, and points up or outwards.
struct Implicit {
    std::function<Real(const RealVec3&)> value;

    /// By central difference; its error is below 1e-11 for functions of order one.
    [[nodiscard]] RealVec3 normal(const RealVec3& p) const {
        const Real h = 1e-6L;
        RealVec3 g;
        for (int axis = 0; axis < 3; ++axis) {
            RealVec3 d(0);
            d[axis] = h;
            g[axis] = (value(p + d) - value(p - d)) / (2 * h);
        }
        return g / norm(g);
    }
};

/// Checks a hit against the surface it is said to lie on: its place, its normal, and how that changes.
template <class T>
void check_hit(const Hit<T>& hit, const Ray<T>& ray, const Implicit& surface) {
    const RealVec3 p(hit.position);
    CHECK(std::abs(surface.value(p)) <= Real(hit.position_error));
    const RealVec3 normal = surface.normal(p);
    CHECK(norm(RealVec3(hit.geometric_normal) - normal) < 16 * epsilon<T> + 1e-9L);
    CHECK(hit.shading_normal == hit.geometric_normal);
    // The refined position is the ray's: distances are of order 10, so is the rounding of the ray itself.
    CHECK(norm(RealVec3(ray.origin) + Real(hit.distance) * RealVec3(ray.direction) - p) < 64 * epsilon<T>);

    // Two steps of h along a tangent; the position leaves the surface by h² only. The error is h² times the normal's
    // third derivative, for the wave amplitude · (2π √5)⁴ / 6 = 260: below 3e-8; the inner difference adds 1e-13
    // / h.
    const auto frame = nephroid::frame_about(hit.geometric_normal);
    for (const Vec3<T>& tangent : {frame.u, frame.v}) {
        const Real h = 1e-5L;
        const RealVec3 d = h * RealVec3(tangent);
        const RealVec3 expected = (surface.normal(p + d) - surface.normal(p - d)) / (2 * h);
        CHECK(norm(RealVec3(hit.curvature(tangent)) - expected) < 64 * epsilon<T> + 1e-7L);
    }
}

template <class T>
Ray<T> ray_towards(const Vec3<T>& origin, const Vec3<T>& aim) {
    return {origin, nephroid::normalize(Vec3<T>(aim - origin))};
}

/// Hits a shape with random rays, checks the hits, and that what leaves them does not come back to the same point.
/// @return how many hits there were
template <class T, class Shape>
int hit_at_random(const Shape& shape, const Implicit& surface, double spread, unsigned seed) {
    Numbers numbers(seed);
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const Ray<T> ray = ray_towards(numbers.point<T>(-4, 4), numbers.point<T>(-spread, spread));
        const auto found = shape.nearest(ray, infinity);
        if (!found)
            continue;
        ++hits;
        const Hit<T> hit = shape.hit(ray, *found);
        check_hit(hit, ray, surface);
        CHECK(!shape.nearest(ray, found->distance));
        const T off = dot(ray.direction, hit.geometric_normal) > T(0) ? T(2) : T(-2);
        const Ray<T> onward{hit.position + off * hit.position_error * hit.geometric_normal, ray.direction};
        if (const auto next = shape.nearest(onward, infinity))
            CHECK(next->distance > 1e-3); // a chord so short is improbable, a hit on the same point is shorter
    }
    return hits;
}

} // namespace

TEST_CASE_TEMPLATE("sphere: hits lie on it with its normal and curvature", T, float, double) {
    const Vec3<T> centre(T(0.5), T(-0.25), T(0.75));
    const T radius = T(1.5);
    const Implicit surface{[&](const RealVec3& p) { return norm(p - RealVec3(centre)) - Real(radius); }};
    CHECK(hit_at_random<T>(Sphere<T>(centre, radius), surface, 1.5, 1) > 500);
}

TEST_CASE_TEMPLATE("sphere: a ray from within hits the other side at the chord's length", T, float, double) {
    const Sphere<T> sphere({0, 0, 0}, 2);
    const auto found = sphere.nearest({{0, 0, -1}, {0, 0, 1}}, infinity);
    REQUIRE(found.has_value());
    CHECK(found->distance == 3);
    CHECK(!sphere.nearest({{0, 0, 3}, {0, 0, 1}}, infinity));
    CHECK(!sphere.nearest({{T(2.001), 0, -5}, {0, 0, 1}}, infinity));
}

TEST_CASE_TEMPLATE("sphere: far away and small it is still hit to the rounding of its coordinates", T, float, double) {
    const T far = 1000;
    const Vec3<T> centre(far, -far, far);
    const Sphere<T> sphere(centre, T(0.5));
    Numbers numbers(3);
    for (int i = 0; i < 300; ++i) {
        const Ray<T> ray = ray_towards(numbers.point<T>(-1, 1), Vec3<T>(centre + numbers.point<T>(-0.2, 0.2)));
        const auto found = sphere.nearest(ray, infinity);
        REQUIRE(found.has_value());
        const Hit<T> hit = sphere.hit(ray, *found);
        CHECK(std::abs(norm(RealVec3(hit.position) - RealVec3(centre)) - 0.5L) <= Real(hit.position_error));
        CHECK(Real(hit.position_error) < 64 * epsilon<T> * Real(far));
    }
}

TEST_CASE_TEMPLATE("cylinder: hits lie on it with its normal and curvature", T, float, double) {
    const Implicit surface{[](const RealVec3& p) {
        const Real x = p.x - 0.5L, y = p.y + 0.25L;
        return std::sqrt(x * x + y * y) - 1.5L;
    }};
    const Cylinder<T> tube({.base = {T(0.5), T(-0.25), -1}, .radius = T(1.5), .height = 2});
    CHECK(hit_at_random<T>(tube, surface, 1.5, 2) > 400);
}

TEST_CASE_TEMPLATE("cylinder: a half one is hit within its heights and its angle alone", T, float, double) {
    const Cylinder<T> ring({.radius = 1, .height = T(0.5), .facing_x = 1, .least_cosine = 0});
    const auto distance = [&](const Ray<T>& ray) {
        return ring.nearest(ray, infinity).value_or(Candidate<T>{-1}).distance;
    };
    CHECK(distance({{-3, 0, T(0.25)}, {1, 0, 0}}) == 4); // through the open side onto the inner one
    CHECK(distance({{3, 0, T(0.25)}, {-1, 0, 0}}) == 2); // the outer side
    CHECK(distance({{0, 0, T(0.25)}, {-1, 0, 0}}) == -1);
    CHECK(distance({{-3, 0, T(0.51)}, {1, 0, 0}}) == -1);
    CHECK(distance({{-3, 0, T(-0.01)}, {1, 0, 0}}) == -1);
    CHECK(distance({{0, 0, T(0.25)}, {0, 1, 0}}) == 1);  // the angle's end belongs to it
    CHECK(distance({{0, 0, T(0.25)}, {0, 0, 1}}) == -1); // along the axis
    const Cylinder<T> full({.radius = 1, .height = T(0.5)});
    CHECK(full.nearest({{0, 0, T(0.25)}, {-1, 0, 0}}, infinity).has_value());
}

TEST_CASE_TEMPLATE("quad: hits lie in it and nothing beyond its edges is hit", T, float, double) {
    const Vec3<T> corner(-1, -1, T(0.5)), u(2, 0, T(0.5)), v(T(0.5), 2, 0);
    const Quad<T> quad(corner, u, v);
    const RealVec3 face = glm::cross(RealVec3(u), RealVec3(v));
    const RealVec3 normal = face / norm(face);
    const Implicit surface{[&](const RealVec3& p) { return glm::dot(p - RealVec3(corner), normal); }};
    CHECK(hit_at_random<T>(quad, surface, 1, 4) > 300);
    const auto at = [&](double a, double b) { return Vec3<T>(corner + T(a) * u + T(b) * v); };
    const Vec3<T> eye(T(0.3), T(0.2), 4);
    for (const double inside : {0.01, 0.5, 0.99})
        CHECK(quad.nearest(ray_towards(eye, at(inside, 0.3)), infinity).has_value());
    for (const double outside : {-0.01, 1.01}) {
        CHECK(!quad.nearest(ray_towards(eye, at(outside, 0.3)), infinity));
        CHECK(!quad.nearest(ray_towards(eye, at(0.3, outside)), infinity));
    }
}

TEST_CASE_TEMPLATE("disk: hits lie in it and nothing beyond its rim is hit", T, float, double) {
    const Vec3<T> centre(T(0.25), 0, T(0.5)), normal(1, 2, 3);
    const Disk<T> disk(centre, normal, T(1.5));
    const RealVec3 n = RealVec3(normal) / norm(RealVec3(normal));
    const Implicit surface{[&](const RealVec3& p) { return glm::dot(p - RealVec3(centre), n); }};
    CHECK(hit_at_random<T>(disk, surface, 1, 5) > 300);
    const Vec3<T> across = nephroid::frame_about(nephroid::normalize(normal)).u;
    const Vec3<T> eye(1, 1, 5);
    CHECK(disk.nearest(ray_towards(eye, Vec3<T>(centre + T(1.49) * across)), infinity).has_value());
    CHECK(!disk.nearest(ray_towards(eye, Vec3<T>(centre + T(1.51) * across)), infinity));
    for (int i = 0; i < 8; ++i) { // its box holds its rim
        const auto frame = nephroid::frame_about(nephroid::normalize(normal));
        const T phi = T(i);
        const Vec3<T> p = centre + T(1.5) * (std::cos(phi) * frame.u + std::sin(phi) * frame.v);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(p[axis] >= disk.bounds().min[axis]);
            CHECK(p[axis] <= disk.bounds().max[axis]);
        }
    }
}

TEST_CASE_TEMPLATE("floor: a hit is wrapped into the first period and its distance is not", T, float, double) {
    const Floor<T> floor(T(0.25), 1), plain(T(0.25));
    const Ray<T> ray{{T(-3.25), T(2.75), T(1.25)}, {0, 0, -1}};
    const auto found = floor.nearest(ray, infinity);
    REQUIRE(found.has_value());
    CHECK(found->distance == 1);
    CHECK(floor.hit(ray, *found).position == Vec3<T>(T(0.75), T(0.75), T(0.25)));
    CHECK(plain.hit(ray, *found).position == Vec3<T>(T(-3.25), T(2.75), T(0.25)));
    CHECK(!floor.bounds().is_finite());
    CHECK(!floor.nearest({{0, 0, 1}, {1, 0, 0}}, infinity));
    // What is less than a rounding below zero must not come out as the period itself.
    const Ray<T> seam{{-std::numeric_limits<T>::denorm_min(), 0, 1}, {0, 0, -1}};
    const T x = floor.hit(seam, floor.nearest(seam, infinity).value()).position.x;
    CHECK(x >= T(0));
    CHECK(x < T(1));
}

TEST_CASE_TEMPLATE("wave: hits lie on it with its normal and curvature", T, float, double) {
    const T amplitude = T(0.04);
    const SineWave<T> wave({.height = 1, .amplitude = amplitude});
    const Implicit surface{
        [&](const RealVec3& p) { return p.z - 1 - Real(amplitude) * std::sin(2 * real_pi * (2 * p.x + p.y)); }};
    Numbers numbers(6);
    for (int i = 0; i < 1000; ++i) {
        const Vec3<T> origin = numbers.point<T>(-1, 1) + Vec3<T>(0, 0, i % 2 == 0 ? T(2.5) : T(-0.5));
        Ray<T> ray{origin, numbers.direction<T>()};
        if ((ray.direction.z > 0) == (i % 2 == 0))
            ray.direction = -ray.direction;
        if (std::abs(ray.direction.z) < T(0.2))
            continue;
        const auto found = wave.nearest(ray, infinity);
        REQUIRE(found.has_value());
        const Hit<T> hit = wave.hit(ray, *found);
        check_hit(hit, ray, surface);
    }
}

// Oracle: the sign of the height above the surface, every 1/1000 unit, at least 200 times a wave, in long double.
// A crossing and its counterpart closer than that may be missed by the oracle, so the found one may then be earlier.
TEST_CASE_TEMPLATE("wave: the first crossing is the one that marching finds", T, float, double) {
    Numbers numbers(7);
    int hits = 0, misses = 0;
    for (int i = 0; i < 120; ++i) {
        const T amplitude = T(numbers(0.005, 0.2)), kx = T(numbers(-3, 3)),
                ky = T(numbers(-3, 3)); // waves of at least 0.23
        const SineWave<T> wave({.height = 1, .amplitude = amplitude, .kx = kx, .ky = ky});
        const auto above = [&](const RealVec3& p) {
            return p.z - 1 - Real(amplitude) * std::sin(2 * real_pi * (Real(kx) * p.x + Real(ky) * p.y));
        };
        Ray<T> ray{numbers.point<T>(-1, 1) + Vec3<T>(0, 0, T(1) + T(numbers(-1, 1)) * amplitude),
                   numbers.direction<T>()};
        ray.direction.z *= i % 4 == 0 ? T(1) : T(0.03); // mostly grazing
        ray.direction = nephroid::normalize(ray.direction);
        if (i % 5 == 0)
            ray.origin.z += T(1.5);

        const RealVec3 o(ray.origin), d(ray.direction);
        const Real start = above(o), reach = 25, step = 1.0L / 1000;
        Real crossing = reach;
        for (Real t = step; t < reach; t += step)
            if ((above(o + t * d) > 0) != (start > 0)) {
                crossing = t;
                break;
            }
        const auto found = wave.nearest(ray, double(reach));
        if (crossing < reach) {
            REQUIRE(found.has_value());
            ++hits;
            CHECK(found->distance <= double(crossing) + 1e-12);
            if (found->distance < double(crossing - step)) // only by touching: the surface is left again at once
                CHECK(std::abs(above(o + (Real(found->distance) + step) * d)) < 20 * step * step);
        } else if (!found) {
            ++misses;
        }
        if (found) // the residual is that of double, at a slope of up to about 4
            CHECK(std::abs(above(o + Real(found->distance) * d)) < 1e-13L);
    }
    CHECK(hits > 30);
    CHECK(misses > 10);
}

// At a slope of 1e-5 the ray passes over thousands of waves before its height is below a crest.
TEST_CASE("wave: a grazing ray finds its crest after thousands of waves") {
    const double a = 0.04, slope = 1e-5;
    const SineWave<double> wave({.height = 1, .amplitude = a, .kx = 1, .ky = 0});
    const double down = std::sqrt(1 - slope * slope);
    const Ray<double> ray{{0, 0, 1.3}, {down, 0, -slope}};
    const auto found = wave.nearest(ray, infinity);
    REQUIRE(found.has_value());
    // It meets a crest, x = 1/4 + k, at the first k where 1.3 − slope x falls below 1.04 (to within the crest's
    // flatness: the ray's fall over a quarter of a wave is 2.5e-6).
    const double x = found->distance * down, k = std::ceil((0.26 / slope) - 0.25);
    CHECK(std::abs(x - (k + 0.25)) < 0.25);
    CHECK(std::abs(1.3 - slope * found->distance - 1 - a * std::sin(2 * std::numbers::pi * x)) < 1e-9); // x is 3e4
    CHECK(!wave.nearest({{0, 0, 1.3}, {1, 0, 0}}, infinity));
    CHECK(!wave.nearest({{0, 0, 1.3}, {down, 0, slope}}, infinity));
}

TEST_CASE_TEMPLATE("wave: rays leave the surface they start on", T, float, double) {
    const SineWave<T> wave({.height = 1, .amplitude = T(0.04)});
    Numbers numbers(8);
    for (int i = 0; i < 2000; ++i) {
        const Ray<T> down{numbers.point<T>(-5, 5) + Vec3<T>(0, 0, 7), {0, 0, -1}};
        const Hit<T> hit = wave.hit(down, wave.nearest(down, infinity).value());
        const Vec3<T> off = T(2) * hit.position_error * hit.geometric_normal;
        // Steeper than the waves' steepest slope, 2π √5 · 0.04 = 0.56, there is no second crossing.
        const Vec3<T> tilted = nephroid::normalize(Vec3<T>(T(numbers(-0.7, 0.7)), T(numbers(-0.7, 0.7)), T(1)));
        CHECK(!wave.nearest({hit.position + off, tilted}, infinity));
        CHECK(!wave.nearest({hit.position - off, -tilted}, infinity));
    }
}

TEST_CASE_TEMPLATE("wave: a rectangle of it is hit within its sides alone", T, float, double) {
    const SineWave<T> wave({.height = 1, .amplitude = T(0.04), .x_min = -1, .x_max = 2, .y_min = 0, .y_max = 1});
    CHECK(wave.bounds().is_finite());
    const auto hits = [&](T x, T y) { return wave.nearest({{x, y, 3}, {0, 0, -1}}, infinity).has_value(); };
    CHECK(hits(T(-0.99), T(0.01)));
    CHECK(hits(T(1.99), T(0.99)));
    CHECK(!hits(T(-1.01), T(0.5)));
    CHECK(!hits(T(2.01), T(0.5)));
    CHECK(!hits(0, T(-0.01)));
    CHECK(!hits(0, T(1.01)));
    // It enters below the surface, over the side: the first crossing is from below.
    const Ray<T> from_below{{-2, T(0.5), T(0.5)}, nephroid::normalize(Vec3<T>(1, 0, T(0.3)))};
    const auto found = wave.nearest(from_below, infinity);
    REQUIRE(found.has_value());
    CHECK(std::abs(from_below.origin.z + T(found->distance) * from_below.direction.z - 1) < T(0.05));
}

TEST_CASE_TEMPLATE("wave: without amplitude it is a plane", T, float, double) {
    const SineWave<T> wave({.height = 1, .amplitude = 0});
    const Ray<T> ray{{T(0.3), T(0.4), 3}, {0, 0, -1}};
    const auto found = wave.nearest(ray, infinity);
    REQUIRE(found.has_value());
    CHECK(std::abs(found->distance - 2) < 1e-14);
    CHECK(wave.hit(ray, *found).geometric_normal == Vec3<T>(0, 0, 1));
    CHECK(!wave.nearest({{0, 0, 3}, {1, 0, 0}}, infinity));
}

} // namespace nephroid::examples::shapes_test
