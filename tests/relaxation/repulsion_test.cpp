// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/repulsion.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::repulsion_test {

using namespace nephroid::detail;
using tests::Draws;
using tests::for_each_vector;
using tests::narrow;
using tests::Space;
using tests::widen;

TEST_CASE("over-relaxation: falls from its upper bound to its lower one as a Gaussian") {
    CHECK(over_relaxation(0, 20, 2, 1.2) == 2);
    CHECK(over_relaxation(10, 20, 2, 1.2) == doctest::Approx(1.2 + 0.8 * std::exp(-1.5)).epsilon(1e-14));
    CHECK(over_relaxation(20, 20, 2, 1.2) == doctest::Approx(1.2 + 0.8 * std::exp(-6.0)).epsilon(1e-14));
    for (unsigned i = 1; i < 50; ++i) {
        CHECK(over_relaxation(i, 50, 2, 1.2) < over_relaxation(i - 1, 50, 2, 1.2));
        CHECK(over_relaxation(i, 50, 1, 1) == 1); // switched off
    }
}

TEST_CASE("step share: comes down from one to the last step evenly") {
    CHECK(step_fraction(0, 5, 0.2) == 1);
    CHECK(step_fraction(2, 5, 0.2) == doctest::Approx(0.6).epsilon(1e-14));
    CHECK(step_fraction(4, 5, 0.2) == doctest::Approx(0.2).epsilon(1e-14));
    CHECK(step_fraction(0, 1, 0.2) == 1);
}

// x − x_k = (0.6, 0.8, 0) · 0.5 and r τ = 2: (2/0.5 − 0.5/2) · (0.3, 0.4, 0) = 3.75 · (0.3, 0.4, 0).
TEST_CASE_TEMPLATE("repulsion: is the offset times reach over distance less distance over reach", T, float, double) {
    for_each_vector<T>([]<class V>() {
        using t = vector_traits<V>;
        const V force = repulsion<V>(t::make(T(0.3), T(0.4), 0), T(0.5), T(2));
        const T tolerance = 8 * std::numeric_limits<T>::epsilon(); // the ε of the formula and a few roundings
        CHECK(std::abs(t::x(force) - T(1.125)) <= tolerance * T(1.125));
        CHECK(std::abs(t::y(force) - T(1.5)) <= tolerance * T(1.5));
        CHECK(t::z(force) == 0);
    });
}

TEST_CASE_TEMPLATE("repulsion: vanishes at its reach and attracts beyond", T, float, double) {
    using V = glm::vec<3, T>;
    const T tolerance = 4 * std::numeric_limits<T>::epsilon();
    CHECK(std::abs(repulsion<V>({3, 0, 0}, 3, 3).x) <= 3 * tolerance);
    CHECK(repulsion<V>({4, 0, 0}, 4, 3).x < 0);
    CHECK(repulsion<V>({2, 0, 0}, 2, 3).x > 0);
    CHECK(repulsion<V>({0, 0, 0}, 0, 3) == V(0, 0, 0)); // no direction
}

// The paper's own basis, where it is one: u = n × (−n_x, n_y, −n_z) made unit, v = n × u.
TEST_CASE("tangent plane: what is left of a force is its part along the paper's basis") {
    Draws draw(11);
    for (int i = 0; i < 100; ++i) {
        const Space n = draw.direction(), force = draw.in_cube();
        const Space mirrored{-n.x, n.y, -n.z};
        const Space across = n.cross(mirrored);
        if (tests::magnitude(across) < 0.01)
            continue;
        const Space u = across.unit(), v = n.cross(u);
        const Space expected = force.dot(u) * u + force.dot(v) * v;
        const auto found = in_tangent_plane(narrow<glm::dvec3>(force), narrow<glm::dvec3>(n));
        CHECK(tests::distance(found, expected) <= 1e-14);
    }
    // Where it is none: n_y = 0.
    CHECK(in_tangent_plane(glm::dvec3(1, 2, 3), glm::dvec3(0, 0, 1)) == glm::dvec3(1, 2, 0));
}

// f'' = v ((v (1 − w)) · f') + g (g · f') with v = g × n.
TEST_CASE("constrained motion: is the paper's, with what is across the feature held back by the weight") {
    Draws draw(12);
    for (int i = 0; i < 100; ++i) {
        const Space n = draw.direction(), g = draw.direction().across(n).unit(), v = g.cross(n);
        const Space force = draw.in_cube().across(n);
        const double w = draw.in(0, 1);
        const Space expected = (tests::Wide(1 - w) * v).dot(force) * v + g.dot(force) * g;
        const PhotonConstraint<glm::dvec3> constraint{narrow<glm::dvec3>(g), w};
        CHECK(tests::distance(constrained(narrow<glm::dvec3>(force), constraint), expected) <= 1e-14);
    }
    const glm::dvec3 force(3, 4, 0);
    CHECK(constrained<glm::dvec3>(force, {{1, 0, 0}, 1}) == glm::dvec3(3, 0, 0));
    CHECK(constrained<glm::dvec3>(force, {{1, 0, 0}, 0}) == force);
    CHECK(constrained<glm::dvec3>(force, {{0, 0, 0}, 0.5}) == glm::dvec3(1.5, 2, 0)); // no feature leads on
    CHECK(constrained<glm::dvec3>(force, {{0, 0, 0}, 1}) == glm::dvec3(0, 0, 0));
}

TEST_CASE_TEMPLATE("diffusion limit: halves a move of rho radii and damps longer ones as a Gaussian", T, float,
                   double) {
    const T tolerance = 8 * std::numeric_limits<T>::epsilon();
    const T r = 2, rho = T(0.3);
    CHECK(diffusion_limit<T>(0, r * r, rho) == 1);
    CHECK(std::abs(diffusion_limit<T>(rho * rho * r * r, r * r, rho) - T(0.5)) <= tolerance);
    CHECK(std::abs(diffusion_limit<T>(4 * rho * rho * r * r, r * r, rho) - T(0.0625)) <= tolerance); // 2^-4
    CHECK(diffusion_limit<T>(T(1e6), r * r, rho) == 0);
}

} // namespace nephroid::tests::repulsion_test
