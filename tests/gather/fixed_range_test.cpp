// SPDX-License-Identifier: MIT
#include "nephroid/gather/fixed_range.hpp"

#include "gather/stored_photons.hpp"
#include "support/foreign_vectors.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::fixed_range_test {

using tests::complaint_of;
using tests::Draws;
using tests::map_of_stored;
using tests::Stored;

namespace {

template <class V, class K>
void check_by_brute_force(const std::vector<Stored<V>>& photons, const FixedRangeOptions& options, K kernel) {
    using T = scalar_t<V>;
    const auto map = map_of_stored(photons);
    const FixedRange<V, T, K> estimate(map, options, kernel);
    Draws draw(81);
    int lit = 0;
    for (int query = 0; query < 60; ++query) {
        const V place = make_vector<V>(T(draw.in(-0.1, 1.1)), T(draw.in(-0.1, 1.1)), T(query % 3 == 0 ? 0.01 : 0));
        const V normal = make_vector<V>(0, 0, T(query % 4 == 0 ? -1 : 1));
        const auto seen = tests::seen_from(photons, place, normal);
        const auto expected =
            tests::disk_sum(seen, options.range * options.range, kernel, double(std::numeric_limits<T>::epsilon()),
                            options.normal_distance * options.range);
        CAPTURE(query);
        CAPTURE(expected.value);
        CHECK(std::abs(double(estimate(place, normal)) - expected.value) <= expected.tolerance);
        lit += expected.value > 100 * expected.tolerance;
    }
    CHECK(lit > 20); // else the tolerance would prove nothing
}

} // namespace

TEST_CASE_TEMPLATE("fixed range: adds up what brute force adds up", T, float, double) {
    const auto photons = tests::mixed_photons<glm::vec<3, T>>(500, 82);
    for (const double range : {0.08, 0.3, 5.0}) {
        check_by_brute_force(photons, {.range = range}, BiweightKernel{});
        check_by_brute_force(photons, {.range = range}, ConeKernel{});
        check_by_brute_force(photons, {.range = range}, UniformKernel{});
        check_by_brute_force(photons, {.range = range, .normal_distance = 0.05}, EpanechnikovKernel{});
    }
}

TEST_CASE_TEMPLATE("fixed range: takes any vector", T, float, double) {
    tests::for_each_vector<T>(
        []<class V>() { check_by_brute_force(tests::mixed_photons<V>(200, 83), {.range = 0.2}, BiweightKernel{}); });
}

// A kernel of radius 8 spacings, added up over a lattice of places: the biweight's transform falls like the 7/2-th
// power, so that the sum is the integral, the photons' flux, to 1e-4 (48 |J₃(ω)|/ω³ at ω = 16π: 5e-5, four of
// them).
TEST_CASE("fixed range: keeps the light's energy") {
    using V = glm::dvec3;
    std::vector<Stored<V>> photons;
    Draws draw(84);
    double flux = 0;
    for (int i = 0; i < 100; ++i) {
        photons.push_back(tests::on_floor<V>(draw.in(0.3, 0.7), draw.in(0.3, 0.7), draw.in(0.5, 1)));
        flux += photons.back().flux;
    }
    const auto map = map_of_stored(photons);
    const FixedRange estimate(map, {.range = 0.125});
    double sum = 0;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i)
            sum += estimate({(i + 0.5) / 64, (j + 0.5) / 64, 0}, {0, 0, 1}) / 4096;
    CHECK(std::abs(sum / flux - 1) < 2e-4);
}

TEST_CASE_TEMPLATE("fixed range: is dark without photons or near enough ones or a place", T, float, double) {
    using V = glm::vec<3, T>;
    const V up{0, 0, 1};
    const auto nothing = map_of_stored(std::vector<Stored<V>>{});
    CHECK(FixedRange(nothing, {.range = 1})({0, 0, 0}, up) == 0);
    const auto one = map_of_stored(std::vector{tests::on_floor<V>(0, 0, 1)});
    const FixedRange estimate(one, {.range = 1}, UniformKernel{});
    CHECK(double(estimate({T(0.5), 0, 0}, up)) == doctest::Approx(1 / std::numbers::pi));
    CHECK(estimate({T(1.5), 0, 0}, up) == 0);
    CHECK(estimate({T(0.5), 0, 0}, -up) == 0);
    for (const T bad : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
        CHECK(estimate({bad, 0, 0}, up) == 0);
        CHECK(estimate({0, -bad, 0}, up) == 0);
    }
    CHECK(estimate({0, 0, 0}, {0, 0, std::numeric_limits<T>::quiet_NaN()}) == 0);
    CHECK(double(estimate({0, 0, 0}, up, [](const V& d) { return d.z < 0 ? T(3) : T(0); })) ==
          doctest::Approx(3 / std::numbers::pi));
}

TEST_CASE("fixed range: says which option cannot be") {
    using V = glm::vec3;
    const auto map = map_of_stored(tests::random_photons<V>(10, 85));
    const auto complaint = [&](const FixedRangeOptions& options) {
        return complaint_of([&] { return FixedRange(map, options); });
    };
    CHECK(complaint({.range = 1}) == "none");
    CHECK(complaint({.range = 0}).starts_with("nephroid::FixedRange: range is 0"));
    CHECK(complaint({.range = 1e-200}).starts_with("nephroid::FixedRange: range is 1e-200, whose square"));
    CHECK(complaint({.range = 1e200}).starts_with("nephroid::FixedRange: range is 1e+200, whose square"));
    CHECK(complaint({.range = std::numeric_limits<double>::infinity()}).find("range is inf") != std::string::npos);
    CHECK(complaint({.range = 1, .normal_distance = 0}).find("normal_distance is 0") != std::string::npos);
}

} // namespace nephroid::tests::fixed_range_test
