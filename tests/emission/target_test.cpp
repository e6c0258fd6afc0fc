// SPDX-License-Identifier: MIT
#include "nephroid/emission/target.hpp"

#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/sphere_direction.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace nephroid::tests::target_test {

namespace {

// Wide enough to be exact next to T.
template <class T>
using Wide = std::conditional_t<std::is_same_v<T, float>, double, long double>;

// 1 − cos of the sphere's half angle, in wider arithmetic from the same numbers; 2 inside.
template <class T>
Wide<T> exact_height(const BoundingSphere<glm::vec<3, T>>& sphere, const glm::vec<3, T>& from) {
    using W = Wide<T>;
    const W x = W(sphere.centre.x) - W(from.x), y = W(sphere.centre.y) - W(from.y), z = W(sphere.centre.z) - W(from.z);
    const W distance2 = x * x + y * y + z * z, sine2 = W(sphere.radius) * W(sphere.radius) / distance2;
    return sine2 < 1 ? sine2 / (1 + std::sqrt(1 - sine2)) : W(2);
}

} // namespace

TEST_CASE_TEMPLATE("target: a bounding sphere holds its points and is at most sqrt 3 too large", T, float, double) {
    using V = glm::vec<3, T>;
    const RandomSequence random(3);
    for (const T offset : {T(0), T(1e5)}) {
        for (const T size : {T(1e-4), T(1), T(1e6)}) {
            std::vector<V> points;
            for (std::uint64_t i = 0; i < 50; ++i)
                points.push_back(V(offset) +
                                 size * V(random.sample<T>(i, 0), random.sample<T>(i, 1), random.sample<T>(i, 2)));
            const auto sphere = bounding_sphere(points);
            T furthest = 0;
            for (const V& p : points) {
                CHECK(length(V(p - sphere.centre)) <= sphere.radius);
                for (const V& q : points)
                    furthest = (std::max)(furthest, length(V(p - q)));
            }
            // No sphere is smaller than half the largest distance between two points.
            CHECK(sphere.radius <= std::sqrt(T(3)) * T(0.5) * furthest * (1 + 32 * std::numeric_limits<T>::epsilon()) +
                                       4 * std::numeric_limits<T>::epsilon() * offset);
        }
    }
}

TEST_CASE("target: the corners of a box have its circumscribed sphere") {
    const std::vector<glm::dvec3> corners{{1, 2, 3}, {3, 6, 7}};
    const auto sphere = bounding_sphere(corners);
    CHECK(sphere.centre.x == 2);
    CHECK(sphere.centre.y == 4);
    CHECK(sphere.centre.z == 5);
    CHECK(sphere.radius == doctest::Approx(3).epsilon(1e-14)); // sqrt(1 + 4 + 4), up to 8 units in the last place more
}

TEST_CASE("target: no points and points that are not finite are refused") {
    CHECK_THROWS_AS((void)bounding_sphere(std::vector<glm::vec3>{}), std::invalid_argument);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS((void)bounding_sphere(std::vector<glm::vec3>{{0, nan, 0}, {1, 1, 1}}), std::invalid_argument);
    CHECK(bounding_sphere(std::vector<glm::vec3>{{1, 2, 3}}).radius == 0);
}

// Rounding up costs at most 12 + 12 units of epsilon by the constants, and as much again by rounding; the cosine's part
// is divided by the cosine, hence only cones to 60 degrees.
TEST_CASE_TEMPLATE("target: a cone is never narrower than its sphere and hardly wider", T, float, double) {
    using V = glm::vec<3, T>;
    const RandomSequence random(4);
    for (std::uint64_t i = 0; i < 2000; ++i) {
        const auto at = [&](std::uint32_t d) { return random.sample<T>(i, d); };
        const T size = std::pow(T(10), 10 * at(0) - 5), offset = i % 2 == 0 ? T(0) : T(1e5);
        const V centre = V(offset) + size * V(at(1), at(2), at(3));
        const V from = V(offset) + size * V(at(4), at(5), at(6));
        const T ratio = i % 4 < 2 ? std::pow(T(10), -8 * at(7)) : 1 - std::pow(T(10), -7 * at(7));
        const BoundingSphere<V> sphere{centre, ratio * length(V(centre - from))};
        if (!(sphere.radius > 0))
            continue;
        const auto exact = exact_height<T>(sphere, from);
        const Cone<V> cone = cone_towards(sphere, from);
        CAPTURE(ratio);
        CHECK(cone.height >= exact);
        if (exact < T(0.5))
            CHECK(cone.height <= exact * (1 + 64 * std::numeric_limits<T>::epsilon()));
        CHECK(std::abs(length(cone.axis) - 1) <= 4 * std::numeric_limits<T>::epsilon());
    }
}

TEST_CASE("target: points of the sphere are in the cone and points beside it are not") {
    using V = glm::dvec3;
    const RandomSequence random(5);
    const BoundingSphere<V> sphere{{1, 2, 3}, 2};
    const V from(-3, 1, 7);
    const Cone<V> cone = cone_towards(sphere, from);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const V direction = sphere_direction<V>(random.sample<double>(i, 0), random.sample<double>(i, 1));
        const V to_point = normalize(V(sphere.centre + sphere.radius * direction - from));
        CHECK(0.5 * length2(V(to_point - cone.axis)) <= cone.height);
        // A ray meets the sphere if its closest approach does.
        const double closest = length(cross(direction, V(sphere.centre - from)));
        const bool hits = closest < sphere.radius && dot(direction, V(sphere.centre - from)) > 0;
        if (std::abs(closest - sphere.radius) > 1e-9)
            CHECK(hits == (0.5 * length2(V(direction - cone.axis)) < cone.height));
    }
}

TEST_CASE("target: from inside and from the surface every direction leads to it") {
    const BoundingSphere<glm::vec3> sphere{{1, 2, 3}, 2};
    CHECK(cone_towards(sphere, {1, 2, 3}).is_everything());
    CHECK(cone_towards(sphere, {1, 2, 4}).is_everything());
    CHECK(cone_towards(sphere, {1, 2, 5}).is_everything());
    CHECK(cone_towards(sphere, {1, 2, 3}).solid_angle() == doctest::Approx(4 * pi<double>));
    CHECK_FALSE(cone_towards(sphere, {1, 2, 5.01f}).is_everything());
}

} // namespace nephroid::tests::target_test
