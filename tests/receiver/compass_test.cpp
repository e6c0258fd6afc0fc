// SPDX-License-Identifier: MIT
#include "nephroid/receiver/compass.hpp"

#include "nephroid/sequence/random.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/vector/glm.hpp"

#include "support/sphere_direction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>

namespace nephroid::tests::compass_test {

// A point is 1/1024 of the square, at most π/2 times as much of the turn beside the axes: half of that, in directions.
TEST_CASE("compass: an offset lies between the directions that its angle lies between") {
    using V = glm::dvec3;
    const RandomSequence random(31);
    for (const std::size_t count : {8u, 32u, 256u}) {
        const auto between = detail::directions_by_compass(count);
        for (std::uint64_t i = 0; i < 500; ++i) {
            Sampler<RandomSequence> sampler(random, i);
            const double u = sampler.next<double>(), v = sampler.next<double>(), turn = sampler.next<double>();
            const V normal = sphere_direction<V>(u, v);
            const Frame<V> frame = frame_about(normal);
            const double angle = 2 * std::numbers::pi * turn;
            const V offset = 0.3 * (std::cos(angle) * frame.u + std::sin(angle) * frame.v) + 0.1 * normal;
            const auto point = detail::compass_point(normal.x, normal.y, normal.z, offset.x, offset.y, offset.z);
            const detail::BetweenDirections at = between[std::size_t(point)];
            CHECK(at.after == (at.before + 1u) % count);
            double apart = double(at.before) + 0.5 + double(at.share) - turn * double(count);
            apart -= double(count) * std::round(apart / double(count));
            CHECK(std::abs(apart) <= 1.6 * double(count) / double(detail::compass_points));
        }
    }
    // Along the normal there is no direction: any will do.
    CHECK(detail::compass_point(0.0, 0.0, 1.0, 0.0, 0.0, 1.0) == std::int32_t(detail::compass_points / 4));
}

} // namespace nephroid::tests::compass_test
