// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/second_order.hpp"

#include "smoothing/second_order/maps.hpp"
#include "support/space.hpp"
#include "support/vertex.hpp"

#include "nephroid/splat/splat_photons.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::tests::second_order_test {

using namespace nephroid::detail;
using tests::affine;
using tests::halton;
using tests::Landing;
using tests::lattice;
using tests::MapPhoton;
using tests::photon_at;
using tests::photons_of;
using tests::quadratic;
using tests::unit_of;

namespace {

using D = glm::dvec3;
using Footprints = SecondOrderFootprints<D>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

[[nodiscard]] Footprints footprints_of(const std::vector<MapPhoton>& pilot, const Footprints::Options& options) {
    SerialExecutor executor;
    return Footprints(std::span<const MapPhoton>(pilot), options, executor);
}

/// The places of a splat's centre and its covariance over that of the kernel on the floor: Σ t tᵀ of half tangents.
[[nodiscard]] Symmetric2 spread_of(const Deposit<D, double, 2>& deposit) {
    Symmetric2 sum{};
    for (const D& t : deposit.d_position)
        sum += 0.25 * Symmetric2::outer({t.x, t.y});
    return sum;
}

using Vertex = tests::Vertex<D>;

// ---- the bias of one axis: F(u) = u + 0.9 u², so that F'' / F' is 1.8 at u = 0; nothing happens along v.

constexpr double bend = 1.8;

[[nodiscard]] Landing one_axis(double u, double v) {
    const double at = u - 0.5;
    return {{at + 0.5 * bend * at * at, v - 0.5, 0}, {1 + bend * at, 0, 0}, {0, 1, 0}};
}

/// Root mean square of the relative bias along a line of vertices, where the map's slope goes from 0.82 to 1.18.
///
/// @param reach  k = s u0: the footprints' radius where they are emitted
/// @param steps  photons per unit of length, on a lattice
template <class Order>
[[nodiscard]] double bias_of(double reach, double steps) {
    std::vector<Vertex> vertices;
    std::vector<double> exact;
    for (int i = -10; i <= 10; ++i) {
        const Landing landing = one_axis(0.5 + 0.01 * i, 0.5);
        vertices.push_back({landing.position});
        exact.push_back(1 / landing.d_u.x);
    }
    const EyePathMap<D> map(vertices, &Vertex::position, &Vertex::normal);
    const auto policies = Published{.excess = {.diagonals = 100}}.with_filter(NoPixelFilter{});
    auto sums = nephroid::sums<double>(map);
    detail::Splatter splatter(sums, policies);

    const double photons = steps * steps, smoothing = reach / unit_of(photons);
    const auto pilot = photons_of(one_axis, lattice(40, 40), photons);
    const Footprints footprints =
        footprints_of(pilot, {.smoothing = smoothing, .stratified = true, .photons = photons});
    std::vector<detail::SplatChunk<D, double>> chunk(1);
    Statistics account;
    for (double u = 0.5 / steps; u < 1; u += 1 / steps)
        for (double v = 0.5 - std::ceil(reach * steps) / steps + 0.5 / steps; v < 0.5 + reach; v += 1 / steps) {
            MapPhoton photon = photon_at(one_axis, {u, v}, photons);
            if constexpr (std::same_as<Order, SecondOrder>) {
                if (footprints.apply(photon).shortened)
                    return std::numeric_limits<double>::infinity(); // a shift that is shortened cancels nothing
            } else {
                for (D& tangent : photon.deposit->d_position)
                    tangent *= smoothing;
            }
            splatter.prepare(*photon.deposit, chunk[0], account);
        }
    SerialExecutor executor;
    splatter.add(std::span<const detail::SplatChunk<D, double>>(chunk), executor);
    double sum = 0;
    sums.for_each([&](std::size_t i, double e) { sum += square(e / exact[i] - 1); });
    return std::sqrt(sum / double(vertices.size()));
}

} // namespace

// To second order the relative bias of plain splats is m₂/2 k² times the second derivative of ln F': −k²/16
// (1.8/F')², 2.1e-3 at k = 0.1. A shift leaves what is of fourth order in k. Over a factor of four in k the next
// order, (1.8 k)² = 0.5 at most times an eighth or so, changes a slope by ln(1.06)/ln(4) = 0.05, or a few of that. A
// lattice of 300 photons per unit is without noise: the kernel's transform at its frequencies, 4 · 48 · 0.8
// ω^(−7/2) at ω = 2π · 300 k, is 2e-6 at k = 0.1.
TEST_CASE("second order: the bias falls with the fourth power of the smoothing and not with its square") {
    const std::array<double, 3> reach{0.1, 0.2, 0.4};
    std::array<double, 3> first, second;
    for (std::size_t i = 0; i < 3; ++i) {
        first[i] = bias_of<FirstOrder>(reach[i], 300);
        second[i] = bias_of<SecondOrder>(reach[i], 300);
    }
    CAPTURE(second[0]);
    CAPTURE(second[2]);
    double expected2 = 0;
    for (int i = -10; i <= 10; ++i)
        expected2 += square(square(reach[0] * bend / (1 + 0.01 * bend * i)) / 16) / 21;
    CHECK(first[0] == doctest::Approx(std::sqrt(expected2)).epsilon(0.03)); // (1.8 · 0.1)²
    CHECK(std::abs(std::log(first[2] / first[0]) / std::log(4.0) - 2) < 0.15);
    CHECK(std::abs(std::log(second[2] / second[0]) / std::log(4.0) - 4) < 0.15);
    CHECK(second[0] < first[0] / 100);
    CHECK(second[2] < first[2] / 10);
}

// Beside the border of a straight map k is the distance d to it. A photon at d is spread over d (1 + z), z the kernel's
// marginal, and with its shift m₂/2 ∂(d²) = d/8 over d (9/8 + z): the irradiance comes out as the mean of 1/(1 +
// z) and of 1/(9/8 + z). For a biweight, 16/(5π) (1 − z²)^(5/2), those are 1.2 and 1.0095. The field is linear in
// k² between cells 7 units apart: k² is too large by up to 7²/8, 2% of it, and half of an eighth of that ends up in
// the irradiance. Beyond d = 110 footprints do not grow: for x = 20 that is z = −0.82, and what is missing 2.3 ·
// 0.18^(5/2) = 3% of the plain irradiance, of the shifted one half of a percent.
TEST_CASE("second order: light stays even where footprints narrow towards a border") {
    constexpr double side = 256, photons = side * side;
    const auto identity = [](double u, double v) { return Landing{{u, v, 0}, {1, 0, 0}, {0, 1, 0}}; };
    const auto all = photons_of(identity, lattice(std::size_t(side), std::size_t(side)));
    // As if from so many photons that a straight map would have footprints without end.
    constexpr double many = 1e9;
    const double largest = 110 / std::sqrt(many / 80000); // grows to 110 with them
    const Footprints footprints =
        footprints_of(all, {.policy = {.bounds = {.largest_radius = largest}}, .stratified = true, .photons = many});
    std::vector<Vertex> vertices;
    for (double d = 16; d <= 24; d += 0.5)
        vertices.push_back({D(d * unit_of(photons), 0.5, 0)});
    const EyePathMap<D> map(vertices, &Vertex::position, &Vertex::normal);
    const auto policies = Published{.excess = {.diagonals = 100}}.with_filter(NoPixelFilter{});
    const auto mean = [&](bool shifted) {
        auto sums = nephroid::sums<double>(map);
        detail::Splatter splatter(sums, policies);
        std::vector<detail::SplatChunk<D, double>> chunk(1);
        Statistics account;
        for (MapPhoton photon : all) {
            const D before = photon.deposit->position;
            if (before.x > 0.75 || std::abs(before.y - 0.5) > 110 * unit_of(photons))
                continue; // out of reach
            (void)footprints.apply(photon);
            if (!shifted)
                photon.deposit->position = before;
            splatter.prepare(*photon.deposit, chunk[0], account);
        }
        SerialExecutor executor;
        splatter.add(std::span<const detail::SplatChunk<D, double>>(chunk), executor);
        double sum = 0;
        sums.for_each([&](std::size_t, double e) { sum += e / double(vertices.size()); });
        return sum;
    };
    CHECK(mean(true) == doctest::Approx(1.0095).epsilon(0.02));
    CHECK(mean(false) == doctest::Approx(1.2).epsilon(0.05));
}

// Σ t tᵀ of the new half tangents is J S Jᵀ, and the shift m₂/2 (S : H + J div S).
TEST_CASE("second order: a footprint has the shape and the shift that the field gives") {
    const auto samples = halton(3000);
    const auto photons = photons_of(quadratic, samples);
    SerialExecutor executor;
    const FootprintField field(photons, {.stratified = true, .photons = 3000}, executor);
    const Footprints footprints = footprints_of(photons, {.stratified = true, .photons = 3000});
    std::size_t checked = 0;
    for (const MapPhoton& photon : photons) {
        const auto said = field.at(photon.sample.at, photon.frame, photon.signature);
        REQUIRE(said);
        MapPhoton splat = photon;
        if (footprints.apply(splat).shortened)
            continue; // shortened
        ++checked;
        const auto j = half_tangents(*photon.deposit);
        const Symmetric2 expected = congruent({{j[0].x, j[0].y}, {j[1].x, j[1].y}}, said->shape);
        const Symmetric2 spread = spread_of(*splat.deposit);
        const double tolerance = 64 * epsilon * expected.trace();
        CHECK(std::abs(spread.xx - expected.xx) <= tolerance);
        CHECK(std::abs(spread.xy - expected.xy) <= tolerance);
        CHECK(std::abs(spread.yy - expected.yy) <= tolerance);
        const Double3 bend_part = said->shape.xx * said->second[0] +
                                  (2 * said->shape.xy * said->second[1] + said->shape.yy * said->second[2]);
        const Double3 shift = (1.0 / 16) * (bend_part + (said->divergence.x * j[0] + said->divergence.y * j[1]));
        const D moved = splat.deposit->position - photon.deposit->position;
        CHECK(std::abs(moved.x - shift.x) <= 64 * epsilon * 4);
        CHECK(std::abs(moved.y - shift.y) <= 64 * epsilon * 4);
        CHECK(splat.deposit->flux == photon.deposit->flux);
    }
    CHECK(checked > 2500);
}

TEST_CASE("second order: a kernel of larger second moment gets a smaller footprint and the same shift") {
    const auto photons = photons_of(quadratic, lattice(64, 64));
    const Footprints biweight = footprints_of(photons, {.stratified = true, .photons = 4096});
    const Footprints uniform =
        footprints_of(photons, {.stratified = true, .second_moment = UniformKernel::second_moment, .photons = 4096});
    // Away from borders: the same variance from a kernel with twice the moment, so half the area, and the same shift.
    MapPhoton a = photon_at(quadratic, {0.5, 0.5}, 4096), b = a;
    biweight.apply(a);
    uniform.apply(b);
    CHECK(spread_of(*b.deposit).trace() == doctest::Approx(0.5 * spread_of(*a.deposit).trace()).epsilon(1e-9));
    CHECK(b.deposit->position.x == doctest::Approx(a.deposit->position.x).epsilon(1e-9));
    CHECK(b.deposit->position.y == doctest::Approx(a.deposit->position.y).epsilon(1e-9));
}

TEST_CASE("second order: shifts beyond the limit are shortened and reported") {
    const auto photons = photons_of(quadratic, lattice(64, 64));
    const auto with = [&](double largest) {
        return footprints_of(photons, {.policy = {.largest_shift = largest}, .smoothing = 20, .photons = 4096});
    };
    const Footprints free = with(1e9), bound = with(1e-3), none = with(0);
    for (const MapPhoton& photon : photons) {
        MapPhoton a = photon, b = photon, c = photon;
        CHECK(!free.apply(a).shortened);
        CHECK(bound.apply(b).shortened);
        CHECK(none.apply(c).shortened);
        const D before = photon.deposit->position, far_shift = a.deposit->position - before,
                short_shift = b.deposit->position - before;
        // Semi-diameters along the columns of a triangular root of S: for S = s² 1 along the tangents.
        const double radius = 0.5 * (std::max)(length(b.deposit->d_position[0]), length(b.deposit->d_position[1]));
        CHECK(length(short_shift) == doctest::Approx(1e-3 * radius).epsilon(1e-9));
        CHECK(length(cross(far_shift, short_shift)) <= 1e-12 * length(far_shift)); // the same way
        CHECK(c.deposit->position == before);
        CHECK(a.deposit->d_position == c.deposit->d_position); // footprints as ever
    }
}

// A receiver that bends away has H across its tangent plane as well; the shift stays in it.
TEST_CASE("second order: on a curved surface the shift stays in the tangent plane") {
    const auto bowl = [](double u, double v) {
        Landing landing = quadratic(u, v);
        const D &p = landing.position, &du = landing.d_u, &dv = landing.d_v;
        const double height = 0.1 * (p.x * p.x + p.y * p.y);
        const double slope_u = 0.2 * (p.x * du.x + p.y * du.y), slope_v = 0.2 * (p.x * dv.x + p.y * dv.y);
        landing.position.z = height, landing.d_u.z = slope_u, landing.d_v.z = slope_v;
        return landing;
    };
    auto photons = photons_of(bowl, lattice(64, 64));
    for (MapPhoton& photon : photons) {
        const D p = photon.deposit->position;
        photon.deposit->normal = normalize(D(-0.2 * p.x, -0.2 * p.y, 1));
    }
    const Footprints footprints = footprints_of(photons, {.stratified = true, .photons = 4096});
    double longest = 0;
    for (const MapPhoton& photon : photons) {
        MapPhoton splat = photon;
        footprints.apply(splat);
        const D moved = splat.deposit->position - photon.deposit->position;
        longest = (std::max)(longest, length(moved));
        CHECK(std::abs(dot(moved, photon.deposit->normal)) <= 64 * epsilon * 4);
        for (const D& t : splat.deposit->d_position)
            CHECK(std::abs(dot(t, photon.deposit->normal)) <= 1e-12 * length(t));
    }
    CHECK(longest > 1e-3);
}

TEST_CASE("second order: tangents beyond the first two are scaled by the footprint's mean radius") {
    std::vector<TracedPhoton<D, double, 3>> photons;
    for (const MapPhoton& p : photons_of(affine, lattice(16, 16))) {
        const auto& d = *p.deposit;
        photons.push_back(
            {p.sample, p.frame, p.signature,
             Deposit<D, double, 3>{
                 d.position, d.normal, d.direction, d.flux, {d.d_position[0], d.d_position[1], D(0.25, 0.5, 0)}}});
    }
    SerialExecutor executor;
    const SecondOrderFootprints<D> footprints(std::span<const TracedPhoton<D, double, 3>>(photons),
                                              {.smoothing = 6, .photons = 256}, executor);
    auto photon = photons[100];
    CHECK(!footprints.apply(photon).shortened);
    CHECK(photon.deposit->d_position[2].x == doctest::Approx(6 * 0.25).epsilon(1e-12));
    CHECK(photon.deposit->d_position[0].x == doctest::Approx(6 * photons[100].deposit->d_position[0].x).epsilon(1e-12));
}

TEST_CASE("second order: photons outside the field get a fallback smoothing") {
    const auto known = photons_of(quadratic, lattice(32, 32));
    const Footprints chosen = footprints_of(known, {.stratified = true, .photons = 1024}),
                     given = footprints_of(known, {.smoothing = 11, .stratified = true, .photons = 1024});
    const auto check = [](const Footprints& footprints, MapPhoton photon, double smoothing) {
        const MapPhoton before = photon;
        CHECK(!footprints.apply(photon).shortened);
        CHECK(photon.deposit->position == before.deposit->position);
        for (std::size_t i = 0; i < 2; ++i)
            CHECK(photon.deposit->d_position[i] == smoothing * before.deposit->d_position[i]);
    };
    MapPhoton stray = known[500];
    stray.signature = 99;
    check(chosen, stray, SmoothingBounds{}.least);
    check(given, stray, 11);
    MapPhoton of_another_light = known[500];
    of_another_light.sample.light = 3;
    check(chosen, of_another_light, SmoothingBounds{}.least);
    MapPhoton of_an_area = known[500];
    of_an_area.sample.coordinates = 4;
    check(chosen, of_an_area, default_smoothing);
    check(given, of_an_area, 11);
    // Fewer than four cells' photons: no field.
    const auto few = photons_of(quadratic, lattice(9, 7));
    check(footprints_of(few, {.stratified = true, .photons = 63}), few[30], SmoothingBounds{}.least);
    check(footprints_of({}, {.stratified = true, .photons = 63}), few[30], SmoothingBounds{}.least);
    const auto enough = photons_of(quadratic, lattice(8, 8));
    MapPhoton one = enough[30];
    footprints_of(enough, {.stratified = true, .photons = 64}).apply(one);
    CHECK(one.deposit->position != enough[30].deposit->position);
}

TEST_CASE("second order: each light has its own field whatever its index") {
    const auto straight = photons_of(affine, halton(1000)), bent = photons_of(quadratic, halton(1000));
    std::vector<MapPhoton> both;
    for (std::size_t i = 0; i < 1000; ++i) {
        both.push_back(straight[i]);
        both.push_back(bent[i]);
        both[2 * i].sample.light = 4000000000u;
        both[2 * i + 1].sample.light = 7;
    }
    const Footprints together = footprints_of(both, {.stratified = true, .photons = 2000}),
                     of_straight = footprints_of(straight, {.stratified = true, .photons = 1000}),
                     of_bent = footprints_of(bent, {.stratified = true, .photons = 1000});
    for (std::size_t i = 0; i < 1000; i += 13) {
        MapPhoton a = straight[i], b = both[2 * i], c = bent[i], d = both[2 * i + 1];
        of_straight.apply(a), together.apply(b);
        of_bent.apply(c), together.apply(d);
        CHECK(a.deposit->position == b.deposit->position);
        CHECK(a.deposit->d_position == b.deposit->d_position);
        CHECK(c.deposit->position == d.deposit->position);
        CHECK(c.deposit->d_position == d.deposit->d_position);
    }
}

} // namespace nephroid::tests::second_order_test
