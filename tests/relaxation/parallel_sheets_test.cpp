// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/parallel_sheets.hpp"

#include "relaxation/cloud.hpp"

#include <doctest/doctest.h>

#include <limits>

namespace nephroid::tests::parallel_sheets_test {

using namespace nephroid::detail;

TEST_CASE("parallel sheets: the reach ends amid the gap between two layers") {
    const auto reach = [](std::vector<double> heights) { return sheet_reach<double>(heights, 1e-12); };
    CHECK(reach({0, 0, 0, 0, 1, 1, 1, 1, 1}) == 0.5);
    CHECK(reach({0, 0, 0, 0, 0, -2, -2, -2}) == 1);
    CHECK(reach({0, 1, 1, 1, 1, 1, 1, 1}) == 0.5); // alone under a dense sheet
    CHECK(reach({0, 0.1, 0, 0, 1, 1.1, 1, 1, 1}) == doctest::Approx(0.55));
    CHECK(std::isinf(reach({0, 0, 0, 0, 0, 0, 0, 0})));
    CHECK(std::isinf(reach({0, 0, 0, 0, 1e-13, 1e-13, 1e-13, 1e-13})));  // rounding
    CHECK(std::isinf(reach({0, 1, 2, 3, 4, 5, 6, 7, 8})));               // a slope
    CHECK(std::isinf(reach({0, 0.1, 0.2, 0.3, 1, 1.1, 1.2, 1.3, 1.4}))); // layers as thick as the gap
    CHECK(std::isinf(reach({0, 0, 1})));                                 // too few
}

TEST_CASE("parallel sheets: photons of one sheet see it alone and a curved surface is one sheet") {
    auto photons = random_floor(500, 114);
    for (std::size_t i = 0; i < photons.size(); i += 2)
        photons[i].position.z = 0.01; // the spacing is 0.06
    PhotonCloud<glm::dvec3, double> cloud(photons, access_to<Stored>(), 0.5, "test");
    SerialExecutor executor;
    separate_sheets(cloud, executor);
    std::vector<std::size_t> slots; // without those that pad leaves
    detail::for_each_slot(cloud.tree(), executor, [&](std::size_t slot) { slots.push_back(slot); });
    for (std::size_t i = 0; i < slots.size(); i += 7)
        for (const std::size_t b : slots)
            CHECK(cloud.same_surface(slots[i], b) == (cloud.tree().index(slots[i]) % 2 == cloud.tree().index(b) % 2));

    Draws draw(115);
    std::vector<Stored> sphere;
    for (int i = 0; i < 2000; ++i) {
        const auto n = narrow<glm::dvec3>(draw.direction());
        sphere.push_back({i, n, n, 1});
    }
    PhotonCloud<glm::dvec3, double> round(sphere, access_to<Stored>(), 0.5, "test");
    separate_sheets(round, executor);
    std::size_t apart = 0, pairs = 0;
    for (std::size_t a = 0; a < round.tree().slots(); ++a)
        for (std::size_t b = 0; b < round.tree().slots(); b += 3)
            if (dot(round.normal(a), round.normal(b)) > 0.95)
                apart += !round.same_surface(a, b), ++pairs;
    CHECK(pairs > 10000);
    CHECK(apart == 0);
}

} // namespace nephroid::tests::parallel_sheets_test
