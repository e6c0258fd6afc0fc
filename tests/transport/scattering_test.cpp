// SPDX-License-Identifier: MIT
#include "nephroid/transport/scattering.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::scattering_test {

TEST_CASE("scattering: is made by the name of what happens") {
    using S = Scattering<glm::vec3, double>;
    const glm::vec3 half{0.5f, 0.25f, 1};
    CHECK(S::absorb().event == Event::absorb);
    CHECK(S::deposit().event == Event::deposit);
    CHECK(S::reflect(half).event == Event::reflect);
    CHECK(S::reflect(half).weight == half);
    CHECK(S::refract(half, 1.5).event == Event::refract);
    CHECK(S::refract(half, 1.5).weight == half);
    CHECK(S::refract(half, 1.5).eta == 1.5);
    CHECK(S::reflect(half).eta == 1);
}

TEST_CASE("scattering: a forgotten answer absorbs without a gain") {
    const Scattering<float, float> forgotten;
    CHECK(forgotten.event == Event::absorb);
    CHECK(forgotten.weight == 0);
}

TEST_CASE("scattering: a mirror's answer has no index of refraction and is asked for none") {
    using S = MirrorScattering<float>;
    CHECK(S::absorb().event == Event::absorb);
    CHECK(S::deposit().event == Event::deposit);
    CHECK(S::reflect(0.5f).event == Event::reflect);
    CHECK(S::reflect(0.5f).weight == 0.5f);
    static_assert(!detail::refracts<S>);
    static_assert(detail::refracts<Scattering<float, float>>);
}

} // namespace nephroid::tests::scattering_test
