// SPDX-License-Identifier: MIT
// What second-order splatting reaches for a light with area: the ring lit by a disk. No formula is known for it, so the
// reference are fifteen times as many photons, splatted plainly, with footprints half as wide as are best for the few.
#include "common/builtin_cases.hpp"
#include "support/is_sanitized.hpp"
#include "support/vertex.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/quality/error.hpp"
#include "nephroid/quality/exposure.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::examples::area_light_test {

using tests::is_sanitized;

namespace {

using Vec = glm::vec3;

constexpr std::size_t size = 128;
constexpr std::uint64_t emitted = 87'000; // some 20,000 arrive

template <class Policies = Default, class Sequence>
[[nodiscard]] std::vector<float> picture_of(const Sequence& sequence, std::uint64_t photons,
                                            std::optional<double> smoothing = {}) {
    using Pixel = tests::Vertex<Vec>;
    const auto scene = builtin_case<float, float>("ring-disk-zoom", false).value();
    const FilmRectangle& film = scene.film;
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i < size * size; ++i)
        pixels.push_back({Vec(film.x_min + (film.x_max - film.x_min) * (double(i % size) + 0.5) / size,
                              film.y_min + (film.y_max - film.y_min) * (double(i / size) + 0.5) / size, 0)});
    const EyePathMap<Vec> map(pixels, &Pixel::position, &Pixel::normal);
    auto sums = nephroid::sums<float>(map);
    const Statistics account = nephroid::caustics(
        scene.scene, scene.light, sums,
        {.count = photons, .smoothing = smoothing, .limits = {.specular_events = 1u << 16, .roulette_after = 1u << 16}},
        sequence, Policies{});
    CHECK(std::abs(account.accounted_flux() - account.emitted.flux) <= 1e-12 * account.emitted.flux);
    std::vector<float> image(size * size);
    sums.for_each([&](std::size_t i, float irradiance) { image[i] = irradiance; });
    return image;
}

} // namespace

TEST_CASE("second order: an area light's footprints need no smoothing and beat the best there is" *
          doctest::skip(is_sanitized)) {
    const auto truth = picture_of<Published>(HaltonSequence(7), 15 * emitted, 24);
    const auto check = [&](const auto& sequence, std::initializer_list<double> smoothings) {
        const auto chosen = picture_of(sequence, emitted);
        double relative = 1e9, rmse = 1e9;
        for (const double s : smoothings) {
            const auto plain = picture_of<Published>(sequence, emitted, s);
            relative = (std::min)(relative, relative_error(plain, truth));
            rmse = (std::min)(rmse, picture_error(plain, truth, size, size).rmse);
        }
        CAPTURE(relative);
        CAPTURE(relative_error(chosen, truth));
        CAPTURE(rmse);
        CAPTURE(picture_error(chosen, truth, size, size).rmse);
        CHECK(relative_error(chosen, truth) < 1.02 * relative);
        CHECK(picture_error(chosen, truth, size, size).rmse < 0.9 * rmse);
        // And what is splatted where nobody looks for the best.
        const auto usual = picture_of<Published>(sequence, emitted);
        CHECK(relative_error(chosen, truth) < 0.7 * relative_error(usual, truth));
    };
    check(HaltonSequence(), {10, 12, 14, 16});
    check(RandomSequence(), {14, 16, 18, 20});
}

} // namespace nephroid::examples::area_light_test
