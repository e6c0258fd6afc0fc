// SPDX-License-Identifier: MIT
#include "nephroid/tree/normal_cone.hpp"

#include "support/space.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::normal_cone_test {

namespace {

template <class T>
Box<T> bounds_of(const std::vector<glm::vec<3, T>>& normals) {
    Box<T> box = detail::empty_box<T>();
    for (const auto& n : normals)
        box.add({{n.x, n.y, n.z}, {n.x, n.y, n.z}});
    return box;
}

} // namespace

TEST_CASE_TEMPLATE("normal cone: never says that none or all face where brute force knows better", T, float, double) {
    using V = glm::vec<3, T>;
    tests::Draws draw(51);
    int none = 0, all = 0;
    for (int round = 0; round < 4000; ++round) {
        const tests::Space middle = draw.direction();
        const tests::Wide size = tests::Wide(std::exp2(draw.in(-20, 1)));
        std::vector<V> normals;
        for (int i = 0; i < 5; ++i)
            normals.push_back(tests::narrow<V>((middle + size * draw.in_cube()).unit()));
        const NormalCone<T> cone = detail::cone_about(bounds_of<T>(normals));
        // Half of the directions along the border of those that face.
        tests::Space towards = draw.direction();
        if (round % 2 == 0)
            towards = (towards.across(middle) + size * draw.in_cube()).unit();
        const V d = tests::narrow<V>(towards);
        int facing = 0;
        for (const V& n : normals)
            facing += n.x * d.x + n.y * d.y + n.z * d.z > T(0);
        const auto said = cone.facing(d.x, d.y, d.z);
        REQUIRE((said.some || facing == 0));
        REQUIRE((!said.all || facing == 5));
        none += !said.some, all += said.all;
    }
    CHECK(none > 1000); // it tells, mostly
    CHECK(all > 1000);
}

TEST_CASE("normal cone: of equal normals says what each of them says") {
    const glm::vec3 n(0.6f, 0, 0.8f), across(0.8f, 0, -0.6f);
    const NormalCone<float> cone = detail::cone_about(bounds_of<float>({n, n, n}));
    CHECK(cone.spread == 0);
    const float product = across.x * n.x + across.z * n.z; // 0 but for rounding
    CHECK(cone.facing(across.x, across.y, across.z).some == (product > 0));
    CHECK(cone.facing(across.x, across.y, across.z).all == (product > 0));
}

} // namespace nephroid::tests::normal_cone_test
