// SPDX-License-Identifier: MIT
#include "nephroid/gather/nearest_photons.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include "gather/stored_photons.hpp"
#include "support/foreign_vectors.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::nearest_photons_test {

using tests::complaint_of;
using tests::Draws;
using tests::map_of_stored;
using tests::Stored;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
constexpr double epsilon = double(std::numeric_limits<T>::epsilon());

template <class V>
V up() {
    return make_vector<V>(0, 0, 1);
}

/// The estimate by sorting all photons by distance.
template <class V, class K>
tests::Expected by_sorting(const std::vector<Stored<V>>& photons, const V& place, const V& normal,
                           const NearestPhotonsOptions& options, const K& kernel) {
    auto seen = tests::seen_from(photons, place, normal);
    std::erase_if(seen, [&](const tests::Seen& s) { return std::sqrt(s.distance2) >= options.range; });
    if (seen.empty())
        return {};
    double radius2 = options.range * options.range;
    if (seen.size() >= options.count)
        radius2 = seen[options.count - 1].distance2;
    else if (std::isinf(options.range))
        radius2 = seen.back().distance2;
    return tests::disk_sum(seen, radius2, kernel, epsilon<scalar_t<V>>, options.normal_distance * std::sqrt(radius2));
}

template <class V, class K>
void check_by_sorting(const std::vector<Stored<V>>& photons, const NearestPhotonsOptions& options, K kernel) {
    using T = scalar_t<V>;
    const auto map = map_of_stored(photons);
    const NearestPhotons<V, T, K> estimate(map, options, kernel);
    Draws draw(51);
    int lit = 0;
    for (int query = 0; query < 60; ++query) {
        const V place = make_vector<V>(T(draw.in(-0.1, 1.1)), T(draw.in(-0.1, 1.1)), T(query % 3 == 0 ? 0.01 : 0));
        const V normal = query % 4 == 0 ? V(-up<V>()) : up<V>();
        const auto expected = by_sorting(photons, place, normal, options, kernel);
        CAPTURE(query);
        CAPTURE(expected.value);
        CAPTURE(options.count);
        CAPTURE(options.range);
        CAPTURE(options.normal_distance);
        CHECK(std::abs(double(estimate(place, normal)) - expected.value) <= expected.tolerance);
        lit += expected.value > 100 * expected.tolerance;
    }
    CHECK(lit > 20); // else the tolerance would prove nothing
}

} // namespace

TEST_CASE_TEMPLATE("nearest photons: the estimate is the one that sorting all photons gives", T, float, double) {
    const auto photons = tests::mixed_photons<Vec<T>>(500, 52);
    for (const std::size_t count : {2u, 7u, 50u, 399u, 3000u}) { // 400 face up, 100 down
        check_by_sorting(photons, {.count = count}, BiweightKernel{});
        check_by_sorting(photons, {.count = count}, ConeKernel{});
        check_by_sorting(photons, {.count = count}, UniformKernel{});
        check_by_sorting(photons, {.count = count, .range = 0.15}, BiweightKernel{});
        check_by_sorting(photons, {.count = count, .normal_distance = 0.1}, UniformKernel{});
    }
}

TEST_CASE_TEMPLATE("nearest photons: takes any vector", T, float, double) {
    tests::for_each_vector<T>(
        []<class V>() { check_by_sorting(tests::mixed_photons<V>(200, 53), {.count = 20}, EpanechnikovKernel{}); });
}

TEST_CASE_TEMPLATE("nearest photons: without photons and on the side without any it is dark", T, float, double) {
    using V = Vec<T>;
    const V place{T(0.5), T(0.5), 0};
    const auto nothing = map_of_stored(std::vector<Stored<V>>{});
    CHECK(NearestPhotons(nothing)(place, up<V>()) == 0);
    const auto map = map_of_stored(tests::random_photons<V>(100, 54));
    CHECK(NearestPhotons(map)(place, up<V>()) > 0);
    CHECK(NearestPhotons(map)(place, -up<V>()) == 0);
    const T nan = std::numeric_limits<T>::quiet_NaN();
    CHECK(NearestPhotons(map)({nan, 0, 0}, up<V>()) == 0);
    CHECK(NearestPhotons(map)(place, {0, nan, 1}) == 0);
}

// A photon alone has no area unless a range gives it one: Φ K(r²/R²)/R².
TEST_CASE_TEMPLATE("nearest photons: one photon lights the disk of the range", T, float, double) {
    using V = Vec<T>;
    const auto map = map_of_stored(std::vector{tests::on_floor<V>(0.25, 0.5, 2)});
    const V near{T(0.5), T(0.5), 0};
    CHECK(NearestPhotons(map)(near, up<V>()) == 0);
    const NearestPhotons ranged(map, {.range = 0.5}, EpanechnikovKernel{});
    CHECK(double(ranged(near, up<V>())) ==
          doctest::Approx(2 * 2 / std::numbers::pi * 0.75 / 0.25).epsilon(8 * epsilon<T>));
    CHECK(ranged({T(0.8), T(0.5), 0}, up<V>()) == 0);
}

// As many in one place as are asked for: the radius is what the map's positions resolve, and the estimate is large but
// a number. All in one place: there is no area anywhere.
TEST_CASE_TEMPLATE("nearest photons: coincident photons give a large finite estimate", T, float, double) {
    using V = Vec<T>;
    std::vector<Stored<V>> photons(100, tests::on_floor<V>(0.25, 0.5, 1));
    const V there{T(0.25), T(0.5), 0};
    const auto heap = map_of_stored(photons);
    const NearestPhotons from_heap(heap, {.count = 20});
    const double heap_radius = 4 * epsilon<T> * std::hypot(0.25, 0.5); // twenty with the biweight's 3/π
    CHECK(double(from_heap(there, up<V>())) ==
          doctest::Approx(20 * 3 / std::numbers::pi / (heap_radius * heap_radius)).epsilon(1e-5));
    const auto at_origin = map_of_stored(std::vector<Stored<V>>(100, tests::on_floor<V>(0, 0, 1)));
    const double bright = double(NearestPhotons(at_origin, {.count = 20})({0, 0, 0}, up<V>()));
    CHECK(std::isfinite(bright));
    CHECK(bright > 1e15);
    // All on the rim, where the biweight kernel has no more than epsilon squared left.
    CHECK(double(from_heap({T(0.5), T(0.5), 0}, up<V>())) < 20 / 0.0625 * square(epsilon<T>) * 1.01);
    photons.push_back(tests::on_floor<V>(0.5, 0.5, 1));
    const auto map = map_of_stored(photons);
    const T e = NearestPhotons(map, {.count = 20})(there, up<V>());
    const double radius = 4 * epsilon<T> * std::hypot(0.25, 0.5);
    CHECK(double(e) == doctest::Approx(20 * 3 / std::numbers::pi / (radius * radius)).epsilon(1e-5));
}

// In the middle of a square of photons: k − 1 of the k nearest count, whichever of those on the rim is the k-th. At
// r²/R² = 1/8 the Epanechnikov kernel is 2/π · 7/8.
TEST_CASE_TEMPLATE("nearest photons: of those at one distance all but one count", T, float, double) {
    using V = Vec<T>;
    std::vector<Stored<V>> photons;
    for (const double y : {-0.25, 0.25})
        for (const double x : {-0.25, 0.25})
            photons.push_back(tests::on_floor<V>(x, y, 1));
    const auto map = map_of_stored(photons);
    const double disk = std::numbers::pi * 0.125;
    const NearestPhotons all(map, {.count = 4}, UniformKernel{}), two(map, {.count = 2}, UniformKernel{});
    CHECK(double(all({0, 0, 0}, up<V>())) == doctest::Approx(3 / disk).epsilon(8 * epsilon<T>));
    CHECK(double(two({0, 0, 0}, up<V>())) == doctest::Approx(1 / disk).epsilon(8 * epsilon<T>));
    CHECK(double(all({0, 0, 0}, up<V>(), [](const V&) { return T(2); })) ==
          doctest::Approx(6 / disk).epsilon(8 * epsilon<T>));
    photons.push_back(tests::on_floor<V>(0.125, 0, 4)); // within: it counts whole, and three quarters of the others
    const auto five = map_of_stored(photons);
    const NearestPhotons with_inner(five, {.count = 5}, UniformKernel{});
    CHECK(double(with_inner({0, 0, 0}, up<V>())) == doctest::Approx(7 / disk).epsilon(8 * epsilon<T>));
    CHECK(double(NearestPhotons(five, {.count = 5}, EpanechnikovKernel{})({0, 0, 0}, up<V>())) ==
          doctest::Approx(4 * 2 * (1 - 0.125) / disk).epsilon(16 * epsilon<T>));
}

// E[1/(π R²)] = ρ/(k − 1): with k = 5 an estimate that counted the fifth would be a quarter too bright. An
// estimate's standard deviation is below 1.3 for k = 5; of 3600, each from other photons: 0.022 of the mean. Four of
// them.
TEST_CASE("nearest photons: for photons at random the mean estimate is the irradiance with any kernel") {
    using V = glm::dvec3;
    const auto check = [](auto kernel) {
        double sum = 0;
        for (const std::uint32_t seed : {61u, 62u, 63u, 64u}) {
            const auto map = map_of_stored(tests::random_photons<V>(20000, seed));
            const NearestPhotons estimate(map, {.count = 5}, kernel);
            for (int j = 0; j < 30; ++j)
                for (int i = 0; i < 30; ++i)
                    sum += estimate({0.05 + 0.03 * i, 0.05 + 0.03 * j, 0}, up<V>());
        }
        CHECK(std::abs(sum / 3600 - 1) < 0.09);
    };
    SUBCASE("constant") { check(UniformKernel{}); }
    SUBCASE("cone") { check(ConeKernel{}); }
    SUBCASE("biweight") { check(BiweightKernel{}); }
}

// Irradiance 1 + cos(2πx)/2 by inverting the distribution x + sin(2πx)/(4π). Bias goes with R² ~ k/N and noise with
// k^(−1/2): with k = N^(2/3)/2 both with N^(−1/3), a factor of 4 from 1000 to 64000.
TEST_CASE("nearest photons: the error falls with the cube root of the number of photons") {
    using V = glm::dvec3;
    const auto error = [](std::size_t count, std::uint32_t seed) {
        Draws draw(seed);
        std::vector<Stored<V>> photons;
        const double pi = std::numbers::pi;
        for (std::size_t i = 0; i < count; ++i) {
            const double u = draw.in(0, 1), y = draw.in(0, 1);
            double low = 0, high = 1;
            for (int step = 0; step < 40; ++step) {
                const double x = 0.5 * (low + high);
                (x + std::sin(2 * pi * x) / (4 * pi) < u ? low : high) = x;
            }
            photons.push_back(tests::on_floor<V>(low, y, 1 / double(count)));
        }
        const auto map = map_of_stored(photons);
        const NearestPhotons estimate(map, {.count = std::size_t(std::pow(double(count), 2.0 / 3) / 2)});
        double sum2 = 0;
        for (int j = 0; j < 20; ++j)
            for (int i = 0; i < 20; ++i) {
                const V place{0.25 + 0.025 * i, 0.25 + 0.025 * j, 0};
                sum2 += square(estimate(place, up<V>()) - (1 + 0.5 * std::cos(2 * pi * place.x)));
            }
        return std::sqrt(sum2 / 400);
    };
    const double coarse = error(1000, 71), fine = error(64000, 72);
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(fine < 0.1);
    CHECK(coarse / fine > 2.5);
    CHECK(coarse / fine < 6.5);
}

TEST_CASE("nearest photons: a response weighs each photon by where it comes from") {
    using V = glm::dvec3;
    auto photons = tests::random_photons<V>(300, 55);
    for (std::size_t i = 0; i < photons.size(); i += 2)
        photons[i].direction = {0.6, 0, -0.8};
    auto half = photons;
    for (std::size_t i = 1; i < half.size(); i += 2)
        half[i].flux = 0;
    const auto map = map_of_stored(photons), lit_by_half = map_of_stored(half);
    const V place{0.5, 0.5, 0};
    const NearestPhotons estimate(map, {.count = 40}), expected(lit_by_half, {.count = 40});
    CHECK(estimate(place, up<V>(), [](const V& d) { return d.x > 0 ? 2.0 : 0.0; }) ==
          doctest::Approx(2 * expected(place, up<V>())).epsilon(1e-12));
}

// Light on x < 1/2 only: a disk of 2000 photons, 0.1 in radius, reaches over the edge and is dimmed by what lies there.
TEST_CASE("nearest photons: differential checking keeps an edge sharper and changes nothing where light is even") {
    using V = glm::dvec3;
    auto photons = tests::random_photons<V>(60000, 56);
    std::erase_if(photons, [](const Stored<V>& p) { return p.position.x > 0.5; });
    const auto map = map_of_stored(photons);
    const NearestPhotons plain(map, {.count = 2000}), checked(map, {.count = 2000, .differential_checking = true});
    const auto error = [](const auto& estimate, double x) {
        double sum2 = 0;
        for (int i = 0; i < 60; ++i)
            sum2 += square(estimate({x, 0.15 + 0.0117 * i, 0}, up<V>()) - 1);
        return std::sqrt(sum2 / 60);
    };
    CHECK(error(plain, 0.46) > 0.15);
    CHECK(error(checked, 0.46) < 0.6 * error(plain, 0.46));
    CHECK(error(checked, 0.25) < 1.2 * error(plain, 0.25));
}

TEST_CASE("nearest photons: several threads share one estimate and agree bit for bit") {
    using V = glm::vec3;
    const auto map = map_of_stored(tests::random_photons<V>(2000, 57));
    const NearestPhotons few(map, {.count = 20}), many(map, {.count = 300});
    std::vector<float> serial(4000), threaded(4000);
    const auto fill = [&](std::vector<float>& image, auto&& executor) {
        executor(40, [&](std::size_t task) {
            for (std::size_t i = 100 * task; i < 100 * (task + 1); ++i) {
                const V place{float(i % 64) / 64, float(i / 64) / 64, 0};
                image[i] = i % 2 == 0 ? few(place, up<V>()) : many(place, up<V>());
            }
        });
    };
    fill(serial, SerialExecutor{});
    fill(threaded, ThreadExecutor(4));
    CHECK(threaded == serial);
}

TEST_CASE("nearest photons: says which option cannot be") {
    using V = glm::vec3;
    const auto map = map_of_stored(tests::random_photons<V>(10, 58));
    const auto complaint = [&](const NearestPhotonsOptions& options) {
        return complaint_of([&] { return NearestPhotons(map, options); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(complaint({.count = 1}).starts_with("nephroid::NearestPhotons: count is 1"));
    CHECK(complaint({.count = 0}).starts_with("nephroid::NearestPhotons: count is 0"));
    CHECK(complaint({.range = 0}).starts_with("nephroid::NearestPhotons: range is 0"));
    CHECK(complaint({.range = nan}).starts_with("nephroid::NearestPhotons: range is nan"));
    CHECK(complaint({.normal_distance = -1}).starts_with("nephroid::NearestPhotons: normal_distance is -1"));
    CHECK(complaint({.differential_checking = true, .checking = {.growth = 1}}).find("growth is 1") !=
          std::string::npos);
    CHECK(complaint({}) == "none");
}

} // namespace nephroid::tests::nearest_photons_test
