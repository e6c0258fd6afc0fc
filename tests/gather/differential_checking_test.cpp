// SPDX-License-Identifier: MIT
#include "nephroid/gather/differential_checking.hpp"

#include "gather/stored_photons.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::differential_checking_test {

using tests::complaint_of;

namespace {

/// Photons about the origin such that the estimate within the n-th is f(n): r² = (n − 1)/f(n), all of flux 1.
template <class F>
std::size_t checked(std::size_t count, const DifferentialChecking& checking, const F& f) {
    using V = glm::dvec3;
    std::vector<tests::Stored<V>> photons;
    for (std::size_t n = 1; n <= count; ++n)
        photons.push_back(tests::on_floor<V>(std::sqrt(double(n - 1) / f(double(n))), 0, 1));
    const auto map = tests::map_of_stored(photons);
    std::vector<Neighbour<double>> sorted(count);
    const V origin = map.tree().relative({0, 0, 0});
    REQUIRE(map.tree().nearest(origin, sorted) == count);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
    return detail::checked_count<V, double>(map, sorted, checking);
}

} // namespace

TEST_CASE("differential checking: even light is taken whole") {
    CHECK(checked(500, {}, [](double) { return 3.0; }) == 500);
    CHECK(checked(1, {}, [](double) { return 3.0; }) == 1);
    // Up and down by a tenth at every check: within 2.5 deviations up to 600 photons.
    CHECK(checked(512, {.growth = 2}, [](double n) { return int(std::log2(n)) % 2 == 0 ? 1.0 : 1.1; }) == 512);
}

// Checks at 32, 64, 128, 256, 512 of ln f = -0.87, -1.04, -1.21, -1.39, -1.56, in intervals of significance times
// 0.180, 0.126, 0.089, 0.063, 0.044 to either side. With 2 the first begins at -1.23 and the fourth ends at -1.26; with
// 3 the first begins at -1.41 and the fifth ends at -1.43.
TEST_CASE("differential checking: a trend beyond chance is cut before the look that the first ones contradict") {
    for (const double sign : {-1.0, 1.0}) {
        const auto trend = [sign](double n) { return std::pow(n, 0.25 * sign); };
        CHECK(checked(1000, {.growth = 2, .significance = 2}, trend) == 128);
        CHECK(checked(200, {.growth = 2, .significance = 2}, trend) == 200); // not yet: ends at -1.18
        CHECK(checked(1000, {.growth = 2, .significance = 3}, trend) == 256);
        CHECK(checked(1000, {.growth = 2, .significance = 10}, trend) == 1000);
    }
    const auto edge = [](double n) { return n <= 256 ? 1.0 : 256 / n; };
    CHECK(checked(4096, {.growth = 2}, edge) == 256); // ln 2 against 2.5 (1/16 + 1/22.6) = 0.27
}

// The interval that checks agree on is no extreme of the sequence: an early check that is off by two deviations does
// not end it.
TEST_CASE("differential checking: a look that chance has moved does not stop it") {
    const auto first_is_off = [](double n) { return n <= 32 ? 1 + 2 / std::sqrt(n) : 1.0; };
    CHECK(checked(4096, {.growth = 2}, first_is_off) == 4096);
}

namespace {

/// The estimates at many points in random photons, relative to the truth, of all photons and of those that are taken.
/// The area of the disk grows by an exponential variate with each photon.
struct EvenLight {
    double rms_of_all = 0, rms = 0;
    int cut = 0;

    /// @param dear_every  one photon in this many has a flux of 10, the others of 1; 0: none
    EvenLight(int places, std::size_t count, int dear_every, std::uint32_t seed) {
        using V = glm::dvec3;
        tests::Draws draw(seed);
        for (int place = 0; place < places; ++place) {
            std::vector<tests::Stored<V>> photons;
            std::vector<double> areas, powers{0};
            double area = 0;
            for (std::size_t n = 0; n < count; ++n) {
                area -= std::log(draw.in(0x1p-24, 1));
                const double flux = dear_every > 0 && draw.in(0, 1) * dear_every < 1 ? 10 : 1;
                photons.push_back(tests::on_floor<V>(std::sqrt(area), 0, flux));
                areas.push_back(area);
                powers.push_back(powers.back() + flux);
            }
            const auto map = tests::map_of_stored(photons);
            std::vector<Neighbour<double>> sorted(count);
            REQUIRE(map.tree().nearest(map.tree().relative({0, 0, 0}), sorted) == count);
            std::sort(sorted.begin(), sorted.end(),
                      [](const auto& a, const auto& b) { return a.distance2 < b.distance2; });
            const std::size_t taken = detail::checked_count<V, double>(map, sorted, {});
            const double mean = dear_every > 0 ? 1 + 9.0 / dear_every : 1;
            rms_of_all += square(powers[count - 1] / areas[count - 1] / mean - 1) / places;
            rms += square(powers[taken - 1] / areas[taken - 1] / mean - 1) / places;
            cut += taken < count;
        }
        rms_of_all = std::sqrt(rms_of_all);
        rms = std::sqrt(rms);
    }
};

} // namespace

// 2.1% are cut, so 4.2 of 200, which are rarely more than 12, and the rms error grows by 7%. A rule that takes the
// check where a trend began takes an extreme, and of a small count: with 3 deviations it cuts 1.4% and doubles the rms.
TEST_CASE("differential checking: even light with photons at random is hardly ever cut and its error hardly grows") {
    const EvenLight even(200, 4000, 0, 136);
    CAPTURE(even.rms_of_all);
    CAPTURE(even.rms);
    CAPTURE(even.cut);
    CHECK(even.rms_of_all == doctest::Approx(1 / std::sqrt(4000.0)).epsilon(0.2)); // 5% is a deviation
    CHECK(even.cut <= 12);
    CHECK(even.rms < 1.3 * even.rms_of_all);
}

// One photon in five carries 71% of the flux, and noise is that of 0.38 as many: intervals for their number itself
// would be those of 1.5 deviations, which cut one place in four.
TEST_CASE("differential checking: unequal fluxes are taken for the noise that they are") {
    const EvenLight even(200, 2000, 5, 132);
    CAPTURE(even.cut);
    CHECK(even.cut <= 12);
}

// A peak of 200 photons within r = 0.045, in light of 4: the estimate is (n − 1)/r², 4.5 with the 1800 within r = 20
// and 4.2 with 4000. That is 0.07 in logarithms, and the intervals are 0.06 and 0.04 to either side.
TEST_CASE("differential checking: what is finer than the resolution is averaged") {
    const auto peak = [](double n) { return n <= 200 ? 1e5 : 4 * (n - 1) / (n - 200); };
    CHECK(checked(4000, {}, peak) <= 200);
    CHECK(checked(4000, {.resolution = 20}, peak) == 4000);
    CHECK(checked(1000, {.resolution = 20}, peak) == 1000); // all of them within
}

TEST_CASE("differential checking: photons in one place tell nothing") {
    CHECK(checked(200, {}, [](double n) { return n <= 100 ? std::numeric_limits<double>::infinity() : 1.0; }) == 200);
}

TEST_CASE("differential checking: says which option cannot be") {
    const auto complaint = [](const DifferentialChecking& checking) {
        return complaint_of([&] {
            detail::check(checking, "renderer");
            return 0;
        });
    };
    CHECK(complaint({}) == "none");
    CHECK(complaint({.least = 1}).starts_with("renderer: checking.least is 1"));
    CHECK(complaint({.growth = 0.5}).starts_with("renderer: checking.growth is 0.5"));
    CHECK(complaint({.growth = 1e30}).starts_with("renderer: checking.growth is 1e+30"));
    CHECK(complaint({.significance = 0}).starts_with("renderer: checking.significance is 0"));
    CHECK(complaint({.resolution = -1}).starts_with("renderer: checking.resolution is -1"));
}

} // namespace nephroid::tests::differential_checking_test
