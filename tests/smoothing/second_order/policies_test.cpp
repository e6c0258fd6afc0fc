// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/policies.hpp"

#include "support/glass_ball.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace nephroid::tests::policies_test {

namespace {

using V = glm::vec3;

/// What `caustics` says of a policy.
[[nodiscard]] std::string complaint_about(const SecondOrder& order) {
    const std::vector<tests::FloorVertex<V>> nothing;
    const EyePathMap<V> map(nothing, &tests::FloorVertex<V>::position, &tests::FloorVertex<V>::normal);
    auto sums = nephroid::sums<float>(map);
    const DirectionalLight<V, float> light(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = BoundingSphere<V>{{0, 0, 1.5f}, 1}});
    try {
        (void)nephroid::caustics(tests::GlassBall<V, float>{.tint = 1}, light, sums, {.count = 100},
                                 Default{.order = order});
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "none";
}

} // namespace

static_assert(std::is_same_v<decltype(Default::order), SecondOrder>);
static_assert(std::is_same_v<decltype(Published::order), FirstOrder>);
static_assert(std::is_empty_v<FirstOrder>);

TEST_CASE("second-order policy: defaults and infinite upper bounds are accepted") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    CHECK(complaint_about({}) == "none");
    CHECK(complaint_about({.bounds = {.largest_radius = infinity, .stretch = infinity},
                           .largest_shift = infinity,
                           .largest_miss = infinity}) == "none");
    CHECK(complaint_about({.bounds = {.least = 1, .least_radius = 3, .largest_radius = 3, .stretch = 1},
                           .largest_shift = 0,
                           .pilot = 1}) == "none");
}

TEST_CASE("second-order policy: the message names the option that makes no sense") {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const auto check = [](const SecondOrder& order, const std::string& words) {
        const std::string complaint = complaint_about(order);
        CAPTURE(complaint);
        CHECK(complaint.starts_with("nephroid::caustics: SecondOrder: "));
        CHECK(complaint.find(words) != std::string::npos);
    };
    check({.bounds = {.least = 0}}, "bounds.least is 0");
    check({.bounds = {.least = nan}}, "bounds.least is nan");
    check({.bounds = {.least = std::numeric_limits<double>::infinity()}}, "bounds.least is inf");
    check({.bounds = {.least_radius = -2}}, "bounds.least_radius is -2");
    check({.bounds = {.largest_radius = 1}}, "bounds.largest_radius is 1");
    check({.bounds = {.largest_radius = nan}}, "bounds.largest_radius is nan");
    check({.bounds = {.stretch = 0.5}}, "bounds.stretch is 0.5");
    check({.largest_shift = -0.1}, "largest_shift is -0.1");
    check({.largest_shift = nan}, "largest_shift is nan");
    check({.largest_miss = -0.1}, "largest_miss is -0.1");
    check({.largest_miss = nan}, "largest_miss is nan");
    check({.pilot = 0}, "pilot is 0");
}

TEST_CASE("second-order policy: from 80000 photons on the largest footprint is a constant part of the domain") {
    const SmoothingBounds bounds{.least = 4, .least_radius = 3, .largest_radius = 20, .stretch = 5};
    CHECK(bounds_for(bounds, 100).largest_radius == 20);
    CHECK(bounds_for(bounds, 80000).largest_radius == 20);
    CHECK(bounds_for(bounds, 320000).largest_radius == 40); // u0 is half of what it was
    CHECK(bounds_for(bounds, 320000).least == 4);
    CHECK(bounds_for(bounds, 320000).least_radius == 3);
    CHECK(bounds_for(bounds, 320000).stretch == 5);
}

} // namespace nephroid::tests::policies_test
