// SPDX-License-Identifier: MIT
#include "nephroid/estimate/second_order/sheet_field.hpp"

#include "nephroid/emission/warp.hpp"
#include "nephroid/estimate/second_order/footprint_field.hpp"
#include "nephroid/transport/executor.hpp"

#include "estimate/second_order/maps.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace nephroid;
using tests::affine;
using tests::Draws;
using tests::halton;
using tests::Landing;
using tests::lattice;
using tests::MapPhoton;
using tests::photon_at;
using tests::photons_of;
using tests::quadratic;
using tests::unit_of;

namespace {

using Field = FootprintField;

constexpr double side = 63, all = side * side; // photons on a lattice: cells of 3 × 3
constexpr double unit_per_cell = 3;            // lattice steps, each sqrt(π) units of u0
const double step = std::sqrt(pi<double>);

[[nodiscard]] FieldOptions stratified() { return {.stratified = true, .photons = all}; }

[[nodiscard]] Field field_of(const std::vector<MapPhoton>& photons, const FieldOptions& options) {
    SerialExecutor executor;
    return Field(photons, options, executor);
}

template <class Map>
[[nodiscard]] Field field_of(const Map& map, const FieldOptions& options = stratified()) {
    return field_of(photons_of(map, lattice(std::size_t(side), std::size_t(side))), options);
}

/// What the field says of a photon of the map.
template <class Map>
[[nodiscard]] std::optional<FieldSample> at(const Field& field, const Map& map, double u, double v) {
    const MapPhoton photon = photon_at(map, {u, v}, all);
    return field.at(photon.sample.at, photon.frame, photon.signature);
}

/// S of a map without any bend, by the rule.
[[nodiscard]] double straight_radius2(double photons = all, double share = 1, const SmoothingBounds& bounds = {}) {
    const Symmetric2 s = smoothing_tensor(log_bending(Symmetric2::isotropic(5 / (pi<double> * photons)), bounds),
                                          {.stratified = true, .share = share}, bounds);
    REQUIRE(s.xx == doctest::Approx(s.yy));
    return s.xx;
}

/// The square of a radius beside a border: (ρ⁻⁴ + d⁻⁴)^(−1/2), d no less than the least radius.
[[nodiscard]] double narrowed(double radius2, double distance) {
    const double d2 = square((std::max)(distance, SmoothingBounds{}.least_radius));
    return d2 < 8 * radius2 ? radius2 * d2 / std::hypot(radius2, d2) : radius2;
}

/// The same between two borders `width` apart.
[[nodiscard]] double between(double radius2, double distance, double width) {
    return narrowed(narrowed(radius2, distance), width - distance);
}

[[nodiscard]] double distance(const Space3& a, const Space3& b) { return std::sqrt(inner(a - b, a - b)); }

void check_close(const Symmetric2& a, const Symmetric2& b, double tolerance) {
    CHECK(std::abs(a.xx - b.xx) <= tolerance);
    CHECK(std::abs(a.xy - b.xy) <= tolerance);
    CHECK(std::abs(a.yy - b.yy) <= tolerance);
}

/// Bends more and more along u, and a little along v.
[[nodiscard]] Landing curved(double u, double v) {
    const double a = 6 * u, b = 2 * v;
    return {{u + 0.1 * std::sin(a) * std::cos(b), v + 0.2 * u * v, 0},
            {1 + 0.6 * std::cos(a) * std::cos(b), 0.2 * v, 0},
            {-0.2 * std::sin(a) * std::sin(b), 1 + 0.2 * u, 0}};
}

/// Two sheets, side by side.
struct TwoSheets {
    double border = 0.5;
    [[nodiscard]] Landing operator()(double u, double v) const {
        Landing landing = affine(u, v);
        landing.signature = u < border ? 1 : 2;
        return landing;
    }
};

} // namespace

// The radius is the largest there is, 32: borders are felt from 2.9 times that on, and half of the domain is 167 units.
TEST_CASE("sheet field: a straight map has round footprints and no shift away from its borders") {
    constexpr double wide = 189, photons = wide * wide;
    const Field field = field_of(photons_of(affine, lattice(std::size_t(wide), std::size_t(wide))),
                                 {.stratified = true, .photons = photons});
    const double s2 = straight_radius2(photons);
    REQUIRE(std::sqrt(s2) == doctest::Approx(32));
    for (const double u : {0.35, 0.5, 0.61})
        for (const double v : {0.37, 0.5, 0.65}) {
            const MapPhoton photon = photon_at(affine, {u, v}, photons);
            const auto here = field.at(photon.sample.at, photon.frame, photon.signature);
            REQUIRE(here);
            check_close(here->shape, Symmetric2::isotropic(s2), 1e-9 * s2);
            CHECK(std::abs(here->divergence.x) + std::abs(here->divergence.y) <= 1e-9 * s2);
            for (const Space3& h : here->second) // a unit step, 1/335 of the domain, changes J by nothing
                CHECK(std::sqrt(inner(h, h)) <= 1e-12);
        }
}

TEST_CASE("sheet field: a quadratic map's second derivatives are the same everywhere") {
    for (const bool given : {false, true}) {
        FieldOptions options = stratified();
        if (given)
            options.smoothing = 7;
        const Field field = field_of(quadratic, options);
        const double u02 = unit_of(all) * unit_of(all);
        for (const double u : {0.01, 0.3, 0.5, 0.99})
            for (const double v : {0.02, 0.47, 0.9}) {
                const auto here = at(field, quadratic, u, v);
                REQUIRE(here);
                const double tolerance = 1e-9 * u02;
                CHECK(distance(here->second[0], {0.8 * u02, -0.2 * u02, 0}) <= tolerance);
                CHECK(distance(here->second[1], {0.3 * u02, 0.1 * u02, 0}) <= tolerance);
                CHECK(distance(here->second[2], {-0.4 * u02, 0.6 * u02, 0}) <= tolerance);
                if (given) { // nothing is chosen, not even at the domain's borders
                    check_close(here->shape, Symmetric2::isotropic(49), 1e-12 * 49);
                    CHECK(std::abs(here->divergence.x) + std::abs(here->divergence.y) <= 1e-9);
                }
            }
    }
}

TEST_CASE("sheet field: footprints reach as far as the domain's border and no further") {
    const Field field = field_of(affine);
    const double s2 = straight_radius2(), width = side * step;
    for (const double u : {0.001, 0.02, 0.1, 0.32, 0.5, 0.9, 0.999})
        for (const double v : {0.01, 0.4, 0.5, 0.97}) {
            CAPTURE(u);
            CAPTURE(v);
            const auto here = at(field, affine, u, v);
            REQUIRE(here);
            const Symmetric2 expected{between(s2, u * width, width), 0, between(s2, v * width, width)};
            check_close(here->shape, expected, 1e-9 * s2);
            CHECK(std::sqrt(here->shape.xx) <= (std::max)(2.0, (std::min)(u, 1 - u) * width));
        }
}

// Within a cell, a 21st of the square's side, the map onto the disk turns by (π/4) (2/21) = 0.075 at most, and so may the
// distance to the rim be off by that share: 0.15 of its square. Along the diagonals the map has kinks.
TEST_CASE("sheet field: a disk's rim is as far as it is all around, the corners of the samples among it") {
    const auto on_disk = [](const std::array<double, 2>& sample) {
        const DiskPoint<double> at = concentric_disk(sample[0], sample[1]);
        const double tangent = 2 * unit_of(all, pi<double>);
        const glm::dvec3 zero(0), place(at.x, at.y, 1);
        const Photon<glm::dvec3, double> emitted{
            place, {0, 0, -1}, 1 / all, {Tangent<glm::dvec3>{{tangent, 0, 0}, zero}, {{0, tangent, 0}, zero}}};
        const Deposit<glm::dvec3, double, 2> landed{
            {at.x, at.y, 0}, {0, 0, 1}, {0, 0, -1}, emitted.flux, {{{tangent, 0, 0}, {0, tangent, 0}}}};
        return MapPhoton{{sample, 0, 2}, EmissionFrame(emitted), 1, landed};
    };
    std::vector<MapPhoton> photons;
    for (const auto& sample : lattice(std::size_t(side), std::size_t(side)))
        photons.push_back(on_disk(sample));
    const Field field = field_of(photons, stratified());
    const double s2 = straight_radius2();
    for (const double radius : {0.75, 0.85, 0.92})
        for (int i = 0; i < 64; ++i) {
            // A point of the square that is mapped to this radius, next to a corner for every eighth one.
            const double around = (i % 16 - 7.5) / 8 * 0.999;
            const double a = (i & 16 ? 1 : -1) * radius, b = around * radius;
            const std::array<double, 2> sample{0.5 + 0.5 * (i & 32 ? a : b), 0.5 + 0.5 * (i & 32 ? b : a)};
            const DiskPoint<double> place = concentric_disk(sample[0], sample[1]);
            CAPTURE(place.x);
            CAPTURE(place.y);
            const MapPhoton photon = on_disk(sample);
            const auto here = field.at(photon.sample.at, photon.frame, photon.signature);
            REQUIRE(here);
            const Plane2 outwards{place.x / radius, place.y / radius};
            const double expected = narrowed(s2, (1 - radius) * std::sqrt(all));
            CHECK(inner(outwards, here->shape(outwards)) == doctest::Approx(expected).epsilon(0.15));
        }
}

// A kernel with twice the second moment reaches as far with half of S, up to borders too.
TEST_CASE("sheet field: borders count for a kernel by its own width") {
    FieldOptions wide = stratified();
    wide.scale = 0.5;
    const Field biweight = field_of(affine), other = field_of(affine, wide);
    for (const double u : {0.02, 0.35}) {
        const auto narrow = at(biweight, affine, u, 0.4), half = at(other, affine, u, 0.4);
        REQUIRE((narrow && half));
        check_close(half->shape, 0.5 * narrow->shape, 1e-12 * narrow->shape.trace());
    }
}

// The outermost photons on the left are at column 30 of 0 to 62, on the right at column 31: borders are laid there.
TEST_CASE("sheet field: where paths change there is a border for those on either side") {
    const TwoSheets sheets;
    const Field field = field_of(sheets);
    const double s2 = straight_radius2(), width = side * step;
    const double left = 30.5 / side, right = 31.5 / side, across = between(s2, 0.5 * width, width);
    for (const double away : {0.005, 0.03, 0.08, 0.2}) {
        CAPTURE(away);
        for (const double u : {left - away, right + away}) {
            const auto here = at(field, sheets, u, 0.5);
            REQUIRE(here);
            check_close(here->shape, {between(narrowed(s2, away * width), u * width, width), 0, across}, 1e-6 * s2);
            CHECK(std::sqrt(inner(here->second[0], here->second[0])) <= 1e-12); // no difference was taken across
        }
    }
    // Between the middles of two cells values are blended; across the border, where the map bends, they are not.
    const auto bent_beyond = [](double u, double v) {
        Landing landing = u < 0.5 ? affine(u, v) : quadratic(u, v);
        landing.signature = u < 0.5 ? 1 : 2;
        return landing;
    };
    const auto last = at(field_of(bent_beyond), bent_beyond, 0.499, 0.5);
    REQUIRE(last);
    check_close(last->shape, {narrowed(s2, 0), 0, across}, 1e-6 * s2);
    for (const Space3& h : last->second)
        CHECK(std::sqrt(inner(h, h)) <= 1e-12);
}

// A border that runs askew to the cells: footprints reach over it by no more than photons are apart, but for a few where
// the corner of a cell is cut off.
TEST_CASE("sheet field: borders may run any way") {
    const auto askew = [](double u, double v) {
        Landing landing = affine(u, v);
        landing.signature = u + 0.6 * v < 0.8 ? 1 : 2;
        return landing;
    };
    const Plane2 n{1 / std::hypot(1, 0.6), 0.6 / std::hypot(1, 0.6)};
    for (const auto& samples : {lattice(63, 63), halton(4000)}) {
        const auto photons = photons_of(askew, samples);
        const Field field = field_of(photons, {.stratified = true, .photons = double(samples.size())});
        const double u0 = unit_of(double(samples.size()));
        std::size_t checked = 0, far = 0;
        for (std::size_t i = 0; i < photons.size(); i += 3) {
            const auto& [u, v] = photons[i].sample.at;
            const double away = std::abs(u + 0.6 * v - 0.8) / std::hypot(1, 0.6) / u0;
            if (u < 0.2 || u > 0.8 || v < 0.2 || v > 0.8 || away > 25)
                continue;
            const auto here = field.at(photons[i].sample.at, photons[i].frame, photons[i].signature);
            REQUIRE(here);
            const double over = std::sqrt(inner(n, here->shape(n))) - away;
            CHECK(over <= 5 * step); // a cell and two thirds
            far += over > 2 * step;
            ++checked;
        }
        CHECK(checked > 100);
        CHECK(double(far) < 0.02 * double(checked));
    }
}

TEST_CASE("sheet field: where photons are lost there is a border") {
    auto photons = photons_of(affine, lattice(std::size_t(side), std::size_t(side)));
    for (MapPhoton& photon : photons)
        if (photon.sample.at[0] > 0.501)
            photon = tests::lost(photon);
    const Field field = field_of(photons, stratified());
    const double s2 = straight_radius2(), width = side * step, away = 0.07;
    const auto here = at(field, affine, 0.5 - away, 0.5);
    REQUIRE(here);
    CHECK(here->shape.xx ==
          doctest::Approx(between(narrowed(s2, away * width), (0.5 - away) * width, width)).epsilon(1e-6));
    CHECK(here->shape.yy == doctest::Approx(between(s2, 0.5 * width, width)).epsilon(1e-6));
    CHECK(!at(field, affine, 0.8, 0.5));
}

TEST_CASE("sheet field: a domain that repeats has no borders") {
    FieldOptions options = stratified();
    options.repeats = true;
    const Field field = field_of(affine, options);
    const double s2 = straight_radius2();
    for (const double u : {0.0, 0.01, 0.4, 0.999})
        for (const double v : {0.001, 0.5, 0.98}) {
            const auto here = at(field, affine, u, v);
            REQUIRE(here);
            check_close(here->shape, Symmetric2::isotropic(s2), 1e-9 * s2);
            CHECK(std::abs(here->divergence.x) + std::abs(here->divergence.y) <= 1e-9 * s2);
        }
}

// Between the middles of cells shapes are bilinear, beside borders smooth: a difference over a fiftieth of a lattice step
// is off by its square.
TEST_CASE("sheet field: the divergence is that of the shapes around") {
    const Field field = field_of(curved);
    const double u0 = unit_of(all), h = 0.01 / side;
    std::size_t varying = 0;
    for (const double u : {0.06, 0.31, 0.55, 0.9})
        for (const double v : {0.11, 0.48, 0.82}) {
            const auto here = at(field, curved, u, v);
            const auto right = at(field, curved, u + h, v), left = at(field, curved, u - h, v),
                       up = at(field, curved, u, v + h), down = at(field, curved, u, v - h);
            REQUIRE((here && right && left && up && down));
            const double per_unit = u0 / (2 * h);
            const Plane2 expected{
                per_unit * (right->shape.xx - left->shape.xx) + per_unit * (up->shape.xy - down->shape.xy),
                per_unit * (right->shape.xy - left->shape.xy) + per_unit * (up->shape.yy - down->shape.yy)};
            CAPTURE(u);
            CAPTURE(v);
            CHECK(here->divergence.x == doctest::Approx(expected.x).epsilon(1e-5));
            CHECK(here->divergence.y == doctest::Approx(expected.y).epsilon(1e-5));
            varying += std::abs(expected.x) > 0.1;
        }
    CHECK(varying > 4);
}

// A light may choose any orthogonal pair of tangents for each photon: what comes out for the surface is the same. The
// fit and the blend are made in the axes of one photon of each cell, so only rounding differs.
TEST_CASE("sheet field: footprints do not depend on how the light turns its tangents") {
    const auto samples = halton(2000);
    const auto plain = photons_of(curved, samples);
    std::vector<MapPhoton> turned;
    Draws draw(5);
    for (const auto& sample : samples)
        turned.push_back(photon_at(curved, sample, 2000, 1, draw.in(0, 6.3)));
    const FieldOptions options{.stratified = true, .photons = 2000};
    const Field field = field_of(plain, options), other = field_of(turned, options);
    std::size_t found = 0;
    for (std::size_t i = 0; i < samples.size(); i += 7) {
        const auto a = field.at(samples[i], plain[i].frame, 1), b = other.at(samples[i], turned[i].frame, 1);
        REQUIRE(a.has_value() == b.has_value());
        if (!a)
            continue;
        ++found;
        const auto on_floor = [](const MapPhoton& photon, const FieldSample& sample) {
            const auto j = unit_tangents(*photon.deposit);
            return congruent({{j[0].x, j[0].y}, {j[1].x, j[1].y}}, sample.shape);
        };
        const Symmetric2 p = on_floor(plain[i], *a), q = on_floor(turned[i], *b);
        check_close(p, q, 1e-8 * p.trace());
        const auto bend = [](const FieldSample& s) {
            return s.shape.xx * s.second[0] + (2 * s.shape.xy * s.second[1] + s.shape.yy * s.second[2]);
        };
        CHECK(distance(bend(*a), bend(*b)) <= 1e-8 * std::sqrt(inner(bend(*a), bend(*a))) + 1e-14);
        const auto drift = [](const MapPhoton& photon, const FieldSample& s) {
            const auto j = unit_tangents(*photon.deposit);
            return s.divergence.x * j[0] + s.divergence.y * j[1];
        };
        CHECK(distance(drift(plain[i], *a), drift(turned[i], *b)) <= 1e-8 * std::sqrt(p.trace()));
    }
    CHECK(found > 250);
}

// 240 × 30 photons over 8 × 1, 53 units from side to side.
TEST_CASE("sheet field: a long domain has borders as far away as any") {
    constexpr double extent = 8, photons = 240 * 30;
    const Field field =
        field_of(photons_of(affine, lattice(240, 30), 0, extent), {.stratified = true, .photons = photons});
    const double s2 = straight_radius2(photons), width = 30 * step;
    for (const double u : {0.002, 0.02, 0.5, 0.985})
        for (const double v : {0.05, 0.5, 0.8}) {
            const MapPhoton photon = photon_at(affine, {u, v}, photons, extent);
            const auto here = field.at(photon.sample.at, photon.frame, 1);
            REQUIRE(here);
            check_close(here->shape,
                        {between(s2, extent * u * width, extent * width), 0, between(s2, v * width, width)}, 1e-6 * s2);
        }
}

// All nine photons of a cell lost: those beside it are a step away from its border, and the next cells three more.
TEST_CASE("sheet field: a hole is a border for what is around it") {
    auto photons = photons_of(affine, lattice(std::size_t(side), std::size_t(side)));
    for (std::size_t y = 30; y < 33; ++y)
        for (std::size_t x = 30; x < 33; ++x)
            photons[y * 63 + x] = tests::lost(photons[y * 63 + x]);
    const Field field = field_of(photons, stratified());
    const double s2 = straight_radius2(), width = side * step, cell = unit_per_cell / side;
    const auto right = at(field, affine, 0.5 + cell, 0.5), above = at(field, affine, 0.5, 0.5 + 2 * cell);
    REQUIRE((right && above));
    CHECK(!at(field, affine, 0.5, 0.5));
    const auto beside = [&](double distance, double cells) {
        return between(narrowed(s2, distance), (0.5 + cells * cell) * width, width);
    };
    const double across = between(s2, 0.5 * width, width);
    check_close(right->shape, {beside(step, 1), 0, across}, 1e-6 * s2);
    check_close(above->shape, {across, 0, beside(4 * step, 2)}, 1e-6 * s2);
}

TEST_CASE("sheet field: photons lost here and there are no border") {
    constexpr double wide = 240, count = wide * wide;
    auto photons = photons_of(affine, lattice(std::size_t(wide), std::size_t(wide)));
    for (std::size_t i = 5; i < photons.size(); i += 37) // apart from one another
        photons[i] = tests::lost(photons[i]);
    FieldOptions options{.stratified = true, .photons = count};
    options.bounds.largest_radius = 100; // else that were the radius
    const Field field = field_of(photons, options);
    for (const double u : {0.49, 0.5, 0.51})
        for (const double v : {0.492, 0.5, 0.51}) {
            const MapPhoton photon = photon_at(affine, {u, v}, count);
            const auto here = field.at(photon.sample.at, photon.frame, 1);
            REQUIRE(here); // its share is counted in windows of 144 photons, of which four are missing, or three
            CHECK(here->shape.xx >= straight_radius2(count, 141.0 / 144, options.bounds));
            CHECK(here->shape.xx <= straight_radius2(count, 139.0 / 144, options.bounds));
            CHECK(std::abs(here->shape.xx - here->shape.yy) <= 1e-6 * here->shape.xx);
        }
}

// Facets 3 lattice steps wide, each with a J of its own: no quadratic map fits, and a footprint over several of them
// would show a picture of their average.
TEST_CASE("sheet field: facets make footprints smaller than a smooth map does") {
    const auto facets = [](double u, double v) {
        Landing landing = affine(u, v);
        const auto facet = int(u * side / 3) * 7919 + int(v * side / 3) * 104729;
        const double tilt = 0.5 * (double(facet % 101) / 50 - 1);
        landing.d_u += tilt * landing.d_u;
        landing.d_v -= tilt * landing.d_v;
        return landing;
    };
    const auto smooth = at(field_of(affine), affine, 0.5, 0.5), rough = at(field_of(facets), facets, 0.5, 0.5);
    REQUIRE((smooth && rough));
    CHECK(rough->shape.trace() < 0.2 * smooth->shape.trace());
}

TEST_CASE("sheet field: a photon with tangents that are no numbers does not spoil its neighbours") {
    auto photons = photons_of(quadratic, lattice(std::size_t(side), std::size_t(side)));
    const Field plain = field_of(photons, stratified());
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    photons[32 * 63 + 32].tangents[0].x = nan;
    const auto& sample = photons[20 * 63 + 20].sample.at;
    photons[20 * 63 + 20].frame = EmissionFrame( // was emitted with tangents that span nothing
        Photon<glm::dvec3, double>{{sample[0], sample[1], 1}, {0, 0, -1}, 1, {}});
    const Field field = field_of(photons, stratified());
    for (const auto& [u, v] : lattice(32, 32)) {
        const auto expected = at(plain, quadratic, u, v), here = at(field, quadratic, u, v);
        REQUIRE(here);
        check_close(here->shape, expected->shape, 1e-6 * expected->shape.trace());
        CHECK(distance(here->second[0], expected->second[0]) <= 1e-9 * unit_of(all) * unit_of(all));
    }
}

TEST_CASE("sheet field: photons that are all at one place or all lost give nothing") {
    const auto one_place = photons_of(affine, tests::Samples(100, {0.5, 0.5}));
    const Field field = field_of(one_place, {.stratified = true, .photons = 100});
    CHECK(!field.at({0.5, 0.5}, one_place[0].frame, 1));
    CHECK(!field.at({0.1, 0.9}, one_place[0].frame, 1));
    auto none_landed = photons_of(affine, halton(100));
    for (MapPhoton& photon : none_landed)
        photon = tests::lost(photon);
    const Field none = field_of(none_landed, {.stratified = true, .photons = 100});
    for (const MapPhoton& photon : none_landed)
        CHECK(!none.at(photon.sample.at, photon.frame, photon.signature));
}

TEST_CASE("sheet field: any number of threads makes the same field bit for bit") {
    const auto samples = halton(20000);
    const auto photons = photons_of(TwoSheets{0.3}, samples);
    const auto curved_photons = photons_of(curved, samples);
    for (const auto* all_photons : {&photons, &curved_photons}) {
        const FieldOptions options{.stratified = true, .photons = 20000};
        const Field serial = field_of(*all_photons, options);
        for (const unsigned threads : {1u, 2u, 7u}) {
            ThreadExecutor executor(threads);
            const Field again(*all_photons, options, executor);
            CAPTURE(threads);
            for (std::size_t i = 0; i < all_photons->size(); i += 11) {
                const MapPhoton& photon = (*all_photons)[i];
                const auto a = serial.at(photon.sample.at, photon.frame, photon.signature),
                           b = again.at(photon.sample.at, photon.frame, photon.signature);
                REQUIRE(a.has_value() == b.has_value());
                if (!a)
                    continue;
                REQUIRE((a->shape.xx == b->shape.xx && a->shape.xy == b->shape.xy && a->shape.yy == b->shape.yy));
                REQUIRE((a->divergence.x == b->divergence.x && a->divergence.y == b->divergence.y));
                for (std::size_t k = 0; k < 3; ++k)
                    REQUIRE(distance(a->second[k], b->second[k]) == 0);
            }
        }
    }
}
