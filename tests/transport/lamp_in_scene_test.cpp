// SPDX-License-Identifier: MIT
// A lamp that is itself a surface of the scene: its light leaves it as reflected light does.
#include "nephroid/emission/light/disk.hpp"
#include "nephroid/emission/light/quad.hpp"
#include "nephroid/emission/light/sphere.hpp"
#include "nephroid/sequence/random.hpp"
#include "transport/follow.hpp"

namespace nephroid::tests::lamp_in_scene_test {

using tests::epsilon;
using tests::Sheet;
using tests::SheetScene;
using tests::Vec;

namespace {

/// Walks the light's photons, without splatting them.
template <class S, class L>
[[nodiscard]] Statistics fates_of(const S& scene, const L& light, int photons) {
    using T = scalar_t<typename L::vector>;
    const RandomSequence random(3);
    Statistics account;
    for (int i = 0; i < photons; ++i) {
        Sampler samples(random, std::uint64_t(i));
        const auto photon = light.emit(samples, Spread<T>{T(photons), T(1)});
        if (const auto deposit = walk(scene, photon, samples, WalkLimits{}, account))
            account.end(Fate::splatted, double(deposit->flux));
    }
    return account;
}

/// A tilted lamp far from the origin, a mirror around it on its bright side, a wall behind. What the lamp's own surface
/// is made of, and whether its normal shows to the bright side, is given.
template <class T>
[[nodiscard]] SheetScene<T> scene_with(const Vec<T>& lamp, const Vec<T>& normal, Event event, T side) {
    return {{{lamp, side * normal, event, T(1), T(1), T(1), T(2)},
             {lamp + T(3) * normal, -normal, Event::reflect},
             {lamp - T(3) * normal, normal, Event::deposit}}};
}

} // namespace

// Each photon begins on the lamp's sheet, whose distance is found with an error of either sign.
TEST_CASE_TEMPLATE("lamp in the scene: all of its light comes to the mirror, whatever the lamp is made of", T, float,
                   double) {
    const Vec<T> normal = normalize(Vec<T>{T(0.3), T(-0.5), T(0.8)});
    const auto [u, v] = frame_about(normal);
    for (const T away : {T(0), T(10), T(1000)}) {
        const Vec<T> centre{away, T(-0.7) * away, T(0.4) * away};
        const DiskLight<Vec<T>, T> disk({.centre = centre, .normal = normal, .radius = 1, .radiance = 1});
        const QuadLight<Vec<T>, T> quad({.corner = centre - T(0.5) * (u + v), .edge_u = u, .edge_v = v, .radiance = 1});
        for (const Event event : {Event::absorb, Event::deposit, Event::refract})
            for (const T side : {T(1), T(-1)}) {
                if (event == Event::refract && side < T(0))
                    continue; // glass is told from a lamp by the side that its normal is on
                CAPTURE(away);
                CAPTURE(int(event));
                CAPTURE(side);
                const auto check = [&](const auto& lamp) {
                    const Statistics account = fates_of(scene_with<T>(centre, normal, event, side), lamp, 2000);
                    CHECK(account.opaque_first == 0);
                    CHECK(account.specular_events >= 2000);
                    CHECK(account[Fate::direct].photons == 0);
                    tests::check_balance(account);
                };
                check(disk);
                check(quad);
            }
    }
}

TEST_CASE("lamp in the scene: it casts a shadow as any surface does") {
    // Off the mirror back onto the lamp, which absorbs: within a hand's breadth all of it comes back.
    const Vec<double> normal{0, 0, 1};
    SheetScene<double> scene = scene_with<double>({0, 0, 0}, normal, Event::absorb, 1);
    scene.sheets[0].radius = 0; // without end
    const DiskLight<Vec<double>, double> disk({.centre = {0, 0, 0}, .normal = normal, .radius = 1, .radiance = 1});
    const Statistics account = fates_of(scene, disk, 1000);
    CHECK(account[Fate::absorbed].photons == 1000);
    CHECK(account.specular_events == 1000);
}

TEST_CASE("lamp in the scene: a surface close to the lamp is not taken for it") {
    // The mirror touches the lamp but for a millionth.
    const Vec<double> normal{0, 0, 1};
    SheetScene<double> scene = scene_with<double>({0, 0, 0}, normal, Event::absorb, 1);
    scene.sheets[1].centre = {0, 0, 1e-6};
    const DiskLight<Vec<double>, double> disk({.centre = {0, 0, 0}, .normal = normal, .radius = 1, .radiance = 1});
    const Statistics account = fates_of(scene, disk, 1000);
    CHECK(account.specular_events == 1000);
    CHECK(account[Fate::absorbed].photons >= 999); // straight back onto the lamp
}

} // namespace nephroid::tests::lamp_in_scene_test
