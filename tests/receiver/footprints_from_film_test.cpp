// SPDX-License-Identifier: MIT
#include "nephroid/receiver/footprints_from_film.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace nephroid::tests::footprints_from_film_test {

namespace {

using V = glm::dvec3;

struct Vertex {
    V position, normal;
    std::uint32_t pixel;
};

constexpr std::size_t width = 64, height = 48;
const V eye(0.1, -3, 2);

/// From above, downwards at a slant: pixels are 1/50 wide at distance 1.
PixelRay<V> ray(double x, double y) {
    const double right = (x - 0.5 * width) / 50, up = (y - 0.5 * height) / 50;
    return {eye, V(right, 1 + 0.6 * up, -0.8 + up)};
}

template <class Meet>
std::vector<Vertex> film(const Meet& meet) {
    std::vector<Vertex> vertices;
    for (std::size_t pixel = 0; pixel < width * height; ++pixel)
        if (const std::optional<Vertex> seen = meet(ray(double(pixel % width) + 0.5, double(pixel / width) + 0.5))) {
            vertices.push_back(*seen);
            vertices.back().pixel = std::uint32_t(pixel);
        }
    return vertices;
}

std::optional<Vertex> on_floor(const PixelRay<V>& r, double z) {
    const double t = (z - r.origin.z) / r.direction.z;
    if (!(t > 0) || t > 1e3)
        return std::nullopt;
    return Vertex{r.origin + t * r.direction, {0, 0, 1}, 0};
}

std::vector<PixelFootprint<V>> footprints(const std::vector<Vertex>& vertices) {
    return footprints_from_film(vertices, width, height, &Vertex::pixel, &Vertex::position, &Vertex::normal);
}

PixelFootprint<V> by_rays(const Vertex& vertex) {
    const double x = vertex.pixel % width + 0.5, y = double(vertex.pixel / width) + 0.5;
    return footprint_from_rays(vertex.position, vertex.normal, ray(x - 0.5, y), ray(x + 0.5, y), ray(x, y - 0.5),
                               ray(x, y + 0.5));
}

bool is_inner(std::uint32_t pixel) {
    const std::size_t x = pixel % width, y = pixel / width;
    return x > 0 && x + 1 < width && y > 0 && y + 1 < height;
}

} // namespace

// Where x(p) = h p / (1 - p q) on a plane, a step of one pixel to both sides gives x' to a relative (q')² with q' the
// relative change of depth a pixel, and half a pixel to both sides (the rays) a quarter of that. At the border one
// side gives it to first order, q'.
TEST_CASE("footprints from film: on a plane they are those of the camera's rays to second order") {
    const auto vertices = film([](const PixelRay<V>& r) { return on_floor(r, 0); });
    REQUIRE(vertices.size() == width * height);
    const auto found = footprints(vertices);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const PixelFootprint<V> exact = by_rays(vertices[i]);
        // Depth is h / -direction.z; a pixel changes direction.z by 1/50.
        const double change = 0.02 / -ray(0, vertices[i].pixel / width + 0.5).direction.z;
        const double tolerance = is_inner(vertices[i].pixel) ? 2 * change * change : 2 * change;
        CHECK(length(V(found[i].u - exact.u)) <= tolerance * length(exact.u) + 1e-12);
        CHECK(length(V(found[i].v - exact.v)) <= tolerance * length(exact.v) + 1e-12);
    }
}

// A table of normal (0, 0, 1) as the floor has: only the step in depth tells them apart.
TEST_CASE("footprints from film: footprints do not reach across silhouettes") {
    const auto vertices = film([](const PixelRay<V>& r) {
        const auto table = on_floor(r, 1);
        const bool is_met = table && std::abs(table->position.x) < 0.5 && std::abs(table->position.y) < 0.5;
        return is_met ? table : on_floor(r, 0);
    });
    REQUIRE(vertices.size() == width * height);
    const auto found = footprints(vertices);
    std::size_t on_table = 0, compared = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const PixelFootprint<V> exact = by_rays(vertices[i]);
        on_table += vertices[i].position.z > 0.5;
        const auto is_beside = [&](std::size_t step) { // on the same surface, one step of pixels away
            const auto same = [&](std::size_t k) {
                return (vertices[k].position.z > 0.5) == (vertices[i].position.z > 0.5);
            };
            return (i >= step && same(i - step)) || (i + step < vertices.size() && same(i + step));
        };
        if (!is_beside(1) || !is_beside(width)) // a sliver of a surface, one pixel wide
            continue;
        ++compared;
        const double change = 0.02 / -ray(0, vertices[i].pixel / width + 0.5).direction.z;
        CHECK(length(V(found[i].u - exact.u)) <= 2 * change * length(exact.u) + 1e-12);
        CHECK(length(V(found[i].v - exact.v)) <= 2 * change * length(exact.v) + 1e-12);
    }
    CHECK(on_table > 100);
    CHECK(compared + 100 > vertices.size());
}

// A ball: its normals turn. The way to a neighbour, laid into the tangent plane, is shorter than where the neighbour's
// ray meets that plane by a share of the order of the turn over the cosine.
TEST_CASE("footprints from film: footprints follow a curved surface and ignore what lies behind it") {
    const V centre(0, 0, 0.6);
    const double radius = 0.6;
    const auto vertices = film([&](const PixelRay<V>& r) -> std::optional<Vertex> {
        const V d = normalize(r.direction), m = r.origin - centre;
        const double b = dot(m, d), c = dot(m, m) - radius * radius;
        if (b * b < c)
            return on_floor(r, 0);
        const V p = r.origin + (-b - std::sqrt(b * b - c)) * d;
        return Vertex{p, V((1 / radius) * (p - centre)), 0};
    });
    const auto found = footprints(vertices);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        CHECK(!detail::is_unknown(found[i]));
        CHECK(std::abs(dot(found[i].u, vertices[i].normal)) <= 1e-12);
        const double cosine = -dot(normalize(V(vertices[i].position - eye)), vertices[i].normal);
        if (vertices[i].position.z < 0.01 || cosine < 0.5)
            continue;
        const PixelFootprint<V> exact = by_rays(vertices[i]);
        const double turn = (std::max)(length(exact.u), length(exact.v)) / radius;
        CHECK(length(V(found[i].u - exact.u)) <=
              2 * turn * turn / square(cosine) * length(exact.u) + 0.01 * length(exact.u));
        CHECK(length(V(found[i].v - exact.v)) <=
              2 * turn * turn / square(cosine) * length(exact.v) + 0.01 * length(exact.v));
        ++compared;
    }
    CHECK(compared > 50);
}

TEST_CASE("footprints from film: a lone vertex has none and vertices in a row have squares") {
    std::vector<Vertex> vertices{{{0, 0, 0}, {0, 0, 1}, 0}, {{3, 0, 0}, {0, 0, 1}, 10}, {{4, 0, 0}, {0, 0, 1}, 11}};
    const auto found = footprints(vertices);
    CHECK(detail::is_unknown(found[0]));
    CHECK(found[1].u == V(1, 0, 0));
    CHECK(found[1].v == V(0, 1, 0));
    // Of two vertices in one pixel each goes its own way.
    vertices.push_back({{3, 0, 5}, {0, 0, 1}, 10});
    vertices.push_back({{3.5, 0, 5}, {0, 0, 1}, 11});
    CHECK(footprints(vertices)[1].u == V(1, 0, 0));
    CHECK(footprints(vertices)[3].u == V(0.5, 0, 0));
}

TEST_CASE("footprints from film: the message names the vertex that is not on the film") {
    const std::vector<Vertex> vertices{{{0, 0, 0}, {0, 0, 1}, 0}, {{0, 0, 0}, {0, 0, 1}, width * height}};
    try {
        (void)footprints(vertices);
        FAIL("took it");
    } catch (const std::invalid_argument& error) {
        CHECK(std::string(error.what()).starts_with("nephroid::footprints_from_film: vertex 1 is in pixel 3072"));
    }
}

} // namespace nephroid::tests::footprints_from_film_test
