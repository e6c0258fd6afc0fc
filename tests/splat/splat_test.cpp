// SPDX-License-Identifier: MIT
#include "nephroid/splat/splat.hpp"

#include "support/brute_force.hpp"
#include "support/discard_excess.hpp"
#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <array>

namespace nephroid::tests::splat_test {

using tests::Covariance;
using tests::Draws;
using tests::Vertex;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
constexpr double epsilon = double(std::numeric_limits<T>::epsilon());

constexpr double spacing = 1.0 / 64; // a power of two: the map finds it without rounding

template <class T>
std::vector<Vertex<Vec<T>>> lattice(int columns = 64) {
    std::vector<Vertex<Vec<T>>> vertices;
    tests::add_lattice<T>(vertices, columns, columns, spacing, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    return vertices;
}

template <class V>
EyePathMap<V> map_of(const std::vector<Vertex<V>>& vertices) {
    return EyePathMap<V>(vertices, &Vertex<V>::position, &Vertex<V>::normal);
}

/// On the floor, with tangents of these lengths at these angles.
template <class T>
Deposit<Vec<T>, T> deposit_at(double x, double y, double length_u, double angle_u, double length_v, double angle_v) {
    return {{T(x), T(y), 0},
            {0, 0, 1},
            {0, 0, -1},
            T(3),
            {Vec<T>{T(length_u * std::cos(angle_u)), T(length_u * std::sin(angle_u)), 0},
             Vec<T>{T(length_v * std::cos(angle_v)), T(length_v * std::sin(angle_v)), 0}}};
}

/// The flux that a splat spreads: its peak times |det M|⁻¹, the area of its ellipse over π.
template <class V, class F>
double flux_of(const Splat<V, F>& splat) {
    return double(splat.peak) / std::abs(double(dot(splat.normal, cross(splat.row_a, splat.row_b))));
}

/// Bound on what sampling a biweight splat at a lattice may gain or lose, of its flux: by Poisson's summation formula
/// the sum of its Fourier transform, 48 |J₃(ω)| / ω³, over the lattice's frequencies, ω² = (2π/p)² kᵀ C k.
/// The mean over m x m evenly shifted positions has only every m-th of these. |J₃(ω)| is below 0.4344 and
/// below sqrt(2/π) (ω² − 35/4)^(−1/4) [Krasikov 2006].
double sampling_error(const Covariance& c, double p, int m) {
    const double pi = std::numbers::pi;
    const auto transform = [&](double w) {
        const double bessel =
            w * w > 9.75 ? (std::min)(0.4344, std::sqrt(2 / pi) / std::pow(w * w - 8.75, 0.25)) : 0.4344;
        return (std::min)(1.0, 48 * bessel / (w * w * w));
    };
    constexpr int most = 30;
    double sum = 0;
    for (int i = -most; i <= most; ++i)
        for (int j = -most; j <= most; ++j) {
            if (i == 0 && j == 0)
                continue;
            // The lattice lies along x and y, the covariance along e1 and e2.
            const double k1 = m * (i * c.e1.x + j * c.e1.y), k2 = m * (i * c.e2.x + j * c.e2.y);
            sum += transform(2 * pi / p * std::sqrt(c.xx * k1 * k1 + 2 * c.xy * k1 * k2 + c.yy * k2 * k2));
        }
    // Beyond: the integral of 48 · 0.8 ω^(−7/2) over |k| > most, with the minor radius for every direction.
    const double least = 2 * pi / p * m * c.minor();
    return sum + 48 * 0.8 * std::pow(least, -3.5) * 2 * pi / 1.5 * std::pow(most, -1.5);
}

} // namespace

// From fat ones to needles and points: with the pixel filter no footprint falls between the vertices.
TEST_CASE_TEMPLATE("splat: over a fine lattice a photon's flux is kept", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    Draws draw(61);
    const double filter = std::sqrt(2.0 / 3) * spacing;
    for (int i = 0; i < 60; ++i) {
        const double longest = i % 3 == 0 ? draw.in(0, 0.01) : draw.in(0.05, 0.4),
                     shortest = i % 2 == 0 ? 0 : draw.in(0, 0.1);
        const bool is_point = i % 10 == 9;
        const auto base = is_point ? deposit_at<T>(0, 0, 0, 0, 0, 0)
                                   : deposit_at<T>(0, 0, longest, draw.in(0, 3.1), shortest, draw.in(0, 3.1));
        const Covariance c(base, filter);
        CAPTURE(c.major());
        CAPTURE(c.minor());
        const double x = draw.in(0.45, 0.55), y = draw.in(0.45, 0.55);
        const double rounding = 64 * epsilon<T> * c.major() / c.minor();
        const double alone = sampling_error(c, spacing, 1), shifted = sampling_error(c, spacing, 4);
        double mean = 0;
        for (int shift = 0; shift < 16; ++shift) {
            auto deposit = base;
            deposit.position = {T(x + shift % 4 * spacing / 4), T(y + shift / 4 * spacing / 4), 0};
            const auto outcome = make_splat(deposit, map, Published{});
            REQUIRE(outcome.fate == Fate::splatted);
            const Splat<Vec<T>, T> splat = *outcome.splat;
            double energy = 0;
            for (const auto& vertex : vertices) {
                const Vec<T> d = map.tree().relative(vertex.position) - splat.centre;
                energy +=
                    double(splat.peak * BiweightKernel{}(square(dot(splat.row_a, d)) + square(dot(splat.row_b, d))));
            }
            energy *= spacing * spacing / 3;
            CHECK(std::abs(energy - 1) <= alone + rounding);
            mean += energy / 16;
        }
        // The filter's least disk has 2π · 0.816 · 4 = 20.5 in the formula above: 0.69 %.
        CHECK(shifted < 0.007);
        CHECK(std::abs(mean - 1) <= shifted + rounding);
    }
}

TEST_CASE_TEMPLATE("splat: policies change the footprint but not the flux", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    Draws draw(62);
    for (int i = 0; i < 100; ++i) {
        const auto deposit =
            deposit_at<T>(0.5, 0.5, draw.in(0.001, 4), draw.in(0, 3), draw.in(0.001, 4), draw.in(0, 3));
        const auto check = [&](const auto& policies) {
            const auto outcome = make_splat(deposit, map, policies);
            REQUIRE(outcome.fate == Fate::splatted);
            CHECK(flux_of(*outcome.splat) == doctest::Approx(3).epsilon(1e-3)); // float needles of up to 1 : 4000
        };
        check(Published{});
        check(Published{.excess = {0.1}}.with_kernel(ConeKernel{}).with_collapse(tests::WidenCollapsed{}));
        check(Published{.excess = {0.3}}.with_filter(NoPixelFilter{}).with_collapse(tests::WidenCollapsed{}));
    }
}

// The filter's disk: sqrt(2/3) of the spacing for the biweight kernel, 1/√3 for the uniform one.
TEST_CASE_TEMPLATE("splat: the pixel filter adds its disk in quadrature and can be scaled or left out", T, float,
                   double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    const auto deposit = deposit_at<T>(0.5, 0.5, 0.2, 0, 0.05, std::numbers::pi / 2);
    const auto lengths = [&](const auto& policies) {
        const auto outcome = make_splat(deposit, map, policies);
        REQUIRE(outcome.splat);
        return std::array{1 / double(length(outcome.splat->row_a)), 1 / double(length(outcome.splat->row_b))};
    };
    const auto check = [&](const auto& policies, double disk) {
        const auto [a, b] = lengths(policies);
        CHECK(std::abs(a - std::sqrt(0.01 + disk * disk)) <= 16 * epsilon<T>);
        CHECK(std::abs(b - std::sqrt(0.000625 + disk * disk)) <= 16 * epsilon<T>);
    };
    check(Published{}, std::sqrt(2.0 / 3) * spacing);
    check(Published{.filter = {3}}, 3 * std::sqrt(2.0 / 3) * spacing);
    check(Published{}.with_kernel(UniformKernel{}), std::sqrt(1.0 / 3) * spacing);
    check(Published{}.with_filter(NoPixelFilter{}), 0);
}

// The outline of the ellipse moved by the thickness to both sides touches all faces of the box.
TEST_CASE_TEMPLATE("splat: the box is tight around the points that may receive", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    Draws draw(63);
    for (int i = 0; i < 50; ++i) {
        const auto n = tests::narrow<Vec<T>>(draw.direction());
        const auto frame = frame_about(n);
        const auto in_plane = [&] { return Vec<T>(T(draw.in(-0.3, 0.3)) * frame.u + T(draw.in(-0.3, 0.3)) * frame.v); };
        const Deposit<Vec<T>, T> deposit{{T(0.3), T(0.4), T(0.1)}, n, -n, T(1), {in_plane(), in_plane()}};
        const auto outcome = make_splat(deposit, map, Published{.normal_distance = 0.75});
        REQUIRE(outcome.splat);
        const auto& splat = *outcome.splat;
        {
            const Covariance c(deposit, std::sqrt(2.0 / 3) * spacing);
            const double thickness = (std::max)(0.75 * c.minor(), spacing);
            const glm::dvec3 half{(double(splat.box.high[0]) - double(splat.box.low[0])) / 2,
                                  (double(splat.box.high[1]) - double(splat.box.low[1])) / 2,
                                  (double(splat.box.high[2]) - double(splat.box.low[2])) / 2};
            const glm::dvec3 normal(n);
            const auto expected = [&](double e1, double e2, double along) {
                return std::sqrt(c.xx * e1 * e1 + 2 * c.xy * e1 * e2 + c.yy * e2 * e2) + thickness * std::abs(along);
            };
            const double tolerance = 64 * epsilon<T>;
            CHECK(std::abs(half.x - expected(c.e1.x, c.e2.x, normal.x)) <= tolerance);
            CHECK(std::abs(half.y - expected(c.e1.y, c.e2.y, normal.y)) <= tolerance);
            CHECK(std::abs(half.z - expected(c.e1.z, c.e2.z, normal.z)) <= tolerance);
            const glm::dvec3 middle{double(splat.box.high[0]) + double(splat.box.low[0]),
                                    double(splat.box.high[1]) + double(splat.box.low[1]),
                                    double(splat.box.high[2]) + double(splat.box.low[2])};
            const glm::dvec3 centre(splat.centre);
            CHECK(std::abs(middle.x / 2 - centre.x) <= tolerance);
            CHECK(std::abs(middle.y / 2 - centre.y) <= tolerance);
            CHECK(std::abs(middle.z / 2 - centre.z) <= tolerance);
            CHECK(std::abs(1 / double(length(splat.row_n)) - thickness) <= tolerance);
        }
    }
}

TEST_CASE_TEMPLATE("splat: a footprint with NaN is invalid", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    for (const T bad : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
        auto deposit = deposit_at<T>(0.5, 0.5, 0.1, 0, 0.1, 1);
        deposit.d_position[1].x = bad;
        CHECK(make_splat(deposit, map, Published{}).fate == Fate::invalid);
        deposit = deposit_at<T>(0.5, 0.5, 0.1, 0, 0.1, 1);
        deposit.position.y = bad;
        CHECK(make_splat(deposit, map, Published{}).fate == Fate::invalid);
        Deposit<Vec<T>, T, 3> three{
            {T(0.5), T(0.5), 0}, {0, 0, 1}, {0, 0, -1}, 1, {Vec<T>{1, 0, 0}, {0, 1, 0}, {0, bad, 0}}};
        CHECK(make_splat(three, map, Published{}).fate == Fate::invalid);
    }
}

TEST_CASE_TEMPLATE("splat: a discarded footprint has the policy's fate", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    const auto needle = deposit_at<T>(0.5, 0.5, 0.1, 0, 0, 0), point = deposit_at<T>(0.5, 0.5, 0, 0, 0, 0);
    const auto bare = Published{}.with_filter(NoPixelFilter{});
    CHECK(make_splat(needle, map, bare).fate == Fate::collapsed);
    CHECK(make_splat(point, map, bare).fate == Fate::collapsed);
    CHECK(!make_splat(point, map, bare).splat);
    CHECK(make_splat(needle, map, Published{}).fate == Fate::splatted);
    CHECK(make_splat(point, map, Published{}).fate == Fate::splatted);
    CHECK(!make_splat(point, map, Published{}).bounded);
    const auto widen = bare.with_collapse(tests::WidenCollapsed{});
    CHECK(make_splat(point, map, widen).fate == Fate::splatted);
    CHECK(make_splat(point, map, widen).bounded);

    const auto endless = deposit_at<T>(0.5, 0.5, 100, 0, 0.1, 1);
    CHECK(make_splat(endless, map, Published{}).bounded);
    const auto discard = Published{}.with_excess(tests::DiscardExcess{});
    CHECK(make_splat(endless, map, discard).fate == Fate::excessive);
    CHECK(make_splat(needle, map, discard).fate == Fate::splatted);
}

// The irradiance of all but nothing of an area is a number too large to be one: infinity times the kernel's zero
// outside is NaN, and would be added to every vertex of a leaf.
TEST_CASE_TEMPLATE("splat: a footprint too small for its flux has collapsed", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    const T least = std::sqrt((std::numeric_limits<T>::min)());
    auto deposit = deposit_at<T>(0.5, 0.5, double(least) * 2, 0, double(least) * 2, std::numbers::pi / 2);
    deposit.flux = T(1000);
    const auto outcome = make_splat(deposit, map, Published{}.with_filter(NoPixelFilter{}));
    CHECK(outcome.fate == Fate::collapsed);
}

// Whatever a grazing ray makes, up to where its squares overflow: never a splat that is no number.
TEST_CASE_TEMPLATE("splat: the longest possible footprints make finite splats", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    for (int power = 0; power < std::numeric_limits<T>::max_exponent; power += 4) {
        Deposit<Vec<T>, T> deposit{{T(0.5), T(0.5), 0},
                                   {0, 0, 1},
                                   {1, 0, 0},
                                   T(1),
                                   {Vec<T>{std::ldexp(T(0.6), power), std::ldexp(T(0.8), power), 0}, {0, T(0.1), 0}}};
        CAPTURE(power);
        for (int both = 0; both < 2; ++both) {
            const auto outcome = make_splat(deposit, map, Published{});
            if (outcome.fate == Fate::splatted) {
                CHECK(all_finite(outcome.splat->row_a));
                CHECK(all_finite(outcome.splat->row_b));
                CHECK(isfinite(outcome.splat->peak));
                CHECK(double(outcome.splat->box.high[0]) < 100); // bounded at the map's diagonal
            }
            if (power <= 60) // squares of lengths still are numbers
                CHECK(outcome.fate == Fate::splatted);
            deposit.d_position[1] = {std::ldexp(T(-0.8), power), std::ldexp(T(0.6), power), 0};
        }
    }
}

TEST_CASE_TEMPLATE("splat: an empty map or a single vertex is handled", T, float, double) {
    using V = Vec<T>;
    const auto deposit = deposit_at<T>(0.5, 0.5, 0.1, 0, 0.1, 1), point = deposit_at<T>(0.5, 0.5, 0, 0, 0, 0);
    const auto nothing = map_of(std::vector<Vertex<V>>{});
    const auto single = map_of(std::vector<Vertex<V>>{{{T(0.5), T(0.5), 0}, {0, 0, 1}}});
    for (const auto* map : {&nothing, &single}) {
        CHECK(make_splat(deposit, *map, Published{}).fate == Fate::splatted);
        CHECK(make_splat(point, *map, Published{}).fate == Fate::collapsed); // no spacing to widen it by
    }
}

TEST_CASE_TEMPLATE("splat: accepts any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        std::vector<Vertex<V>> vertices;
        for (int i = 0; i < 100; ++i)
            vertices.push_back({make_vector<V>(T(i % 10), T(i / 10), 0), make_vector<V>(0, 0, 1)});
        const auto map = map_of(vertices);
        const V n = make_vector<V>(0, 0, 1);
        const Deposit<V, T> deposit{
            make_vector<V>(5, 5, 0), n, -n, T(2), {make_vector<V>(2, 0, 0), make_vector<V>(0, 4, 0)}};
        const auto outcome = make_splat(deposit, map, Published{}.with_filter(NoPixelFilter{}));
        REQUIRE(outcome.splat.has_value());
        CHECK(std::abs(double(outcome.splat->peak) - 1) <= 4 * epsilon<T>);
        CHECK(flux_of(*outcome.splat) == doctest::Approx(2));
    });
}

TEST_CASE_TEMPLATE("splat: a fixed footprint is a disk with any differential or none", T, float, double) {
    const auto vertices = lattice<T>();
    const auto map = map_of(vertices);
    const auto bare_disk = [](double radius) {
        return Published{}.with_kernel(UniformKernel{}).with_filter(NoPixelFilter{}).with_shape(FixedFootprint{radius});
    };
    const auto policies = bare_disk(0.25);
    const auto whole = deposit_at<T>(0.5, 0.5, 0.1, 0, 0.3, 1);
    const Deposit<Vec<T>, T, 0> bare{whole.position, whole.normal, whole.direction, whole.flux, {}};
    const auto one = make_splat(whole, map, policies), other = make_splat(bare, map, policies);
    REQUIRE(one.splat);
    REQUIRE(other.splat);
    const double tolerance = 8 * double(std::numeric_limits<T>::epsilon());
    for (const auto& splat : {*one.splat, *other.splat}) {
        // Rows of length 1/radius, across each other and in the plane; the flux over radius².
        CHECK(std::abs(double(length(splat.row_a)) - 4) <= 4 * tolerance);
        CHECK(std::abs(double(length(splat.row_b)) - 4) <= 4 * tolerance);
        CHECK(std::abs(double(dot(splat.row_a, splat.row_b))) <= 16 * tolerance);
        CHECK(std::abs(double(dot(splat.row_a, splat.normal))) <= 4 * tolerance);
        CHECK(std::abs(double(splat.peak) - 16 * double(whole.flux)) <= 16 * tolerance * double(whole.flux));
    }
    CHECK(one.splat->row_a == other.splat->row_a);
    CHECK(one.splat->peak == other.splat->peak);
    // The pixel filter widens it as any other.
    const auto filtered = Published{}.with_shape(FixedFootprint{0.25});
    const double p = double(map.spacing_at(whole.position)), wide = 0.0625 + 2.0 / 3 * p * p;
    CHECK(double(make_splat(bare, map, filtered).splat->peak) == doctest::Approx(double(whole.flux) / wide));
    // A differential that is no number does not matter; a position does.
    auto odd = whole;
    odd.d_position[0].x = std::numeric_limits<T>::quiet_NaN();
    CHECK(make_splat(odd, map, policies).fate == Fate::splatted);
    odd.position.x = std::numeric_limits<T>::quiet_NaN();
    CHECK(make_splat(odd, map, policies).fate == Fate::invalid);
    // A radius that is none makes no splat.
    for (const double radius : {0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        CHECK(!make_splat(bare, map, bare_disk(radius)).splat);
}

} // namespace nephroid::tests::splat_test
