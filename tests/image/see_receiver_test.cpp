// SPDX-License-Identifier: MIT
#include "nephroid/image/see_receiver.hpp"

#include "image/wave_scene.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::see_receiver_test {

namespace {
struct Black : PlainWave<double> {
    [[nodiscard]] Scattering<double, double> scatter(const PlainHit& hit, const Vec3&, auto&) const {
        return hit.is_water ? Scattering<double, double>::absorb() : Scattering<double, double>::deposit();
    }
};
} // namespace

TEST_CASE("see receiver: lines of sight go straight through water to the floor, and its normal faces who looks") {
    const PlainWave<double> scene;
    const SeeReceiver<PlainWave<double>, glm::dvec3> see(scene);
    const auto point = see({{0.3, 0.4, 5}, {0, 0, -1}});
    REQUIRE(point.has_value());
    // The next ray begins two errors of 1e-6 below the water; the floor is met along the same line.
    CHECK(length(point->position - ChartVector{0.3, 0.4, 0}) < 1e-12);
    CHECK(point->normal.z == 1);
    CHECK(!see({{0.3, 0.4, 5}, {0, 0, 1}}).has_value());
}

TEST_CASE("see receiver: an absorber hides what is behind it") {
    const Black scene;
    CHECK(!SeeReceiver<Black, glm::dvec3>(scene)({{0.3, 0.4, 5}, {0, 0, -1}}).has_value());
}

} // namespace nephroid::tests::see_receiver_test
