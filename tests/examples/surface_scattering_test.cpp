// SPDX-License-Identifier: MIT
#include "common/scene.hpp"

#include "nephroid/transport/ways.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::examples::surface_scattering_test {

using nephroid::Event;

namespace {

using V = Vec3<double>;
using M = Material<double>;
using S = Scene<double, double>;

static_assert(nephroid::ScattersAllWays<Scene<float>, Vec3<float>>);

/// Gives one number again and again.
struct OneNumber {
    double number;
    template <class T>
    [[nodiscard]] T next() {
        return T(number);
    }
};

/// The light that goes each way, by event. Light that a mixture's diffuse part receives counts as deposited, whatever
/// its albedo. What misses a surface and what is refracted have one event; they differ by `eta`.
struct Flow {
    double missed = 0, reflected = 0, refracted = 0, deposited = 0, passed = 0;

    void add(const Bounce<double, double>& way, double share, bool is_only_way) {
        if (way.event == Event::reflect)
            reflected += share * way.weight;
        else if (way.event == Event::refract)
            (way.eta == 1 ? missed : refracted) += share * way.weight;
        else if (way.event == Event::deposit)
            deposited += share * way.weight;
        else if (way.event == Event::diffuse)
            deposited += is_only_way ? share : 0;
        else if (way.event == Event::pass)
            passed += share * way.weight;
    }
};

[[nodiscard]] std::vector<M> materials() {
    std::vector<M> all{M::diffuse(0.7),           M::mirror(0.9), M::dielectric(1.5),
                       M::dielectric(1.5, false), M::window(1.5), M::dielectric(1.5, true, Follow::refraction),
                       M::conductor(0.2, 3.5),    M::black()};
    const std::size_t whole = all.size();
    for (std::size_t i = 0; i < whole; ++i) {
        M holed = all[i];
        holed.coverage = 0.6;
        all.push_back(holed);
        M dull = all[i];
        dull.transmission = 0.3;
        dull.color = 0.8;
        all.push_back(dull);
    }
    return all;
}

} // namespace

// The numbers lie in the middles of equal intervals: a way's share is off by half of one at each of its two ends.
TEST_CASE("surface scattering: all ways carry what is drawn by chance on average") {
    constexpr int numbers = 4000;
    const std::vector<M> all = materials();
    for (std::size_t i = 0; i < all.size(); ++i) {
        CAPTURE(i);
        const S scene({{Sphere<double>({0, 0, 0}, 1), 0}}, {all[i]});
        for (const double x : {0.05, 0.6, 0.8})
            for (const bool from_within : {false, true}) {
                CAPTURE(x);
                CAPTURE(from_within);
                const V direction(0, 0, from_within ? 1 : -1);
                const auto hit = scene.intersect(V(x, 0, from_within ? 0 : 3), direction, 0, 10);
                REQUIRE(hit);
                Medium medium;
                if (from_within && all[i].surface == Surface::dielectric)
                    medium.enter(0, 0);
                const auto ways = scene.scatter_all(*hit, direction, medium);
                Flow together, drawn;
                for (std::size_t way = 0; way < ways.size(); ++way)
                    together.add(ways[way], 1, ways.size() == 1);
                for (int k = 0; k < numbers; ++k) {
                    OneNumber sampler{(k + 0.5) / numbers};
                    drawn.add(scene.scatter(*hit, direction, sampler, medium), 1.0 / numbers, true);
                }
                constexpr double tolerance = 1.0 / numbers + 1e-12;
                CHECK(std::abs(together.missed - drawn.missed) <= tolerance);
                CHECK(std::abs(together.reflected - drawn.reflected) <= tolerance);
                CHECK(std::abs(together.refracted - drawn.refracted) <= tolerance);
                CHECK(std::abs(together.deposited - drawn.deposited) <= tolerance);
                CHECK(std::abs(together.passed - drawn.passed) <= tolerance);
            }
    }
}

} // namespace nephroid::examples::surface_scattering_test
