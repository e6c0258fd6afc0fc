// SPDX-License-Identifier: MIT
#include "nephroid/emission/light/mesh.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/light_laws.hpp"
#include "nephroid/emission/light/quad.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::mesh_test {

static_assert(Light<MeshLight<glm::vec3, float>>);
static_assert(Light<MeshLight<glm::vec3, glm::vec3>>);

namespace {

template <class T>
using Mesh = MeshLight<glm::vec<3, T>, T>;
using D = glm::dvec3;

// Triangles of areas 1, 3, 0 and 2 that all shine down, side by side along x.
template <class T>
std::vector<typename Mesh<T>::Triangle> row() {
    using V = glm::vec<3, T>;
    return {{V(0, 0, 4), V(0, 2, 4), V(1, 0, 4)},
            {V(1, 0, 4), V(1, 2, 4), V(4, 0, 4)},
            {V(4, 0, 4), V(4, 2, 4), V(4, 1, 4)},
            {V(4, 0, 4), V(4, 4, 4), V(5, 0, 4)}};
}

} // namespace

TEST_CASE_TEMPLATE("mesh light: laws of lights hold and tangents are aligned in scenes of any size", T, float, double) {
    using V = glm::vec<3, T>;
    check_light_laws(Mesh<T>({.triangles = row<T>(), .radiance = 2}), 4);
    check_aligned(Mesh<T>({.triangles = row<T>(), .radiance = 2}));
    for (const T size : {T(1e-4), T(1), T(1e5)}) {
        const V corner(1e5, 0, 0);
        const Mesh<T> light({.triangles = {{corner, corner + size * V(0, 1, 1), corner + size * V(1, 0, 1)}},
                             .radiance = 2,
                             .target = BoundingSphere<V>{corner + size * V(2, 3, -4), size}});

        check_light_laws(light, 4);
        check_aligned(light);
    }
}

TEST_CASE_TEMPLATE("mesh light: unaimed the flux is pi times radiance times area", T, float, double) {
    check_same<T>(flux_of(Mesh<T>({.triangles = row<T>(), .radiance = 2}), 100), pi<double> * 2 * 6);
}

TEST_CASE("mesh light: positions are even over all triangles") {
    const Mesh<double> light({.triangles = row<double>(), .radiance = 2});
    // A triangle is cut into four equal ones at the middles of its sides. As the triangles' areas are as 1 : 3 : 2, the
    // second's photons fill three such sets of cells, in turn, and the last one's two.
    std::vector<std::size_t> cells(6 * 4);
    const auto triangles = row<double>();
    for (std::uint64_t i = 0; i < 24000; ++i) {
        const D p = photon_of(light, i, 1).position;
        const std::size_t which = p.x < 1 ? 0 : p.x < 4 ? 1 : 3;
        const auto& [a, b, c] = triangles[which];
        const double b1 = (p.y - a.y) / (b.y - a.y), b2 = (p.x - a.x) / (c.x - a.x);
        REQUIRE(b1 + b2 <= 1 + 1e-12);
        const std::size_t quarter = b1 > 0.5 ? 1 : b2 > 0.5 ? 2 : b1 + b2 < 0.5 ? 0 : 3;
        const std::size_t first = which == 0 ? 0 : which == 1 ? 1 : 4, parts = which == 0 ? 1 : which == 1 ? 3 : 2;
        ++cells[(first + i % parts) * 4 + quarter];
    }
    CHECK(chi_square(cells) < chi_square_limit(cells.size()));
}

TEST_CASE("mesh light: two triangles are the quad that they make up") {
    const BoundingSphere<D> target{{1, 1, 0}, 1};
    const D a(0, 0, 4), b(0, 2, 4), c(2, 2, 4), d(2, 0, 4);
    const Mesh<double> mesh({.triangles = {{a, b, c}, {a, c, d}}, .radiance = 2, .target = target});
    const QuadLight<D, double> quad(
        {.corner = a, .edge_u = D(b - a), .edge_v = D(d - a), .radiance = 2, .target = target});
    const Mean from_quad = flux_of(quad, 50000);
    check_same<double>(flux_of(mesh, 50000), from_quad.value(), from_quad.error());
    CHECK(mesh.power() == doctest::Approx(quad.power()).epsilon(0.01)); // both from 64 points
}

TEST_CASE("mesh light: a closed mesh emits outwards as its sphere does") {
    // An octahedron: every photon leaves from the side that its normal is on.
    const D x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    std::vector<Mesh<double>::Triangle> faces;
    for (const double sx : {1.0, -1.0})
        for (const double sy : {1.0, -1.0})
            for (const double sz : {1.0, -1.0})
                faces.push_back(sx * sy * sz > 0 ? Mesh<double>::Triangle{sx * x, sy * y, sz * z}
                                                 : Mesh<double>::Triangle{sy * y, sx * x, sz * z});
    const Mesh<double> light({.triangles = faces, .radiance = 1});
    check_same<double>(flux_of(light, 100), pi<double> * 8 * std::sqrt(3.0) / 2);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const auto photon = photon_of(light, i, 1);
        const D& p = photon.position;
        const D normal = normalize(D(std::copysign(1, p.x), std::copysign(1, p.y), std::copysign(1, p.z)));
        CHECK(dot(photon.direction, normal) > 0);
    }
    const BoundingSphere<D> target{{4, 1, 1}, 1};
    const Mean unaimed = flux_of(light, 100000, &target);
    const Mean aimed = flux_of(Mesh<double>({.triangles = faces, .radiance = 1, .target = target}), 100000);
    check_same<double>(aimed, unaimed.value(), unaimed.error());
}

TEST_CASE("mesh light: parameters out of range are refused") {
    using V = glm::vec3;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto make = [](std::vector<Mesh<float>::Triangle> triangles, float radiance) {
        return Mesh<float>({.triangles = std::move(triangles), .radiance = radiance});
    };
    CHECK_NOTHROW(make(row<float>(), 1));
    CHECK_THROWS_AS(make({}, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({{V(0, 0, 0), V(1, 0, 0), V(2, 0, 0)}}, 1), std::invalid_argument);
    CHECK_THROWS_AS(make({{V(0, 0, 0), V(1, 0, nan), V(0, 1, 0)}}, 1), std::invalid_argument);
    CHECK_THROWS_AS(make(row<float>(), -1), std::invalid_argument);
}

} // namespace nephroid::tests::mesh_test
