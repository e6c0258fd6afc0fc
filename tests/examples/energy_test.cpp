// SPDX-License-Identifier: MIT
// What a picture's pixels add up to, against the flux of the photons that were splatted whole onto the film: over all
// exact cases, footprints from far below a pixel to half the film.
#include "common/builtin_cases.hpp"
#include "support/is_sanitized.hpp"
#include "support/vertex.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace nephroid::examples::energy_test {

using nephroid::tests::is_sanitized;

namespace {

using Vec = glm::vec3;

using Pixel = tests::Vertex<Vec>;

struct Energy {
    double flux = 0;    ///< of the photons whose footprints lie on the film whole
    double picture = 0; ///< sum of the pixels times their area
    [[nodiscard]] double error() const { return picture / flux - 1; }
};

/// @param filter  of pixels, 1 or 0
[[nodiscard]] Energy splat_whole(const BuiltinCase<float, float>& scene, std::uint64_t photons, double smoothing,
                                 std::size_t size, double filter) {
    const FilmRectangle& film = scene.film;
    const double dx = (film.x_max - film.x_min) / double(size), dy = (film.y_max - film.y_min) / double(size);
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i < size * size; ++i)
        pixels.push_back({{float(film.x_min + (double(i % size) + 0.5) * dx),
                           float(film.y_min + (double(i / size) + 0.5) * dy), 0.f}});
    const EyePathMap map(pixels, &Pixel::position, &Pixel::normal);
    const Default policies{.filter = {filter}};
    auto sums = nephroid::sums<float>(map);
    nephroid::detail::Splatter splatter(sums, policies);
    std::vector<nephroid::detail::SplatChunk<Vec, float>> chunk(1);
    SerialExecutor executor;

    Energy energy;
    const HaltonSequence sequence;
    const Spread<float> spread{float(photons), float(smoothing)};
    const nephroid::Box<float>& bounds = map.tree().bounds();
    for (std::uint64_t i = 0; i < photons; ++i) {
        Sampler<HaltonSequence> sampler(sequence, i);
        Statistics account;
        const auto photon = scene.light.emit(sampler, spread);
        const auto deposit = walk(scene.scene, photon, sampler, {.specular_events = 1u << 16}, account);
        if (deposit) {
            // A photon without a splat keeps its flux, and the picture lacks it.
            const auto outcome = make_splat(*deposit, map, policies);
            const Vec at = map.tree().relative(deposit->position);
            const nephroid::Box<float> box =
                outcome.splat ? outcome.splat->box : nephroid::Box<float>{{at.x, at.y, 0}, {at.x, at.y, 0}};
            if (box.low[0] >= bounds.low[0] && box.low[1] >= bounds.low[1] && box.high[0] <= bounds.high[0] &&
                box.high[1] <= bounds.high[1]) {
                energy.flux += double(deposit->flux);
                splatter.prepare(*deposit, chunk[0], account);
            }
        }
        if (chunk[0].visits().size() > 100000 || i + 1 == photons) {
            splatter.add(std::span<const nephroid::detail::SplatChunk<Vec, float>>(chunk), executor);
            chunk[0].clear();
        }
    }
    sums.for_each([&](std::size_t, float irradiance) { energy.picture += double(irradiance) * dx * dy; });
    return energy;
}

} // namespace

// A splat of the filter's least size gains or loses up to 0.43 of its flux with where it lies between the pixels
// (1.43 at a vertex: the biweight's peak over 0.816²); over many places that averages out. A tenth of the ball's light
// falls within one pixel of its axis, at 64 x 64: 0.043 if all of it were off the same way. A hundredth says that it is
// not.
TEST_CASE("energy: with the pixel filter a picture keeps its photons' flux to a hundredth in the worst case" *
          doctest::skip(is_sanitized)) {
    for (const std::string_view name : builtin_case_names)
        for (const std::size_t size : {64u, 256u})
            for (const double smoothing : {1.0, 5.0, 20.0}) {
                const auto scene = builtin_case<float, float>(name, false);
                const Energy energy = splat_whole(*scene, 20000, smoothing, size, 1);
                CAPTURE(std::string(name));
                CAPTURE(size);
                CAPTURE(smoothing);
                CHECK(energy.flux > 0);
                CHECK(std::abs(energy.error()) < 0.01);
                if (name.starts_with("wave-prefocal")) // no fold: no footprint thinner than its neighbours
                    CHECK(std::abs(energy.error()) < 0.001);
            }
}

// At 1.244 times the width the biweight's Fourier transform, J3(k)/k³, has its first zero at the pixels' frequency:
// k = 2 pi 1.244 0.8165 = 6.380. What is left is the ripple along the diagonals, an order of magnitude less.
TEST_CASE("energy: a filter at the zero of the kernel's transform keeps the flux ten times better" *
          doctest::skip(is_sanitized)) {
    double plain = 0, wide = 0;
    for (const std::string_view name : {"ball", "ball-point", "ring"}) {
        const auto scene = builtin_case<float, float>(name, false);
        plain += std::abs(splat_whole(*scene, 20000, 1, 64, 1).error());
        wide += std::abs(splat_whole(*scene, 20000, 1, 64, 1.244).error());
    }
    CHECK(wide < 0.2 * plain);

    // The figure that the README gives, held for each case, film and smoothing of the test above.
    for (const std::string_view name : builtin_case_names)
        for (const std::size_t size : {64u, 256u})
            for (const double smoothing : {1.0, 5.0, 20.0}) {
                const auto scene = builtin_case<float, float>(name, false);
                CAPTURE(std::string(name));
                CAPTURE(size);
                CAPTURE(smoothing);
                CHECK(std::abs(splat_whole(*scene, 20000, smoothing, size, 1.244).error()) < 0.002);
            }
}

TEST_CASE("energy: without the pixel filter light falls between the pixels at folds") {
    // The finer the footprints the more is lost; the ring's cusp is the worst (mathematics.md: 0.5 to 4.8%).
    const auto scene = builtin_case<float, float>("ring-zoom", false);
    CHECK(std::abs(splat_whole(*scene, 100000, 1, 64, 0).error()) >
          5 * std::abs(splat_whole(*scene, 100000, 1, 64, 1).error()));
}

// On request, --no-skip: the whole table, minutes.
TEST_CASE("energy: the table of all cases, smoothings, photons and films" * doctest::skip()) {
    std::printf("%-14s %8s %5s %5s %11s %11s\n", "case", "photons", "s", "film", "with", "without");
    double worst = 0;
    for (const std::string_view name : builtin_case_names)
        for (const std::uint64_t photons : {1000u, 20000u, 1000000u})
            for (const double smoothing : {1.0, 5.0, 15.0, 50.0})
                for (const std::size_t size : {64u, 256u, 1024u}) {
                    if (double(size * size) * smoothing * smoothing > 1e9) // would take hours to say the same
                        continue;
                    const auto scene = builtin_case<float, float>(name, false);
                    const Energy with = splat_whole(*scene, photons, smoothing, size, 1);
                    const Energy without = splat_whole(*scene, photons, smoothing, size, 0);
                    if (!(with.flux > 0))
                        continue; // no footprint lies on the film whole
                    std::printf("%-14s %8llu %5g %5zu %+10.4f%% %+10.4f%%\n", std::string(name).c_str(),
                                static_cast<unsigned long long>(photons), smoothing, size, 100 * with.error(),
                                100 * without.error());
                    worst = (std::max)(worst, std::abs(with.error()));
                }
    std::printf("worst with the pixel filter: %.4f%%\n", 100 * worst);
}

} // namespace nephroid::examples::energy_test
