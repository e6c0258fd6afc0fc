// SPDX-License-Identifier: MIT
// How near the smoothing that cross-validation chooses comes to the best one, which a sweep against the exact picture
// finds: for a light of which nothing is known but the photons.
#include "nephroid/smoothing/cross_validated_smoothing.hpp"

#include "common/builtin_cases.hpp"
#include "nephroid/quality/reference/ring.hpp"
#include "nephroid/quality/reference/wave.hpp"
#include "support/is_sanitized.hpp"
#include "support/vertex.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/quality/error.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace nephroid::examples::cross_validation_test {

using tests::is_sanitized;

namespace {

using Vec = glm::vec3;
using World = nephroid::examples::Scene<float, float>;

constexpr std::size_t size = 96;

struct Subject {
    World scene;
    CaseLight<float, float> light;
    FilmRectangle film;
    reference::Image exact;
};

[[nodiscard]] reference::Film reference_film(const FilmRectangle& f) {
    return {f.x_min, f.x_max, f.y_min, f.y_max, int(size), int(size)};
}

/// A tile of the wave, with as much of it lit around as its light comes from: eye vertices end with the picture.
[[nodiscard]] Subject wave(float amplitude) {
    using M = Material<float>;
    World scene({{Floor<float>(0), 0}, {SineWave<float>({.height = 1, .amplitude = amplitude}), 1}},
                std::vector<M>{M::diffuse(1), M::dielectric(1.33, false, Follow::refraction)});
    const DirectionalLight<Vec, float> sun(
        {.direction = {0, 0, -1},
         .irradiance = 1,
         .patch = Parallelogram<Vec>{{-0.25f, -0.25f, 1.25f}, {1.5f, 0, 0}, {0, 1.5f, 0}}});
    const FilmRectangle film{0, 1, 0, 1};
    return {std::move(scene), CaseLight<float, float>({sun}), film,
            reference::wave({.amplitude = double(amplitude)}, reference_film(film))};
}

[[nodiscard]] Subject ring() {
    auto builtin = builtin_case<float, float>("ring", false).value();
    return {std::move(builtin.scene), std::move(builtin.light), builtin.film,
            reference::ring({}, reference_film(builtin.film))};
}

using Pixel = tests::Vertex<Vec>;

/// What comes of the smoothing chosen, beside the best of a sweep by steps of 2^(1/4).
struct Outcome {
    double chosen, best;
    double error_ratio; ///< of the relative errors of the pictures
};

template <class Sequence>
[[nodiscard]] Outcome outcome_of(const Subject& subject, std::uint64_t emitted, const Sequence& sequence) {
    const WalkLimits limits{.specular_events = 1u << 16, .roulette_after = 1u << 16};
    std::vector<Pixel> pixels;
    const FilmRectangle& f = subject.film;
    for (std::size_t i = 0; i < size * size; ++i)
        pixels.push_back({{float(f.x_min + (f.x_max - f.x_min) * (double(i % size) + 0.5) / size),
                           float(f.y_min + (f.y_max - f.y_min) * (double(i / size) + 0.5) / size), 0.f}});
    const EyePathMap<Vec> map(pixels, &Pixel::position, &Pixel::normal);
    auto sums = nephroid::sums<float>(map);
    const auto error_at = [&](double s) {
        sums.clear();
        (void)splat_caustics(subject.scene, subject.light, sums, {.count = emitted, .smoothing = s, .limits = limits},
                             sequence);
        std::vector<float> picture(pixels.size());
        sums.for_each([&](std::size_t i, float e) { picture[i] = e; });
        return relative_error(picture, subject.exact);
    };
    Outcome outcome{cross_validated_smoothing(subject.scene, subject.light, sums, {.count = emitted, .limits = limits},
                                              Published{}, sequence),
                    0, 0};
    double least = 1e300;
    for (int step = 4; step <= 19; ++step) { // 2 to 27
        const double s = std::exp2(0.25 * step), error = error_at(s);
        if (error < least) {
            least = error;
            outcome.best = s;
        }
        if (error > 1.5 * least)
            break;
    }
    outcome.error_ratio = error_at(outcome.chosen) / least;
    return outcome;
}

/// @param factor  that s may be off by
template <class Sequence>
void check(const Subject& subject, std::uint64_t emitted, const Sequence& sequence, double factor) {
    const Outcome outcome = outcome_of(subject, emitted, sequence);
    CAPTURE(emitted);
    CAPTURE(Sequence::stratified);
    CAPTURE(outcome.chosen);
    CAPTURE(outcome.best);
    CHECK(outcome.error_ratio < 1.1);
    CHECK(outcome.chosen < factor * outcome.best);
    CHECK(outcome.chosen > outcome.best / factor);
}

// Where the error hardly depends on s, s may be off by more than the error is.
constexpr double sharp = 1.25, flat = 1.6;

} // namespace

TEST_CASE("cross-validation: of a focused wave it chooses nearly the best smoothing" * doctest::skip(is_sanitized)) {
    const Subject subject = wave(0.04f);
    check(subject, 10000, HaltonSequence(1), sharp);
    check(subject, 10000, RandomSequence(1), sharp);
}

TEST_CASE("cross-validation: of a wave before its focus it chooses nearly the best smoothing" *
          doctest::skip(is_sanitized)) {
    const Subject subject = wave(0.012f);
    check(subject, 10000, HaltonSequence(1), sharp);
    check(subject, 10000, RandomSequence(1), flat);
}

TEST_CASE("cross-validation: of the ring it chooses nearly the best smoothing" * doctest::skip(is_sanitized)) {
    const Subject subject = ring();
    check(subject, 5000, HaltonSequence(1), sharp);
    check(subject, 20000, HaltonSequence(1), flat);
    check(subject, 5000, RandomSequence(1), flat);
    check(subject, 20000, RandomSequence(1), sharp);
}

} // namespace nephroid::examples::cross_validation_test
