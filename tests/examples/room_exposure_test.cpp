// SPDX-License-Identifier: MIT
#include "common/image/room_exposure.hpp"

#include "common/ray.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <vector>

namespace nephroid::examples::room_exposure_test {

// 1, 2, … 100 grey pixels and as many black ones: the 91st of the bright is the first of the brightest tenth.
TEST_CASE("room exposure: nine in ten of the pixels with light are not clipped") {
    Image<glm::vec3> picture(20, 10, glm::vec3(0));
    for (std::size_t i = 0; i < 100; ++i)
        picture.pixels[2 * i] = glm::vec3(float(100 - i)) + glm::vec3(0.5f, 0, -0.5f);
    CHECK(room_exposure(Samples(picture)) == doctest::Approx(0.7 / 91));
}

TEST_CASE("room exposure: a black picture stays as it is") {
    CHECK(room_exposure(Samples(Image<glm::vec3>(3, 2, glm::vec3(0)))) == 1);
    CHECK(room_exposure(Samples()) == 1);
}

} // namespace nephroid::examples::room_exposure_test
