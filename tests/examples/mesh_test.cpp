// SPDX-License-Identifier: MIT
#include "common/shapes/mesh.hpp"

#include "examples/worlds.hpp"

#include "nephroid/vector/frame.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::examples::mesh_test {

using namespace nephroid::examples::testing;
using nephroid::cross;
using nephroid::dot;
using nephroid::length;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Möller and Trumbore's test in long double.
struct Meeting {
    Real t = 0, least = -1; ///< distance; the least barycentric coordinate: the triangle is hit where it is positive
};

template <class T>
Meeting meeting(const Ray<T>& ray, const std::array<Vec3<T>, 3>& corners) {
    const RealVec3 a(corners[0]), e1 = RealVec3(corners[1]) - a, e2 = RealVec3(corners[2]) - a, d(ray.direction);
    const RealVec3 p = glm::cross(d, e2), s = RealVec3(ray.origin) - a, q = glm::cross(s, e1);
    const Real det = glm::dot(e1, p);
    if (det == 0)
        return {};
    const Real u = glm::dot(s, p) / det, v = glm::dot(d, q) / det;
    return {glm::dot(e2, q) / det, std::min({u, v, 1 - u - v})};
}

} // namespace

// Meetings within 1e-5 of an edge (relative to the triangle) or of the origin may go either way in T.
TEST_CASE_TEMPLATE("mesh: the nearest hit is that of a search through all triangles", T, float, double) {
    Numbers numbers(5);
    MeshData<T> data;
    for (std::uint32_t i = 0; i < 600; ++i) {
        const Vec3<T> a = numbers.point<T>(-1, 1);
        data.positions.insert(data.positions.end(),
                              {a, a + numbers.point<T>(-0.2, 0.2), a + numbers.point<T>(-0.2, 0.2)});
        data.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    const TriangleMesh<T> mesh(data);
    int hits = 0, misses = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray<T> ray{numbers.point<T>(-1.5, 1.5), numbers.direction<T>()};
        Real nearest = infinity;
        bool unclear = false;
        for (std::size_t k = 0; k < data.triangles.size(); ++k) {
            const Meeting m = meeting(ray, mesh.corners(k));
            unclear = unclear || (std::abs(m.least) < 1e-5L && m.t > -1e-5L) || (m.least > 0 && std::abs(m.t) < 1e-5L);
            if (m.least > 0 && m.t > 0)
                nearest = std::min(nearest, m.t);
        }
        if (unclear)
            continue;
        const auto found = mesh.nearest(ray, infinity);
        REQUIRE(found.has_value() == (nearest < infinity));
        CHECK(mesh.occludes(ray) == found.has_value());
        ++(found ? hits : misses);
        if (found) // decided in double, whose error is that of slivers met at grazing angles at worst
            CHECK(std::abs(found->distance - double(nearest)) <= 1e-9 * double(nearest) + 1e-12);
    }
    CHECK(hits > 400);
    CHECK(misses > 500);
}

TEST_CASE_TEMPLATE("mesh: without triangles and with degenerate ones nothing is hit", T, float, double) {
    const TriangleMesh<T> empty(MeshData<T>{});
    CHECK(!empty.nearest({{0, 0, 1}, {0, 0, -1}}, infinity));
    CHECK(empty.bounds().is_empty());

    MeshData<T> data;
    data.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}};
    data.triangles = {{0, 0, 0}, {0, 1, 2}, {0, 3, 1}, {1, 1, 2}}; // points and lines
    const TriangleMesh<T> degenerate(data);
    for (const T x : {T(0), T(0.3), T(1)})
        CHECK(!degenerate.nearest({{x, 0, 1}, {0, 0, -1}}, infinity));
}

TEST_CASE_TEMPLATE("mesh: one triangle is hit from both sides and not beyond its edges", T, float, double) {
    MeshData<T> data;
    data.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    data.triangles = {{0, 1, 2}};
    const TriangleMesh<T> mesh(data);
    for (const T side : {T(1), T(-1)}) {
        const Ray<T> ray{{T(0.25), T(0.5), side * 2}, {0, 0, -side}};
        const auto found = mesh.nearest(ray, infinity);
        REQUIRE(found.has_value());
        CHECK(found->distance == 2);
        const Hit<T> hit = mesh.hit(ray, *found);
        CHECK(hit.position == Vec3<T>(T(0.25), T(0.5), 0));
        CHECK(hit.geometric_normal == Vec3<T>(0, 0, 1));
        CHECK(hit.shading_normal == hit.geometric_normal);
        CHECK(!mesh.nearest({{T(0.51), T(0.5), side * 2}, {0, 0, -side}}, infinity));
        CHECK(!mesh.nearest(ray, 1.999));
        CHECK(!mesh.nearest({ray.origin, ray.direction, T(2)}, infinity)); // t_min itself is out
        CHECK(!mesh.nearest({{T(0.25), T(0.5), side * 2}, {0, 0, side}}, infinity));
        CHECK(!mesh.nearest({{-1, T(0.25), 0}, {1, 0, 0}}, infinity)); // edge-on
    }
}

TEST_CASE_TEMPLATE("mesh: of coincident triangles one is hit at their distance", T, float, double) {
    MeshData<T> data = sheet<T>(1, 0);
    const auto one = data.triangles;
    for (int i = 0; i < 30; ++i)
        data.triangles.insert(data.triangles.end(), one.begin(), one.end());
    data.materials.clear();
    const TriangleMesh<T> mesh(data);
    const auto found = mesh.nearest({{T(0.3), T(0.1), 1}, {0, 0, -1}}, infinity);
    REQUIRE(found.has_value());
    CHECK(found->distance == 1);
}

// A ray from inside of a closed mesh hits it, above all where it aims at a vertex or an edge, and wherever the mesh is:
// at 1000 units from the origin of coordinates a vertex of float is a thousandth of an edge off its place.
TEST_CASE_TEMPLATE("mesh: no ray leaves a closed mesh through a crack", T, float, double) {
    for (const double away : {0.0, 1000.0}) {
        Numbers numbers(6);
        const Vec3<T> centre = Vec3<T>(T(away), T(-0.7 * away), T(0.3 * away));
        const TriangleMesh<T> mesh(globe<T>(40, 0.1, centre));
        const auto& data = mesh.data();
        int missed = 0;
        for (int i = 0; i < 60000; ++i) {
            const Vec3<T> origin = centre + numbers.point<T>(-0.4, 0.4);
            const auto& triangle = data.triangles[std::size_t(numbers(0, double(data.triangles.size())))];
            const Vec3<T> a = data.positions[triangle[0]], b = data.positions[triangle[1]];
            const T along = i % 3 == 0 ? T(0) : T(numbers(0, 1));
            Vec3<T> direction = a + along * (b - a) - origin;
            if (i % 3 == 2)
                direction = numbers.direction<T>();
            if (i % 30 == 2) {
                direction = Vec3<T>(0);
                direction[i % 4 % 3] = i % 60 == 2 ? T(1) : T(-1);
            }
            direction = nephroid::normalize(direction);
            missed += !mesh.nearest({origin, direction}, infinity).has_value();
            missed += !mesh.occludes({origin, direction});
        }
        CHECK(missed == 0);
    }
}

// From far away the triangles are near the resolution of T: still no hole.
TEST_CASE("mesh: seen from a thousand times its size a sheet of small triangles has no holes") {
    MeshData<float> data;
    constexpr std::uint32_t n = 40;
    for (std::uint32_t j = 0; j <= n; ++j)
        for (std::uint32_t i = 0; i <= n; ++i)
            data.positions.emplace_back(float(i) / n, float(j) / n, 0.0f);
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            const std::uint32_t k = j * (n + 1) + i;
            data.triangles.push_back({k, k + 1, k + n + 2});
            data.triangles.push_back({k, k + n + 2, k + n + 1});
        }
    const TriangleMesh<float> mesh(data);
    Numbers numbers(7);
    int missed = 0;
    for (int i = 0; i < 20000; ++i) {
        // Down to 0.6 degrees above the sheet.
        const Vec3<float> aim(float(numbers(0.3, 0.7)), float(numbers(0.3, 0.7)), 0);
        Vec3<float> away = numbers.direction<float>();
        away.z = std::abs(away.z) * 0.2f + 0.01f;
        const Vec3<float> origin = aim + 1000.0f * nephroid::normalize(away);
        missed += !mesh.nearest({origin, nephroid::normalize(Vec3<float>(aim - origin))}, infinity).has_value();
    }
    CHECK(missed == 0);
}

// A power of two changes no digit, of the direction nor of what is made of it: the distance alone, by as much.
TEST_CASE_TEMPLATE("mesh: the direction of a ray may have any length", T, float, double) {
    const TriangleMesh<T> mesh(globe<T>(30, 0.1, Vec3<T>(0)));
    Numbers numbers(12);
    for (int i = 0; i < 2000; ++i) {
        const Vec3<T> origin = numbers.point<T>(-0.4, 0.4), direction = numbers.direction<T>();
        const auto expected = mesh.nearest({origin, direction}, infinity);
        REQUIRE(expected.has_value());
        for (const int exponent : {-30, -5, 5, 30}) {
            const auto found = mesh.nearest({origin, std::ldexp(T(1), exponent) * direction}, infinity);
            REQUIRE(found.has_value());
            CHECK(found->primitive == expected->primitive);
            CHECK(found->distance == std::ldexp(expected->distance, -exponent));
        }
    }
}

// A hit is the exact meeting of the ray with the triangle's plane, computed in double and rounded.
TEST_CASE_TEMPLATE("mesh: hits lie on their triangle within the stated error and rays leave it", T, float, double) {
    Numbers numbers(8);
    const TriangleMesh<T> mesh(globe<T>(30));
    for (int i = 0; i < 3000; ++i) {
        const Ray<T> ray{numbers.point<T>(-0.5, 0.5), numbers.direction<T>()};
        const auto found = mesh.nearest(ray, infinity);
        REQUIRE(found.has_value());
        const Hit<T> hit = mesh.hit(ray, *found);
        const auto [a, b, c] = mesh.corners(found->primitive);
        const RealVec3 face = glm::cross(RealVec3(b) - RealVec3(a), RealVec3(c) - RealVec3(a));
        const Real off = std::abs(glm::dot(RealVec3(hit.position) - RealVec3(a), face)) / norm(face);
        CHECK(off <= Real(hit.position_error));
        CHECK(Real(hit.position_error) < 64 * Real(std::numeric_limits<T>::epsilon()));
        // The globe is convex: outwards nothing is hit, inwards something that is not right here.
        const Vec3<T> n = hit.geometric_normal;
        const Vec3<T> outside = hit.position + T(2) * hit.position_error * n;
        const Vec3<T> inside = hit.position - T(2) * hit.position_error * n;
        Vec3<T> direction = numbers.direction<T>();
        if (dot(direction, n) < 0)
            direction = -direction;
        CHECK(!mesh.nearest({outside, direction}, infinity));
        if (dot(direction, n) > T(0.2))
            CHECK(mesh.nearest({inside, -direction}, infinity).value_or(Candidate<T>{0}).distance > 0.1);
    }
}

// Oracle: the normal interpolated and normalised in long double, by central difference; its error is h² times a third
// derivative of order 1, and epsilon/h.
TEST_CASE_TEMPLATE("mesh: the shading normal changes as the curvature says", T, float, double) {
    Numbers numbers(9);
    MeshData<T> data = globe<T>(12, 0.05);
    const TriangleMesh<T> mesh(data);
    for (int i = 0; i < 500; ++i) {
        const Ray<T> ray{numbers.point<T>(-0.3, 0.3), numbers.direction<T>()};
        const auto found = mesh.nearest(ray, infinity);
        REQUIRE(found.has_value());
        const Hit<T> hit = mesh.hit(ray, *found);
        const auto& t = data.triangles[found->primitive];
        const auto corners = mesh.corners(found->primitive);
        const RealVec3 e1 = RealVec3(corners[1]) - RealVec3(corners[0]),
                       e2 = RealVec3(corners[2]) - RealVec3(corners[0]);
        const auto normal_at = [&](Real u, Real v) {
            const RealVec3 n0(data.normals[t[0]]), n1(data.normals[t[1]]), n2(data.normals[t[2]]);
            const RealVec3 n = n0 + u * (n1 - n0) + v * (n2 - n0);
            return n / norm(n);
        };
        const Real u = found->u, v = found->v, h = 1e-6L;
        // A few roundings of T, relative to quantities of order one.
        CHECK(norm(RealVec3(hit.shading_normal) - normal_at(u, v)) < 8 * Real(std::numeric_limits<T>::epsilon()));
        for (const auto& [du, dv] : {std::pair<Real, Real>{1, 0}, {0, 1}, {1, -2}}) {
            const RealVec3 expected = (normal_at(u + h * du, v + h * dv) - normal_at(u - h * du, v - h * dv)) / (2 * h);
            const RealVec3 found_change(hit.curvature(Vec3<T>(du * e1 + dv * e2)));
            CHECK(norm(found_change - expected) < 100 * Real(std::numeric_limits<T>::epsilon()) + 1e-10L);
        }
    }
}

// A power of two changes no digit of a vertex, nor of what is computed in double; the curvature's are those of T, of
// quantities of order one.
TEST_CASE_TEMPLATE("mesh: a globe may be 1e-15 or 1e15 in size", T, float, double) {
    const MeshData<T> data = globe<T>(12, 0.05);
    const TriangleMesh<T> mesh(data);
    for (const int exponent : {-50, -30, 30, 43, 50}) {
        const T size = std::ldexp(T(1), exponent);
        MeshData<T> sized = data;
        for (Vec3<T>& p : sized.positions)
            p = size * p;
        const TriangleMesh<T> same(sized);
        CAPTURE(exponent);
        Numbers numbers(13);
        for (int i = 0; i < 300; ++i) {
            const Vec3<T> origin = numbers.point<T>(-0.3, 0.3), direction = numbers.direction<T>();
            const Ray<T> ray{origin, direction}, sized_ray{size * origin, direction};
            const auto expected = mesh.nearest(ray, infinity), found = same.nearest(sized_ray, infinity);
            REQUIRE(expected.has_value());
            REQUIRE(found.has_value());
            CHECK(found->primitive == expected->primitive);
            CHECK(found->distance == std::ldexp(expected->distance, exponent));
            CHECK(same.nearest(sized_ray, 1.001 * found->distance).has_value());
            CHECK(!same.nearest(sized_ray, 0.999 * found->distance));
            const Hit<T> hit = mesh.hit(ray, *expected), sized_hit = same.hit(sized_ray, *found);
            CHECK(sized_hit.position == size * hit.position);
            CHECK(sized_hit.shading_normal == hit.shading_normal);
            const Vec3<T> dx = nephroid::frame_about(hit.geometric_normal).u;
            const RealVec3 change(hit.curvature(dx)), sized_change(sized_hit.curvature(size * dx));
            CHECK(norm(change) > Real(0.1));
            CHECK(norm(sized_change - change) < 100 * Real(std::numeric_limits<T>::epsilon()));
        }
    }
}

TEST_CASE_TEMPLATE("mesh: vertex normals against the winding are turned to the geometric side", T, float, double) {
    MeshData<T> data = globe<T>(12);
    const TriangleMesh<T> outward(data);
    for (Vec3<T>& n : data.normals)
        n = -n;
    const TriangleMesh<T> inward(data);
    const Ray<T> ray{{0, 0, 0}, nephroid::normalize(Vec3<T>(1, 2, 3))};
    const Hit<T> a = outward.hit(ray, outward.nearest(ray, infinity).value());
    const Hit<T> b = inward.hit(ray, inward.nearest(ray, infinity).value());
    CHECK(a.shading_normal == b.shading_normal);
    const Vec3<T> dx = nephroid::frame_about(a.geometric_normal).u;
    CHECK(a.curvature(dx) == b.curvature(dx));
}

TEST_CASE_TEMPLATE("mesh: vertices without a normal make flat triangles", T, float, double) {
    MeshData<T> data = globe<T>(12);
    for (Vec3<T>& n : data.normals)
        n = Vec3<T>(0);
    const TriangleMesh<T> mesh(data);
    const Ray<T> ray{{0, 0, 0}, nephroid::normalize(Vec3<T>(1, 2, 3))};
    const Hit<T> hit = mesh.hit(ray, mesh.nearest(ray, infinity).value());
    CHECK(hit.shading_normal == hit.geometric_normal);
    CHECK(hit.curvature(Vec3<T>(1, 0, 0)) == Vec3<T>(0));
}

TEST_CASE_TEMPLATE("mesh: what is not a mesh is refused", T, float, double) {
    const MeshData<T> good = globe<T>(4);
    MeshData<T> bad = good;
    bad.triangles[3][1] = static_cast<std::uint32_t>(bad.positions.size());
    CHECK_THROWS_AS(TriangleMesh<T>{bad}, std::invalid_argument);
    bad = good;
    bad.positions[2].y = std::numeric_limits<T>::quiet_NaN();
    CHECK_THROWS_AS(TriangleMesh<T>{bad}, std::invalid_argument);
    bad = good;
    bad.normals[2].y = std::numeric_limits<T>::infinity();
    CHECK_THROWS_AS(TriangleMesh<T>{bad}, std::invalid_argument);
    bad = good;
    bad.normals.pop_back();
    CHECK_THROWS_AS(TriangleMesh<T>{bad}, std::invalid_argument);
    bad = good;
    bad.materials.assign(1, 0);
    CHECK_THROWS_AS(TriangleMesh<T>{bad}, std::invalid_argument);
}

} // namespace nephroid::examples::mesh_test
