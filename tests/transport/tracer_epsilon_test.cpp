// SPDX-License-Identifier: MIT
// A renderer whose tracer finds nothing nearer than 0.001 to a ray's origin.
#include "transport/follow.hpp"

namespace nephroid::tests::tracer_epsilon_test {

using tests::check_balance;
using tests::check_close;
using tests::from_point;
using tests::SheetScene;

namespace {

using V = tests::Vec<double>;

constexpr double skipped = 0.001;

/// Skips what is near whatever t_min says, and says so or not.
struct Silent : SheetScene<double> {
    [[nodiscard]] auto intersect(const V& o, const V& d, double t_min, double t_max) const {
        return SheetScene<double>::intersect(o, d, (std::max)(t_min, skipped), t_max);
    }
};
struct Saying : Silent {
    double tracer_epsilon = skipped;
};

/// A mirror that a lamp almost touches, a pane of glass that almost touches the mirror's image of it, and the floor
/// closely below: each gap is a tenth of what the tracer skips.
template <class S>
[[nodiscard]] S narrow_scene() {
    constexpr double gap = skipped / 10;
    S scene;
    scene.sheets = {{{0, 0, gap}, {0, 0, -1}, Event::reflect},
                    {{0, 0, -gap}, {0, 0, 1}, Event::refract, 1, 1, 1.5},
                    {{0, 0, -2 * gap}, {0, 0, 1}, Event::deposit}};
    return scene;
}

} // namespace

// Without the epsilon the photon, its tangents and its path are those of a tracer that skips nothing.
TEST_CASE("tracer epsilon: who says so loses no surface, at the lamp nor between surfaces") {
    static_assert(HasTracerEpsilon<Saying, V> && !HasTracerEpsilon<Silent, V>);
    const auto photon = from_point<double>({0.25, -1, 0}, {1, 0.5, 2});
    Statistics exact_account, account;
    const auto exact = tests::follow(narrow_scene<SheetScene<double>>(), photon, exact_account);
    const auto found = tests::follow(narrow_scene<Saying>(), photon, account);
    REQUIRE(exact);
    REQUIRE(found);
    check_close(found->position, exact->position, 1e-14);
    check_close(found->direction, exact->direction, 1e-14);
    for (std::size_t i = 0; i < 2; ++i)
        check_close(found->d_position[i], exact->d_position[i], 1e-14);
    CHECK(account.specular_events == 2);
    CHECK(account.rays == exact_account.rays);
    CHECK(account.hits_at_start == 0);
    check_balance(account, found->flux, 1);

    Statistics silent;
    CHECK_FALSE(tests::follow(narrow_scene<Silent>(), photon, silent)); // it flies through all of them
    CHECK(silent[Fate::escaped].photons == 1);
}

TEST_CASE("tracer epsilon: over long ways it changes nothing") {
    const auto photon = from_point<double>({0.25, -1, 1}, {1, 0.5, -2});
    Statistics exact_account, account;
    Saying scene;
    scene.sheets = tests::mirror_above_floor<double>().sheets;
    const auto exact = tests::follow(tests::mirror_above_floor<double>(), photon, exact_account);
    const auto found = tests::follow(scene, photon, account);
    REQUIRE(exact);
    REQUIRE(found);
    check_close(found->position, exact->position, 1e-14);
    for (std::size_t i = 0; i < 2; ++i)
        check_close(found->d_position[i], exact->d_position[i], 1e-14);
}

} // namespace nephroid::tests::tracer_epsilon_test
