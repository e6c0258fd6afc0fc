// SPDX-License-Identifier: MIT
#include "nephroid/sheet/node_end.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace nephroid::tests::node_end_test {

namespace {
using End = detail::NodeEnd<glm::dvec3, double>;

[[nodiscard]] End end_at(const glm::dvec3& position, const glm::dvec3& normal) {
    return {position, glm::normalize(normal), {0, 0, -1}, 1, 0};
}

[[nodiscard]] bool are_joined(const End& a, const End& b, double pixel = 0.01) {
    return detail::are_joined(a, b, [pixel] { return pixel; });
}
} // namespace

TEST_CASE("joined nodes: neighbours on a plane, a ball and a saddle are joined") {
    CHECK(are_joined(end_at({0, 0, 0}, {0, 0, 1}), end_at({5, 3, 0}, {0, 0, 1})));
    for (double angle = 0.01; angle < 1.2; angle += 0.1)
        CHECK(are_joined(end_at({0, 0, 1}, {0, 0, 1}),
                         end_at({std::sin(angle), 0, std::cos(angle)}, {std::sin(angle), 0, std::cos(angle)})));
    const auto saddle = [](double x, double y) { return end_at({x, y, x * x - y * y}, {-2 * x, 2 * y, 1}); };
    CHECK(are_joined(saddle(0, 0), saddle(0.2, 0.1)));
    CHECK(are_joined(saddle(0.2, -0.2), saddle(0.1, -0.1)));
}

TEST_CASE("joined nodes: across a table's edge, between shelves and behind a wall they are not") {
    CHECK_FALSE(are_joined(end_at({0, 0, 0}, {0, 0, 1}), end_at({0.1, 0, 0.5}, {0, 0, 1})));
    CHECK_FALSE(are_joined(end_at({0, 0, 0}, {0, 0, 1}), end_at({0.02, 0, 0.002}, {0, 0, 1}))); // a fifth of a pixel
    CHECK_FALSE(are_joined(end_at({0, 0, 0}, {0, 0, 1}), end_at({0.1, 0, 0}, {0, 0, -1})));
    CHECK_FALSE(are_joined(end_at({0, 0, 0}, {0, 0, 1}), end_at({0.1, 0, 0.1}, {1, 0, 0}))); // floor and wall
}

TEST_CASE("joined nodes: a step of less than a tenth of a pixel does not separate them") {
    CHECK(are_joined(end_at({0, 0, 0}, {0, 0, 1}), end_at({0.02, 0, 0.0009}, {0, 0, 1})));
}

} // namespace nephroid::tests::node_end_test
