// SPDX-License-Identifier: MIT
#include "common/study/judge/scenes.hpp"

#include "nephroid/gather/trace_photons.hpp"

#include <doctest/doctest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nephroid::examples::study::judge_test {

namespace {

using namespace nephroid::examples::study::judge;

/// Where the caustic photons of a scene land, of 500.
[[nodiscard]] std::vector<Vec3<float>> landed(std::size_t kind, std::size_t lamp, std::uint64_t seed) {
    const auto one = scene_of(kind, lamp, seed);
    std::vector<Vec3<float>> places;
    for (const auto& photon : trace_photons(one.scene, one.light, {.count = 500}).deposits)
        places.push_back(photon.position);
    return places;
}

} // namespace

TEST_CASE("study judge: every kind of scene is lit under every lamp") {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (std::size_t lamp = 0; lamp < lamps.size(); ++lamp)
            for (const std::uint64_t seed : {1u, 12u}) {
                CAPTURE(kinds[kind]);
                CAPTURE(lamps[lamp]);
                const auto film = scene_of(kind, lamp, seed).film;
                std::size_t seen = 0;
                for (const Vec3<float>& x : landed(kind, lamp, seed))
                    seen += std::size_t(double(x.x) > film.x_min && double(x.x) < film.x_max &&
                                        double(x.y) > film.y_min && double(x.y) < film.y_max);
                CHECK(seen > 25);
            }
}

TEST_CASE("study judge: a seed makes the same scene again, and another seed another one") {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        CAPTURE(kinds[kind]);
        CHECK(landed(kind, 0, 3) == landed(kind, 0, 3));
        CHECK(landed(kind, 0, 3) != landed(kind, 0, 4));
    }
}

} // namespace nephroid::examples::study::judge_test
