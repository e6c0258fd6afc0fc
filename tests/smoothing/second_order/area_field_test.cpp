// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/area_field.hpp"

#include "smoothing/second_order/area_maps.hpp"
#include "support/space.hpp"

#include "nephroid/execution/executor.hpp"
#include "nephroid/smoothing/second_order/second_order.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <optional>

namespace nephroid::tests::area_field_test {

using namespace nephroid::detail;
using tests::AreaLamp;
using tests::AreaLanding;
using tests::AreaPhoton;

namespace {

using D = glm::dvec3;

/// F quadratic in all four coordinates, with every second derivative of its own.
[[nodiscard]] AreaLanding quadratic(const AreaSample& u) {
    AreaLanding landing{{0, 0, 0}, {{{2, 0.2, 0}, {0.1, 1.5, 0}, {3, -0.3, 0}, {0.4, 2.5, 0}}}};
    for (std::size_t i = 0; i < 4; ++i) {
        landing.position += u[i] * landing.slopes[i];
        for (std::size_t j = 0; j < 4; ++j) {
            const D second(0.05 * double(1 + i + j), 0.03 * double(i * j) - 0.1, 0); // symmetric in i and j
            landing.position += 0.5 * u[i] * u[j] * second;
        }
    }
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            landing.slopes[i] += u[j] * D(0.05 * double(1 + i + j), 0.03 * double(i * j) - 0.1, 0);
    return landing;
}

/// e_a · ∇ t_b of that map, for place and direction changing together.
[[nodiscard]] D second_of_quadratic(std::size_t a, std::size_t b) {
    D sum(0);
    for (const std::size_t i : {a, a + 2})
        for (const std::size_t j : {b, b + 2})
            sum += D(0.05 * double(1 + i + j), 0.03 * double(i * j) - 0.1, 0);
    return sum;
}

[[nodiscard]] SecondOrderFootprints<D> footprints_of(const std::vector<AreaPhoton>& pilot,
                                                     const SecondOrderFootprints<D>::Options& options) {
    SerialExecutor executor;
    return SecondOrderFootprints<D>(std::span<const AreaPhoton>(pilot), options, executor);
}

/// The mean of exp(−(x − 1)²/(2 · 0.05)) over a splat of the biweight: along x its profile is 16/(5π) (1 −
/// z²)^(5/2), and with z = cos θ the trapezoidal rule is exact for polynomials of degree 25.
[[nodiscard]] double seen(double centre, double radius) {
    constexpr int n = 32;
    double sum = 0, weights = 0;
    for (int i = 0; i < n; ++i) {
        const double theta = pi<double> * (i + 0.5) / n, weight = std::pow(std::sin(theta), 6);
        sum += weight * std::exp(-square(centre + radius * std::cos(theta) - 1) / 0.1);
        weights += weight;
    }
    return sum / weights;
}

struct Bias {
    double first, second;
};

/// How much more of a window about x = 1 splats light than the photons do, relatively.
[[nodiscard]] Bias bias_of(double reach, int steps) {
    const AreaLamp lamp{.width = 4, .unit = 0.01};
    const auto pilot = lamp.photons(tests::spheres, 4096);
    const auto footprints =
        footprints_of(pilot, {.policy = {.largest_shift = 1e9}, .smoothing = reach / lamp.unit, .photons = 4096});
    double truth = 0, first = 0, second = 0;
    // Nothing depends on d_y, and p_y and −p_y tell the same.
    for (int i = 0; i < steps; ++i)
        for (int j = steps / 2; j < steps; ++j)
            for (int k = 0; k < steps; ++k) {
                const AreaSample at{(i + 0.5) / steps, (j + 0.5) / steps, (k + 0.5) / steps, 0.5};
                AreaPhoton photon = lamp.photon(tests::spheres, at);
                const double x = photon.deposit->position.x;
                if (x > 2.9)
                    continue; // out of the window's sight, and near the domain's border
                const auto& d = photon.deposit->d_position;
                const double radius = reach / lamp.unit * 0.5 * std::hypot(d[0].x, d[1].x);
                truth += std::exp(-square(x - 1) / 0.1);
                first += seen(x, radius);
                (void)footprints.apply(photon);
                second += seen(photon.deposit->position.x, 0.5 * std::hypot(d[0].x, d[1].x));
            }
    return {first / truth - 1, second / truth - 1};
}

} // namespace

// The derivation in area_field.hpp: the bias is ½ ∂² of m₂ k² ∫ |t_x|² δ = 8π x^(3/2) m₂ k², so 3π/8
// k² x^(−1/2) against an irradiance of 2π x^(1/2), over the window g = exp(−10 (x − 1)²), once each is
// weighted with it. A shift leaves k⁴ and k⁶ terms.
TEST_CASE("area field: the bias falls with the fourth power of the smoothing and not with its square") {
    double expected = 0, light = 0;
    for (double x = 5e-4; x < 3; x += 1e-3) {
        const double window = std::exp(-square(x - 1) / 0.1);
        expected += window * 3 * pi<double> / 8 / std::sqrt(x);
        light += window * 2 * pi<double> * std::sqrt(x);
    }
    expected /= light;
    const Bias narrow = bias_of(0.06, 48), wide = bias_of(0.12, 48);
    CAPTURE(narrow.first);
    CAPTURE(wide.first);
    CAPTURE(narrow.second);
    CAPTURE(wide.second);
    CHECK(narrow.first == doctest::Approx(expected * square(0.06)).epsilon(0.05));
    CHECK(std::abs(std::log2(wide.first / narrow.first) - 2) < 0.1);
    CHECK(std::abs(std::log2(wide.second / narrow.second) - 4) < 0.3);
    CHECK(std::abs(narrow.second) < std::abs(narrow.first) / 20);
}

// Second derivatives are constant, so that fits have nothing to err about but rounding, whatever cells they are made
// in.
TEST_CASE("area field: the second derivatives along the tangents are those of the map") {
    for (const double turn : {0.0, 0.7}) {
        const AreaLamp lamp{.width = 1, .unit = 0.01, .turn = turn};
        auto photons = lamp.photons(quadratic, 3000);
        SerialExecutor executor;
        const AreaField field(photons, {.smoothing = 7, .photons = 3000}, executor);
        const double c = std::cos(turn), s = std::sin(turn);
        const auto along = [&](std::array<double, 2> a, std::array<double, 2> b) {
            D sum(0);
            for (std::size_t i = 0; i < 2; ++i)
                for (std::size_t j = 0; j < 2; ++j)
                    sum += a[i] * b[j] * second_of_quadratic(i, j);
            return square(lamp.unit) * sum;
        };
        const std::array<D, 3> expected{along({c, s}, {c, s}), along({c, s}, {-s, c}), along({-s, c}, {-s, c})};
        for (std::size_t i = 0; i < photons.size(); i += 7) {
            const auto said = field.at(photons[i].sample, photons[i].frame, photons[i].signature);
            REQUIRE(said);
            CHECK(said->shape.xx == doctest::Approx(49).epsilon(1e-12));
            CHECK(std::abs(said->shape.xy) < 1e-12);
            CHECK(std::abs(said->divergence.x) + std::abs(said->divergence.y) < 1e-9);
            for (std::size_t k = 0; k < 3; ++k) {
                CHECK(said->second[k].x == doctest::Approx(expected[k].x).epsilon(1e-6));
                CHECK(said->second[k].y == doctest::Approx(expected[k].y).epsilon(1e-6));
            }
        }
    }
}

// Tangents that are turned about their rays from photon to photon are the same footprints.
TEST_CASE("area field: rotating a photon's tangents makes no difference") {
    const AreaLamp straight{.turn = 0};
    std::vector<AreaPhoton> plain, turned;
    const HaltonSequence sequence(1);
    for (std::uint64_t i = 0; i < 3000; ++i) {
        AreaSample sample;
        for (std::uint32_t axis = 0; axis < 4; ++axis)
            sample[axis] = sequence.sample<double>(i, axis);
        plain.push_back(straight.photon(quadratic, sample));
        turned.push_back(AreaLamp{.turn = double(i % 11)}.photon(quadratic, sample));
    }
    // What bounds shifts looks at the longer tangent, and so at how they are turned.
    const SecondOrderFootprints<D>::Options options{
        .policy = {.largest_shift = 1e9}, .stratified = true, .photons = 3000};
    const auto a = footprints_of(plain, options), b = footprints_of(turned, options);
    const auto spread_of = [](const AreaPhoton& photon) {
        Symmetric2 sum{};
        for (const D& t : photon.deposit->d_position)
            sum += Symmetric2::outer({t.x, t.y});
        return sum;
    };
    for (std::size_t i = 0; i < plain.size(); i += 5) {
        AreaPhoton p = plain[i], q = turned[i];
        CHECK(a.apply(p).shortened == b.apply(q).shortened);
        const Symmetric2 expected = spread_of(p), spread = spread_of(q);
        CHECK(spread.xx == doctest::Approx(expected.xx).epsilon(1e-6));
        CHECK(std::abs(spread.xy - expected.xy) < 1e-6 * expected.trace());
        CHECK(spread.yy == doctest::Approx(expected.yy).epsilon(1e-6));
        CHECK(length(p.deposit->position - q.deposit->position) < 1e-6 * std::sqrt(expected.trace()));
    }
}

// A map whose slopes change by e^4 over the directions and not over the places deserves cells along the former alone.
TEST_CASE("area field: a small light gets its cells along the directions") {
    const auto map = [](const AreaSample& u) {
        const double x = std::exp(2 * u[2]), y = std::exp(2 * u[3]);
        return AreaLanding{{0.1 * u[0] + x, 0.1 * u[1] + y, 0},
                           {{{0.1, 0, 0}, {0, 0.1, 0}, {2 * x, 0, 0}, {0, 2 * y, 0}}}};
    };
    const auto photons = AreaLamp{.width = 2}.photons(map, 16384);
    SerialExecutor executor;
    const AreaField field(photons, {.photons = 16384}, executor);
    const auto counts = field.cells().counts();
    CHECK(counts[0] == 1);
    CHECK(counts[1] == 1);
    CHECK(counts[2] == counts[3]);
    CHECK(counts[2] >= 28); // 32 would be 16 photons in each cell; the others have 1.2 each, rounded
    CHECK(counts[2] <= 32);
}

// Photons beyond d_x = 0 are lost. The map bends along the directions, so that the cells lie along these, 6 steps of u0
// = 0.01 wide: as finely the border is known.
TEST_CASE("area field: footprints shrink towards a border and only across it") {
    const auto map = [](const AreaSample& u) {
        return AreaLanding{{u[2] + 0.01 * u[2] * u[2] + 0.1 * u[0], u[3] + 0.01 * u[3] * u[3] + 0.1 * u[1], 0},
                           {{{0.1, 0, 0}, {0, 0.1, 0}, {1 + 0.02 * u[2], 0, 0}, {0, 1 + 0.02 * u[3], 0}}},
                           1,
                           u[2] > 0};
    };
    const AreaLamp lamp{.width = 4, .unit = 0.01};
    const auto photons = lamp.photons(map, 65536);
    SerialExecutor executor;
    const AreaField field(photons, {.photons = 1e12}, executor); // so many that nothing else bounds a footprint
    const auto radii2 = [&](double d_x) {
        const AreaPhoton photon = lamp.photon(map, {0.5, 0.5, d_x / 4 + 0.5, 0.5});
        const auto said = field.at(photon.sample, photon.frame, photon.signature);
        REQUIRE(said);
        return std::array<double, 2>{said->shape.xx, said->shape.yy};
    };
    const double largest2 = square(SmoothingBounds{}.largest_radius);
    for (const double steps : {40.0, 60.0, 120.0}) {
        CHECK(radii2(-0.01 * steps)[0] == doctest::Approx(largest2).epsilon(1e-9));
        CHECK(radii2(-0.01 * steps)[1] == doctest::Approx(largest2).epsilon(1e-9));
    }
    CHECK(radii2(-0.01)[0] < square(12));
    CHECK(radii2(-0.01)[1] ==
          doctest::Approx(largest2).epsilon(1e-3)); // the border's direction is known to a hundredth
}

TEST_CASE("area field: photons outside the field get the default smoothing") {
    const AreaLamp lamp;
    const auto photons = lamp.photons(quadratic, 1000);
    const auto footprints = footprints_of(photons, {.stratified = true, .photons = 1000});
    AreaPhoton known = photons[500], stray = photons[500], three = photons[500], flat = photons[500];
    (void)footprints.apply(known);
    CHECK(known.deposit->position != photons[500].deposit->position);
    stray.signature = 99;
    three.sample.coordinates = 3;
    flat.frame = EmissionFrame(Photon<D, double>{{0, 0, 1}, {0, 0, -1}, 1, {}});
    for (AreaPhoton* photon : {&stray, &three, &flat}) {
        CHECK(!footprints.apply(*photon).shortened);
        CHECK(photon->deposit->position == photons[500].deposit->position);
        CHECK(photon->deposit->d_position[0] == default_smoothing * photons[500].deposit->d_position[0]);
    }
}

TEST_CASE("area field: photons at one place make no field and invalid ones are skipped") {
    SerialExecutor executor;
    const AreaLamp lamp;
    const auto at = [&](const std::vector<AreaPhoton>& photons) {
        const AreaField field(photons, {.photons = double(photons.size())}, executor);
        const AreaPhoton probe = lamp.photon(quadratic, {0.4, 0.6, 0.4, 0.6});
        return field.at(probe.sample, probe.frame, probe.signature);
    };
    CHECK(!at({}));
    CHECK(!at(lamp.photons(quadratic, 3)));
    CHECK(at(lamp.photons(quadratic, 200)));
    CHECK(!at(std::vector<AreaPhoton>(500, lamp.photon(quadratic, {0.5, 0.5, 0.5, 0.5})))); // all at one place
    auto flawed = lamp.photons(quadratic, 3000);
    for (std::size_t i = 0; i < flawed.size(); i += 3)
        flawed[i].tangents[1].x = std::numeric_limits<double>::quiet_NaN();
    const auto said = at(flawed);
    REQUIRE(said);
    CHECK(std::isfinite(said->shape.trace()));
}

} // namespace nephroid::tests::area_field_test
