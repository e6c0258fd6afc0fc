// SPDX-License-Identifier: MIT
#include "nephroid/transport/ways.hpp"

#include "nephroid/vector/glm.hpp"
#include "transport/tiny_scenes.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::ways_test {

namespace {
using Way = Scattering<float, float>;
using V = glm::vec3;

struct Plain : tests::SheetScene<float> {};
struct Known : Plain {
    [[nodiscard]] Ways<Way> scatter_all(const SurfaceHit<V, Flat>&, const V&) const { return {}; }
};
struct Listed : Plain {
    [[nodiscard]] std::vector<Way> scatter_all(const SurfaceHit<V, Flat>&, const V&) const { return {}; }
};
struct OneWay : Plain {
    static constexpr bool scatters_by_chance = false;
};
struct ByChance : Plain {
    static constexpr bool scatters_by_chance = true;
};
} // namespace

static_assert(ScattersAllWays<Known, V> && ScattersDeterministically<Known, V>);
static_assert(ScattersAllWays<Listed, V>); // any list will do
static_assert(!ScattersAllWays<OneWay, V> && ScattersDeterministically<OneWay, V>);
static_assert(!ScattersDeterministically<Plain, V> && !ScattersDeterministically<ByChance, V>);

TEST_CASE("ways: none, one or two are kept in order, and more where there is room") {
    CHECK(Ways<Way>().size() == 0);
    const Ways<Way> one = Way::reflect(0.5f);
    REQUIRE(one.size() == 1);
    CHECK(one[0].weight == 0.5f);
    const Ways<Way> two{Way::reflect(0.25f), Way::refract(0.75f, 1.5f)};
    REQUIRE(two.size() == 2);
    CHECK(two[0].event == Event::reflect);
    CHECK(two[1].event == Event::refract);
    Ways<Way, 3> three;
    for (const float weight : {0.1f, 0.2f, 0.3f})
        three.add(Way::reflect(weight));
    REQUIRE(three.size() == 3);
    CHECK(three[2].weight == 0.3f);
}

} // namespace nephroid::tests::ways_test
