// SPDX-License-Identifier: MIT
#include "nephroid/pass/coherent_order.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/light/quad.hpp"
#include "nephroid/emission/light_set.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace nephroid::tests::coherent_order_test {

using nephroid::detail::CoherentOrder;
using nephroid::detail::EmissionSample;
using nephroid::detail::KeyedPhoton;
using nephroid::detail::RecordingSource;
using nephroid::detail::z_curve_key;

namespace {

using Vec = glm::dvec3;

DirectionalLight<Vec, double> sun() {
    return DirectionalLight<Vec, double>(
        {.direction = {0, 0, -1}, .irradiance = 1, .patch = Parallelogram<Vec>{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}});
}

PointLight<Vec, double> lamp() { return PointLight<Vec, double>({.position = {0, 0, 2}, .intensity = 3}); }

QuadLight<Vec, double> panel() {
    return QuadLight<Vec, double>({.corner = {0, 0, 2}, .edge_u = {0, 1, 0}, .edge_v = {1, 0, 0}, .radiance = 1});
}

template <class L, class Sequence>
EmissionSample sample_of(const L& light, const Sequence& sequence, std::uint64_t index) {
    Sampler<Sequence> sampler(sequence, index);
    RecordingSource<Sampler<Sequence>> recorder(sampler, coordinates_of<L>);
    (void)light.emit(recorder, Spread<double>{1, 1});
    return recorder.sample();
}

template <class L, class Sequence = HaltonSequence>
std::vector<std::uint32_t> order_of(const L& light, std::uint64_t first, std::size_t count,
                                    const Sequence& sequence = Sequence{}) {
    CoherentOrder order;
    SerialExecutor executor;
    std::vector<std::uint32_t> numbers;
    for (const KeyedPhoton& photon : order.sort(light, sequence, first, count, executor))
        numbers.push_back(photon.number);
    return numbers;
}

/// In 2^(dimensions · levels) cells, a level at a time: which of a cell's parts comes first, and the part's own place.
std::uint32_t place_by_halving(std::vector<double> at, unsigned levels) {
    if (levels == 0)
        return 0;
    std::uint32_t part = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        at[i] *= 2;
        if (at[i] >= 1) {
            part |= 1u << i;
            at[i] -= 1;
        }
    }
    const unsigned deeper = unsigned(at.size()) * (levels - 1);
    return (part << deeper) | place_by_halving(at, levels - 1);
}

/// A light without any choice: what draws no numbers has no neighbours.
struct Laser {
    using vector = Vec;
    using flux_type = double;
    template <class S>
    Photon<Vec, double> emit(S&, const Spread<double>&) const {
        return {{0, 0, 1}, {0, 0, -1}, 1, {}};
    }
    double power() const { return 1; }
};

} // namespace

TEST_CASE("coherent order: a key on the curve is found by halving the domain") {
    const RandomSequence sequence(3);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const std::array<double, 4> u = {sequence.sample<double>(i, 0), sequence.sample<double>(i, 1),
                                         sequence.sample<double>(i, 2), sequence.sample<double>(i, 3)};
        const std::uint32_t of_two = place_by_halving({u[0], u[1]}, 8),
                            of_four = place_by_halving({u.begin(), u.end()}, 4);
        const auto with_light = [](std::uint32_t place, std::uint32_t light) {
            return place / 256 * 0x1000000u + light * 0x100u + place % 256;
        };
        CHECK(z_curve_key({{u[0], u[1]}, 0, 2, {}}) == with_light(of_two, 0));
        CHECK(z_curve_key({{u[0], u[1]}, 7, 4, {u[2], u[3]}}) == with_light(of_four, 7));
    }
    CHECK(z_curve_key({{0.999, 0.999}, 0x12345, 2, {}}) == 0xff2345ffu);
}

TEST_CASE("coherent order: invalid numbers count as the first cell") {
    for (const double bad : {1.0, -0.1, 1e300, -std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        CHECK(z_curve_key({{bad, bad}, 0, 2, {}}) == 0);
}

TEST_CASE_TEMPLATE("coherent order: sorts by key and keeps the order of indices for equal keys", Sequence,
                   HaltonSequence, RandomSequence) {
    const Sequence sequence(7);
    const auto check = [&](const auto& light, std::size_t count) {
        const std::uint64_t first = 123;
        std::vector<std::uint32_t> expected(count);
        std::iota(expected.begin(), expected.end(), 0u);
        std::stable_sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
            return z_curve_key(sample_of(light, sequence, first + a)) <
                   z_curve_key(sample_of(light, sequence, first + b));
        });
        CHECK(order_of(light, first, count, sequence) == expected);
    };
    for (const std::size_t count : {0u, 1u, 2u, 1000u, 3000u}) {
        check(sun(), count);
        check(panel(), count);
        check(LightSet<DirectionalLight<Vec, double>, PointLight<Vec, double>>({sun(), lamp(), sun()}), count);
    }
}

TEST_CASE("coherent order: within each part of the domain the photons of a light are together") {
    const LightSet<DirectionalLight<Vec, double>, PointLight<Vec, double>> lights({sun(), lamp(), sun()});
    constexpr std::size_t count = 40'000;
    std::size_t changes = 0;
    std::uint32_t last = 0;
    for (const std::uint32_t i : order_of(lights, 0, count)) {
        const std::uint32_t light = sample_of(lights, HaltonSequence{}, i).light;
        changes += light != last;
        last = light;
    }
    CHECK(changes <= 3 * 256);
    CHECK(changes > 3 * 200); // each of 256 parts has photons of all three
}

TEST_CASE("coherent order: photons of a light that draws nothing stay in the order of their indices") {
    const auto order = order_of(Laser{}, 50, 100);
    for (std::uint32_t i = 0; i < 100; ++i)
        CHECK(order[i] == i);
}

// Points of a stratified sequence lie 1/√n apart. Along the curve half of the steps go to the next cell in x, a
// quarter one down and one back, an eighth to the cell after the last in x, and so on: 1.67 cells in the mean. In any
// order that knows nothing of places the mean step is the mean distance of two points in the unit square, 0.52.
TEST_CASE("coherent order: successive photons start close together") {
    constexpr std::size_t count = 4096;
    const auto mean_step = [&](const std::vector<std::uint32_t>& order) {
        double sum = 0;
        for (std::size_t i = 1; i < count; ++i) {
            const auto a = sample_of(sun(), HaltonSequence{}, order[i - 1]).at,
                       b = sample_of(sun(), HaltonSequence{}, order[i]).at;
            sum += std::hypot(a[0] - b[0], a[1] - b[1]);
        }
        return sum / double(count - 1);
    };
    std::vector<std::uint32_t> by_index(count);
    std::iota(by_index.begin(), by_index.end(), 0u);
    const double spacing = 1 / std::sqrt(double(count));
    CHECK(mean_step(by_index) > 0.4);
    CHECK(mean_step(order_of(sun(), 0, count)) < 2.5 * spacing);
}

TEST_CASE("coherent order: several threads find the same order") {
    CoherentOrder one, other;
    SerialExecutor serial;
    ThreadExecutor threads(3);
    const HaltonSequence sequence;
    for (const std::size_t count : {5000u, 1500u}) { // the second one in the memory of the first
        const auto a = one.sort(sun(), sequence, 9, count, serial);
        const auto b = other.sort(sun(), sequence, 9, count, threads);
        CHECK(std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const KeyedPhoton& p, const KeyedPhoton& q) {
            return p.key == q.key && p.number == q.number;
        }));
    }
}

} // namespace nephroid::tests::coherent_order_test
