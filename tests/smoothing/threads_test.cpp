// SPDX-License-Identifier: MIT
// Second order by several threads. Apart from pilot_test.cpp, which takes a minute to compile: the thread sanitizer's
// build has only the files with such a test.
#include "nephroid/caustics.hpp"

#include "support/glass_ball.hpp"
#include "transport/tiny_scenes.hpp"

#include "nephroid/emission/light/standard_lights.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

namespace nephroid::tests::threads_test {

using tests::Floor;
using tests::floor_of;
using tests::GlassBall;
using tests::map_of;

namespace {

using V = tests::Vec<float>;

/// A point, a disk and the sun over a ball of glass: lights of two and of four coordinates.
[[nodiscard]] StandardLights<V, float> lamps() {
    const BoundingSphere<V> ball{V(0, 0, 1.5f), 1.25f};
    const PointLight<V, float> bulb({.position = V(0.5f, 0, 6), .intensity = 8, .target = ball});
    const DiskLight<V, float> disk(
        {.centre = V(-0.5f, 0, 6), .normal = V(0, 0, -1), .radius = 0.2f, .radiance = 60, .target = ball});
    const DirectionalLight<V, float> sun({.direction = V(0.1f, 0, -1), .irradiance = 1, .patch = ball});
    return StandardLights<V, float>({bulb, disk, sun});
}

struct Picture {
    std::vector<float> irradiance;
    Statistics account;
};

template <class E>
[[nodiscard]] Picture render(E&& executor) {
    const Floor<V> vertices = floor_of<V>(24);
    const EyePathMap<V> map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    Picture picture{std::vector<float>(vertices.size()), {}};
    const Default policies{.order = {.pilot = 2000}}; // of 6000: some photons are beyond the pilot
    picture.account = nephroid::caustics(GlassBall<V, float>{.tint = 1}, lamps(), sums, {.count = 6000}, policies,
                                         HaltonSequence(1), executor);
    sums.for_each([&](std::size_t i, float e) { picture.irradiance[i] = e; });
    return picture;
}

} // namespace

TEST_CASE("second order: any number of threads renders the same picture bit for bit") {
    const Picture serial = render(SerialExecutor{});
    CHECK(serial.account[Fate::splatted].photons > 1000);
    for (const unsigned threads : {1u, 2u, 7u}) {
        const Picture again = render(ThreadExecutor(threads));
        CAPTURE(threads);
        CHECK(again.irradiance == serial.irradiance);
        CHECK(again.account.emitted.photons == serial.account.emitted.photons);
        CHECK(again.account.rays == serial.account.rays);
        CHECK(again.account.specular_events == serial.account.specular_events);
        CHECK(again.account.bounded_footprints == serial.account.bounded_footprints);
        CHECK(again.account.bounded_shifts == serial.account.bounded_shifts);
        for (std::size_t i = 0; i < fate_count; ++i) {
            CHECK(again.account.fates[i].photons == serial.account.fates[i].photons);
            CHECK(again.account.fates[i].flux == serial.account.fates[i].flux);
        }
    }
}

} // namespace nephroid::tests::threads_test
