// SPDX-License-Identifier: MIT
#include "nephroid/gather/progressive.hpp"

#include "nephroid/gather/differential_map.hpp"
#include "nephroid/gather/fixed_range.hpp"
#include "nephroid/gather/trace_photons.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/random.hpp"

#include "gather/stored_photons.hpp"
#include "support/brute_force.hpp"
#include "support/foreign_vectors.hpp"
#include "transport/tiny_scenes.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::progressive_test {

using tests::complaint_of;
using tests::map_of_stored;
using tests::Stored;
using tests::Vertex;

namespace {

template <class V>
std::vector<Vertex<V>> grid(int n) {
    using T = scalar_t<V>;
    std::vector<Vertex<V>> all;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            all.push_back({make_vector<V>(T(0.2 + 0.6 * (i + 0.5) / n), T(0.2 + 0.6 * (j + 0.5) / n), 0),
                           make_vector<V>(0, 0, T((i + j) % 7 == 6 ? -1 : 1))});
    return all;
}

template <class V>
ProgressivePhotonMapping<V, scalar_t<V>> progressive_at(const std::vector<Vertex<V>>& vertices,
                                                        const ProgressiveOptions& options) {
    return ProgressivePhotonMapping<V, scalar_t<V>>(vertices, &Vertex<V>::position, &Vertex<V>::normal, options);
}

/// The rule as published: count all photons within the radius, shrink it, scale the flux.
template <class V>
void check_by_brute_force() {
    using T = scalar_t<V>;
    const double alpha = 0.7, start = 0.15;
    const auto vertices = grid<V>(8);
    auto progressive = progressive_at(vertices, {.radius = start, .alpha = alpha});
    std::vector<double> n(vertices.size()), r2(vertices.size(), start * start), tau(vertices.size());
    std::vector<double> doubt(vertices.size());
    for (int pass = 0; pass < 4; ++pass) {
        const std::size_t count = 300 + 100 * std::size_t(pass);
        const auto photons = tests::mixed_photons<V>(count, 101 + std::uint32_t(pass));
        progressive.add(map_of_stored(photons), count);
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            double met = 0, flux = 0;
            for (const tests::Seen& s : tests::seen_from(photons, vertices[i].position, vertices[i].normal))
                if (s.distance2 < r2[i])
                    ++met, flux += s.flux;
            if (met == 0)
                continue;
            const double kept = (n[i] + alpha * met) / (n[i] + met);
            tau[i] = (tau[i] + flux * double(count)) * kept;
            r2[i] *= kept;
            n[i] += alpha * met;
        }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        CAPTURE(i);
        CHECK(progressive.photons(i) == doctest::Approx(n[i]).epsilon(1e-12));
        CHECK(double(progressive.radius(i)) == doctest::Approx(std::sqrt(r2[i])).epsilon(1e-6));
        const double expected = tau[i] / (std::numbers::pi * r2[i] * (300 + 400 + 500 + 600));
        CHECK(std::abs(double(progressive.irradiance(i)) - expected) <=
              100 * double(std::numeric_limits<T>::epsilon()) * expected);
        CHECK(n[i] > 0);
    }
}

} // namespace

TEST_CASE_TEMPLATE("progressive: radius and flux follow Hachisuka's rule photon by photon", T, float, double) {
    check_by_brute_force<glm::vec<3, T>>();
}

TEST_CASE("progressive: takes any vector") {
    tests::for_each_vector<double>([]<class V>() { check_by_brute_force<V>(); });
}

// Even light: without bias, and with noise that falls. n photons counted are α of those met, and each met weighs as
// much as it did in its own pass, so the relative deviation stays below 1/sqrt(n); a fifth of the vertices face down.
TEST_CASE("progressive: the noise falls from pass to pass while the radius shrinks") {
    using V = glm::dvec3;
    const auto vertices = grid<V>(12);
    auto progressive = progressive_at(vertices, {.radius = 0.1});
    CHECK(progressive.irradiance(0) == 0);
    const auto error = [&] {
        double sum2 = 0;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            sum2 += square(progressive.irradiance(i) - (vertices[i].normal.z > 0 ? 1 : 0));
        return std::sqrt(sum2 / double(vertices.size()));
    };
    double first = 0;
    for (std::uint32_t pass = 0; pass < 32; ++pass) {
        progressive.add(map_of_stored(tests::random_photons<V>(1000, 200 + pass)), 1000);
        if (pass == 0)
            first = error();
    }
    // 31 photons met at first, 1000 (1/32^(1/3) of the area, 32 times the photons) α at last: 1/sqrt(31), 1/sqrt(300).
    CHECK(first > 0.1);
    CHECK(first < 0.3);
    CHECK(error() < 0.1);
    CHECK(error() < first / 2);
    CHECK(progressive.radius(0) < 0.1 * 0.7);
    CHECK(progressive.radius(0) > 0.1 * 0.4);
}

TEST_CASE("progressive: a pass in the dark halves the light of the one before") {
    using V = glm::dvec3;
    const auto vertices = grid<V>(4);
    auto progressive = progressive_at(vertices, {.radius = 0.2});
    progressive.add(map_of_stored(tests::random_photons<V>(500, 9)), 500);
    const double before = progressive.irradiance(5), radius = progressive.radius(5);
    CHECK(before > 0);
    progressive.add(map_of_stored(std::vector<Stored<V>>{}), 500);
    CHECK(progressive.irradiance(5) == doctest::Approx(before / 2));
    CHECK(progressive.radius(5) == radius);
}

TEST_CASE("progressive: several threads give the same statistics bit for bit") {
    using V = glm::vec3;
    const auto vertices = grid<V>(40);
    auto serial = progressive_at(vertices, {.radius = 0.1}), threaded = serial;
    ThreadExecutor executor(4);
    for (std::uint32_t pass = 0; pass < 3; ++pass) {
        const auto map = map_of_stored(tests::random_photons<V>(2000, 300 + pass));
        serial.add(map, 2000);
        threaded.add(map, 2000, executor);
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        REQUIRE(serial.irradiance(i) == threaded.irradiance(i));
        REQUIRE(serial.radius(i) == threaded.radius(i));
    }
}

// r²_i/r²_1 = Π (j + α)/(j + 1) = Γ(i + α)/(Γ(1 + α) Γ(i + 1)).
TEST_CASE("shrinking radius: follows Knaus and Zwicker's product") {
    for (const double alpha : {0.2, 2.0 / 3, 1.0}) {
        ShrinkingRadius radius({.radius = 3, .alpha = alpha});
        for (int i = 1; i <= 1000; ++i, radius.advance()) {
            const double r2 = 9 * std::exp(std::lgamma(i + alpha) - std::lgamma(1 + alpha) - std::lgamma(i + 1.0));
            REQUIRE(radius.radius() == doctest::Approx(std::sqrt(r2)).epsilon(1e-11));
        }
    }
}

// A mean of passes with radii that shrink: 64 passes of 500 photons each, r² down to a quarter. Each pass's estimate
// has a relative variance of 9/5 over the photons in its disk, N π r² of them.
TEST_CASE("shrinking radius: the mean of fixed ranges of all passes is the irradiance") {
    using V = glm::dvec3;
    ShrinkingRadius radius({.radius = 0.12});
    const V up{0, 0, 1};
    double sum = 0, variance = 0;
    for (std::uint32_t pass = 0; pass < 64; ++pass, radius.advance()) {
        const auto map = map_of_stored(tests::random_photons<V>(500, 400 + pass));
        const double r = radius.radius();
        sum += FixedRange(map, {.range = r})({0.5, 0.5, 0}, up) / 64;
        variance += 1.8 / (500 * std::numbers::pi * r * r) / (64 * 64);
    }
    CHECK(std::abs(sum - 1) < 4 * std::sqrt(variance));
    CHECK(4 * std::sqrt(variance) < 0.25);
}

// The splatted form: still water, passes of 1000 random photons whose smoothing shrinks. Each pass's estimate has a
// relative variance of (9/5)/s², as s² photons cover a point (the pixel filter only makes that less).
TEST_CASE("shrinking radius: footprints with a smoothing that shrinks add up to the irradiance") {
    using V = tests::Vec<double>;
    const tests::SheetScene<double> water{
        {{{0, 0, 1}, {0, 0, 1}, Event::refract, 1.0, 1, 1.33}, {{0, 0, 0}, {0, 0, 1}, Event::deposit}}};
    const DirectionalLight<V, double> lamp({{0, 0, -1}, 1.0, Parallelogram<V>{{0, 0, 2}, {1, 0, 0}, {0, 1, 0}}});
    std::vector<Vertex<V>> vertices;
    tests::add_lattice<double>(vertices, 16, 16, 0.4 / 16, {0.3125, 0.3125, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    ShrinkingRadius smoothing({.radius = 5});
    constexpr std::uint64_t passes = 20, count = 1000;
    double variance = 0, error2 = 0;
    std::vector<double> sums(vertices.size());
    for (std::uint64_t i = 0; i < passes; ++i, smoothing.advance()) {
        const auto traced = trace_photons(
            water, lamp, {.first = i * count, .count = count, .smoothing = smoothing.radius()}, RandomSequence(5));
        const DifferentialMap estimate(traced.deposits, map);
        for (std::size_t k = 0; k < sums.size(); ++k)
            sums[k] += estimate(vertices[k].position, vertices[k].normal);
        variance += 1.8 / square(smoothing.radius()) / double(passes * passes);
    }
    for (const double sum : sums)
        error2 += square(sum / double(passes) - 1) / 256;
    CHECK(std::sqrt(error2) < 1.5 * std::sqrt(variance));
    CHECK(std::sqrt(error2) > 0.3 * std::sqrt(variance));
}

TEST_CASE("progressive: says which option cannot be") {
    using V = glm::dvec3;
    const auto vertices = grid<V>(2);
    const auto complaint = [&](const ProgressiveOptions& options) {
        return complaint_of([&] { return progressive_at(vertices, options); });
    };
    CHECK(complaint({.radius = 1}) == "none");
    CHECK(complaint({.radius = 0}).starts_with("nephroid::ProgressivePhotonMapping: radius is 0"));
    CHECK(complaint({.radius = 1e-200}) == "nephroid::ProgressivePhotonMapping: radius is 1e-200, whose square the "
                                           "scalar type cannot hold; use another unit of length");
    CHECK(complaint({.radius = 1e200}).starts_with("nephroid::ProgressivePhotonMapping: radius is 1e+200, whose"));
    CHECK(complaint({.radius = 1, .alpha = 0}).find("alpha is 0") != std::string::npos);
    CHECK(complaint({.radius = 1, .alpha = 1.5}).find("alpha is 1.5") != std::string::npos);
    auto odd = vertices;
    odd[3].normal = {0, 0, 2};
    CHECK(complaint_of([&] { return progressive_at(odd, {.radius = 1}); }).find("vertex 3 ") != std::string::npos);
    odd[3] = {{std::numeric_limits<double>::quiet_NaN(), 0, 0}, {0, 0, 1}};
    CHECK(complaint_of([&] { return progressive_at(odd, {.radius = 1}); }).find("vertex 3 ") != std::string::npos);
    auto progressive = progressive_at(vertices, {.radius = 1});
    CHECK(complaint_of([&] {
              progressive.add(map_of_stored(std::vector<Stored<V>>{}), 0);
              return 0;
          }).find("emitted is 0") != std::string::npos);
    CHECK(complaint_of([] { return ShrinkingRadius({.radius = -1}); }).find("radius is -1") != std::string::npos);
    CHECK(complaint_of([] { return ShrinkingRadius({.radius = 1e-200}); }).find("whose square") != std::string::npos);
}

} // namespace nephroid::tests::progressive_test
