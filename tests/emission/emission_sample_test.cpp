// SPDX-License-Identifier: MIT
#include "nephroid/emission/emission_sample.hpp"

#include "emission/light/light_laws.hpp"

#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/sequence/halton.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <set>

namespace nephroid::tests::emission_sample_test {

using detail::draw_point;
using detail::EmissionSample;
using detail::RecordingSource;
using tests::GivenSamples;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
using Recorder = RecordingSource<Sampler<HaltonSequence>>;

template <class T>
[[nodiscard]] PointLight<Vec<T>, T> point(T intensity = 2) {
    return PointLight<Vec<T>, T>({.position = {1, 2, 3}, .intensity = intensity});
}

template <class T>
[[nodiscard]] DirectionalLight<Vec<T>, T> sun() {
    return DirectionalLight<Vec<T>, T>(
        {.direction = {0, 1, -1}, .irradiance = 1, .patch = BoundingSphere<Vec<T>>{{0, 0, 0}, 1}});
}

template <class T>
[[nodiscard]] DiskLight<Vec<T>, T> disk() {
    return DiskLight<Vec<T>, T>({.centre = {0, 0, 2}, .normal = {0, 0, -1}, .radius = 1, .radiance = 3});
}

/// What a light draws for photon i, checked against what it emits without a recorder.
template <class T, class L>
[[nodiscard]] EmissionSample sample_of(const L& light, std::uint64_t i) {
    const HaltonSequence sequence(3);
    const Spread<T> spread{T(1000), T(2)};
    Sampler<HaltonSequence> plain(sequence, i), recorded(sequence, i);
    const auto expected = light.emit(plain, spread);
    RecordingSource<Sampler<HaltonSequence>> recorder(recorded, coordinates_of<L>);
    const auto photon = light.emit(recorder, spread);
    CHECK(std::memcmp(&photon, &expected, sizeof photon) == 0);
    CHECK(recorded.dimension() == plain.dimension()); // and the walk goes on with the same numbers
    CHECK(recorder.is_complete());
    Sampler<HaltonSequence> drawn(sequence, i); // and without emitting the photon
    const EmissionSample point = draw_point(light, drawn);
    CHECK(point.light == recorder.sample().light);
    CHECK(point.coordinates == recorder.sample().coordinates);
    CHECK(point.at == recorder.sample().at);
    CHECK(point.then == recorder.sample().then);
    return recorder.sample();
}

} // namespace

TEST_CASE("emission sample: as many numbers are kept as the domain has coordinates") {
    GivenSamples given({0.25, 0.5, 0.75, 0.125, 0.625});
    RecordingSource<GivenSamples> recorder(given, 4);
    CHECK(!recorder.is_complete());
    for (const double expected : {0.25, 0.5, 0.75, 0.125, 0.625})
        CHECK(recorder.next<double>() == expected);
    CHECK(recorder.sample().at[0] == 0.25);
    CHECK(recorder.sample().at[1] == 0.5);
    CHECK(recorder.sample().then[0] == 0.75);
    CHECK(recorder.sample().then[1] == 0.125);
    CHECK(recorder.sample().coordinates == 4);
    CHECK(recorder.is_complete());
    CHECK(recorder.sample().light == 0);
    CHECK(given.drawn() == 5);
}

TEST_CASE("emission sample: a choice among lights is no coordinate of the light's own") {
    GivenSamples given({0.25, 0.5, 0.75});
    RecordingSource<GivenSamples> recorder(given, 0);
    (void)recorder.next<double>();
    recorder.chose(5, 2);
    (void)recorder.next<float>();
    (void)recorder.next<float>();
    CHECK(recorder.sample().light == 5);
    CHECK(recorder.sample().coordinates == 2);
    CHECK(recorder.sample().at[0] == 0.5);
    CHECK(recorder.sample().at[1] == 0.75);
}

TEST_CASE_TEMPLATE("emission sample: lights emit the same bits and say where in their domain", T, float, double) {
    const HaltonSequence sequence(3);
    for (std::uint64_t i = 0; i < 100; ++i) {
        const EmissionSample by_point = sample_of<T>(point<T>(), i);
        CHECK(by_point.coordinates == 2);
        CHECK(by_point.at[0] == double(sequence.sample<T>(i, 0)));
        CHECK(by_point.at[1] == double(sequence.sample<T>(i, 1)));
        CHECK(sample_of<T>(sun<T>(), i).coordinates == 2);
        CHECK(sample_of<T>(disk<T>(), i).coordinates == 4); // a place and a direction
    }
}

TEST_CASE_TEMPLATE("emission sample: of several lights the one that was chosen is kept", T, float, double) {
    using Lights = StandardLights<Vec<T>, T>;
    const Lights alone({point<T>()}), lights({point<T>(), disk<T>(), sun<T>(), point<T>(0)});
    const HaltonSequence sequence(3);
    std::set<std::uint32_t> chosen;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const EmissionSample only = sample_of<T>(alone, i);
        CHECK(only.light == 0);
        CHECK(only.coordinates == 2);
        const EmissionSample sample = sample_of<T>(lights, i);
        chosen.insert(sample.light);
        CHECK(sample.coordinates == (sample.light == 1 ? 4 : 2));
        CHECK(sample.at[0] == double(sequence.sample<T>(i, 1))); // number 0 chose the light
        CHECK(sample.at[1] == double(sequence.sample<T>(i, 2)));
        // The choice itself, by the powers.
        double up_to = double(sequence.sample<double>(i, 0)) * lights.power();
        std::uint32_t expected = 0;
        for (const auto& light : lights.lights()) {
            const double power = std::visit([](const auto& l) { return double(l.power()); }, light);
            if (up_to < power)
                break;
            up_to -= power;
            ++expected;
        }
        CHECK(sample.light == expected);
    }
    CHECK(chosen == std::set<std::uint32_t>{0, 1, 2}); // the last one is dark
}

// Photons of different lights are no neighbours, at whatever depth the lights are put together.
TEST_CASE("emission sample: lights of sets within a set keep numbers of their own") {
    using Point = PointLight<Vec<double>, double>;
    using Inner = LightSet<Point>;
    const auto at = [](double x) { return Point({.position = {x, 0, 0}, .intensity = 1}); };
    const LightSet<Inner, Point> lights({Inner({at(1), at(2), at(3)}), Inner({at(4), at(5)}), at(6), Inner({at(7)})});
    const HaltonSequence sequence(3);
    std::set<std::pair<double, std::uint32_t>> pairs;
    std::set<double> places;
    std::set<std::uint32_t> numbers;
    for (std::uint64_t i = 0; i < 500; ++i) {
        Sampler<HaltonSequence> sampler(sequence, i);
        RecordingSource<Sampler<HaltonSequence>> recorder(sampler, coordinates_of<LightSet<Inner, Point>>);
        const auto photon = lights.emit(recorder, Spread<double>{500, 1});
        CHECK(recorder.sample().coordinates == 2);
        pairs.insert({photon.position.x, recorder.sample().light});
        places.insert(photon.position.x);
        numbers.insert(recorder.sample().light);
    }
    CHECK(places.size() == 7);
    CHECK(pairs.size() == 7);
    CHECK(numbers.size() == 7);
}

} // namespace nephroid::tests::emission_sample_test
