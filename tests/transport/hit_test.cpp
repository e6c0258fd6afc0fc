// SPDX-License-Identifier: MIT
#include "nephroid/transport/hit.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::hit_test {

using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

using V = glm::vec3;

/// The least that a hit may be.
struct Least {
    float distance;
    V geometric_normal;
    Flat curvature;
};

/// A renderer's own: members are properties of its own types that convert.
struct Converts {
    double distance;
    struct Normal {
        operator V() const { return {0, 0, 1}; }
    } geometric_normal;
    ShapeOperator<V> curvature;
    V position, shading_normal;
    float position_error;
};

struct WithoutCurvature {
    float distance;
    V geometric_normal;
    V position;
};
struct WithoutNormal {
    float distance;
    Flat curvature;
};
struct WithoutDistance {
    V geometric_normal;
    Flat curvature;
};
struct CurvatureIsANumber {
    float distance;
    V geometric_normal;
    float curvature;
};

static_assert(Hit<Least, V> && Hit<Converts, V>);
static_assert(Hit<SurfaceHit<V, Flat>, V>);
static_assert(Hit<SurfaceHit<V, ShapeOperator<V>>, V>);
static_assert(Hit<SurfaceHit<V, AnyCurvature<Flat, ParametricCurvature<V>, InterpolatedCurvature<V>>>, V>);
static_assert(Hit<SurfaceHit<foreign::Plain<double>, Flat>, foreign::Plain<double>>);

// What is missing has a name of its own in the compiler's message.
static_assert(!HasCurvature<WithoutCurvature, V> && !Hit<WithoutCurvature, V>);
static_assert(!HasCurvature<CurvatureIsANumber, V> && !Hit<CurvatureIsANumber, V>);
static_assert(!HasGeometricNormal<WithoutNormal, V> && !Hit<WithoutNormal, V>);
static_assert(!HasDistance<WithoutDistance, V> && !Hit<WithoutDistance, V>);
static_assert(!Hit<int, V> && !Hit<Least, int> && !Hit<Least, foreign::Plain<float>>);

static_assert(HasPosition<SurfaceHit<V, Flat>, V> && !HasPosition<Least, V>);
static_assert(HasShadingNormal<SurfaceHit<V, Flat>, V> && !HasShadingNormal<Least, V>);
static_assert(HasPositionError<SurfaceHit<V, Flat>, V> && !HasPositionError<Least, V>);

} // namespace

// origin + distance * direction on a plane, the distance rounded a few times as an intersection routine does.
TEST_CASE_TEMPLATE("rounding_error: bounds how far a computed hit is from its plane", T, float, double) {
    tests::for_each_vector<T>([]<class U>() {
        Draws draw(51);
        for (int i = 0; i < 300; ++i) {
            const double scale = std::pow(10.0, draw.in(-3, 5));
            const U origin = tests::narrow<U>(Wide(scale) * draw.in_cube());
            const U on_plane = tests::narrow<U>(Wide(scale) * draw.in_cube()),
                    normal = tests::narrow<U>(draw.direction());
            const U direction = tests::narrow<U>((tests::widen(on_plane) - tests::widen(origin)).unit());
            const T cosine = dot(normal, direction);
            if (std::abs(double(cosine)) < 0.05)
                continue;
            const T distance = dot(normal, U(on_plane - origin)) / cosine;
            const U position = origin + distance * direction;
            const Space n = tests::widen(normal);
            const Wide off = n.dot(tests::widen(position) - tests::widen(on_plane)) / n.length();
            const T bound = rounding_error(origin, distance, position);
            CHECK(abs(off) <= Wide(bound));
            // And is no more than it needs to be: eight roundings of three numbers.
            CHECK(double(bound) <= 8 * double(std::numeric_limits<T>::epsilon()) * (4 + 1) * scale * 1.75);
        }
        CHECK(rounding_error(make_vector<U>(-7, 1, 2), T(3), make_vector<U>(1, -2, 5)) ==
              8 * std::numeric_limits<T>::epsilon() * (7 + 5 + 3));
    });
}

} // namespace nephroid::tests::hit_test
