// SPDX-License-Identifier: MIT
#include "nephroid/differential/refraction.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace nephroid::tests::refraction_test {

using tests::derivative;
using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

template <class T>
double epsilon() {
    return double(std::numeric_limits<T>::epsilon());
}

/// A ray that meets a turning surface, as the vector type V rounds it, and the cosine it leaves with.
template <class V>
struct Event {
    Space ray, d_ray, normal, d_normal;
    Wide eta, d_eta;

    // Leaves with a cosine of at least 1/8 and meets the surface with one of at least 1/50.
    explicit Event(Draws& draw) {
        const auto rounded = [](const Space& s) { return tests::widen(tests::narrow<V>(s)); };
        do {
            ray = rounded(draw.direction()).unit();
            normal = rounded(draw.direction()).unit();
            if (ray.dot(normal) > Wide(0))
                normal = Wide(-1) * normal;
            eta = static_cast<scalar_t<V>>(draw.in(0.4, 2.5));
        } while (-ray.dot(normal) < Wide(0.02) || cosine2() < Wide(1.0 / 64));
        d_ray = rounded(draw.in_cube().across(ray)).across(ray);
        d_normal = rounded(draw.in_cube().across(normal)).across(normal);
        d_eta = static_cast<scalar_t<V>>(draw.in(-1, 1));
    }
    [[nodiscard]] Wide cosine2() const {
        const Wide sine = eta * ray.cross(normal).length();
        return (Wide(1) - sine) * (Wide(1) + sine);
    }
    [[nodiscard]] Space bent(const Wide& p, bool dispersed) const {
        return tests::bent((ray + p * d_ray).unit(), (normal + p * d_normal).unit(), dispersed ? eta + p * d_eta : eta);
    }
    [[nodiscard]] std::optional<Refraction<V>> found() const {
        return refraction(tests::narrow<V>(ray), tests::narrow<V>(normal), static_cast<scalar_t<V>>(eta));
    }
};

// In halves u of epsilon, with H = max(1, eta²) and the refracted cosine c'. ω·n: 5 u with ω and n unit to 2 u.
// c'² = 1 − eta² sin²: eta² (2 · 5 + 3) u + u, so c' is off by 7 H u / c'. μ = eta c − c': 6 eta u + 7 H u /
// c'; the sum eta ω + μ n adds 4 (eta + 1) u and normalising 6 u. Together below 32 H u / c' = 16 epsilon H / c'.
TEST_CASE_TEMPLATE("refraction: obeys the law of Snell", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(61);
        for (int i = 0; i < 100; ++i) {
            const Event<V> e(draw);
            const auto found = e.found();
            REQUIRE(found.has_value());
            const double h = std::max(1.0, double(e.eta * e.eta)), c = std::sqrt(double(e.cosine2()));
            const double tolerance = 16 * epsilon<T>() * h / c;
            CHECK(tests::distance(found->direction(), tests::bent(e.ray, e.normal, e.eta)) <= tolerance);
            CHECK(std::abs(double(Wide(found->cos_refracted()) - sqrt(e.cosine2()))) <= tolerance);
            CHECK(std::abs(tests::magnitude(tests::widen(found->direction())) - 1) <= 3 * epsilon<T>());
        }
    });
}

// As above, D = |dω| + |dn| + |d eta|. dc: 6 u D. g = dμ/dc = eta − eta² c/c': eta² (5/c' + 7 H/c'³) u for its c
// and c', 4 u of its own; |g| <= eta + eta²/c'. dμ/d eta = c + eta sin²/c': (5 + 13 eta/c' + 7 eta H/c'³) u. μ dn:
// 6 eta u + 7 H u/c'. Then the sum's and the projection's roundings, ten of |dω'| <= D (3 eta + eta²/c' + 2 +
// eta/c'), and the error 32 H u/c' of ω' twice in the projection. All terms are at most H² / c'³: their coefficients
// sum to less than 256 u = 128 epsilon. The difference: c' and the incident sine vanish at |p| >= c'²/8 or leave the
// domain; the sine's zero is a removable singularity.
template <class V>
void check_derivative(const Event<V>& e, bool dispersed) {
    using T = scalar_t<V>;
    const auto at = e.found();
    REQUIRE(at.has_value());
    const V d_ray = tests::narrow<V>(e.d_ray), d_normal = tests::narrow<V>(e.d_normal);
    const V found =
        dispersed ? at->differentiate(d_ray, d_normal, static_cast<T>(e.d_eta)) : at->differentiate(d_ray, d_normal);
    const Space expected = derivative([&](const Wide& p) { return e.bent(p, dispersed); });

    const double h = std::max(1.0, double(e.eta * e.eta)), c2 = double(e.cosine2()), c = std::sqrt(c2);
    const double d =
        tests::magnitude(e.d_ray) + tests::magnitude(e.d_normal) + (dispersed ? std::abs(double(e.d_eta)) : 0);
    const double tolerance = 128 * epsilon<T>() * d * h * h / (c2 * c) + tests::derivative_error(c2 / (8 * h)) * 2;
    CHECK(tests::distance(found, expected) <= tolerance);
    CHECK(std::abs(double(tests::widen(found).dot(tests::widen(at->direction())))) <= tolerance); // orthogonal
}

TEST_CASE_TEMPLATE("refraction: differentiates as differences do", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(62);
        for (int i = 0; i < 100; ++i)
            check_derivative(Event<V>(draw), false);
    });
}

TEST_CASE_TEMPLATE("refraction: differentiates by the index as differences do", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(63);
        for (int i = 0; i < 100; ++i)
            check_derivative(Event<V>(draw), true);
    });
}

// Straight through: ω' = ω, and to first order the angles are in the ratio of the indices: dω' = eta dω + (eta −
// 1) dn. All exact but for products.
TEST_CASE_TEMPLATE("refraction: at normal incidence small angles are in the ratio of the indices", T, float, double,
                   Wide) {
    tests::for_each_vector<T>([]<class V>() {
        for (const double index : {1.5, 1 / 1.33, 1.0}) {
            const T eta = T(index);
            const auto found = refraction(make_vector<V>(0, 0, -1), make_vector<V>(0, 0, 1), eta);
            REQUIRE(found.has_value());
            CHECK(tests::distance(found->direction(), Space{0, 0, -1}) <= 2 * epsilon<T>());
            CHECK(abs(found->cos_refracted() - T(1)) <= T(0));
            const Space expected = Wide(eta) * Space{1, 2, 0} + (Wide(eta) - Wide(1)) * Space{3, -1, 0};
            CHECK(tests::distance(found->differentiate(make_vector<V>(1, 2, 0), make_vector<V>(3, -1, 0)), expected) <=
                  4 * epsilon<T>() * (2.3 + 3.2) * index);
            // The index does not turn a ray that is not bent.
            CHECK(tests::distance(found->differentiate(zero_vector<V>(), zero_vector<V>(), T(1)), Space{0, 0, 0}) <=
                  8 * epsilon<T>());
        }
    });
}

// Two unit vectors whose product rounds to more than one.
TEST_CASE_TEMPLATE("refraction: survives a cosine that rounds to more than one", T, float, double) {
    using V = foreign::Plain<T>;
    Draws draw(64);
    int above = 0;
    for (int i = 0; i < 1000; ++i) {
        const V normal = tests::narrow<V>(draw.direction());
        const V direction{-normal.x, -normal.y, -normal.z};
        above += dot(normal, normal) > 1 ? 1 : 0;
        for (const T eta : {T(1.5), T(1) / T(1.5)}) {
            const auto found = refraction(direction, normal, eta);
            REQUIRE(found.has_value());
            CHECK(found->cos_refracted() <= 1);
            CHECK(all_finite(found->differentiate({1, 2, 3}, {4, 5, 6}, T(1))));
        }
    }
    CHECK(above > 0); // or this tests nothing
}

// The apex focal length of one refracting sphere, from n1 into n2: a paraxial ray at height y turns by −y (1 − eta)
// / R.
TEST_CASE_TEMPLATE("refraction: a sphere's first surface focuses at R over one minus eta", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const T radius = T(0.5), eta = T(1) / T(1.5);
        const auto surface = refraction(make_vector<V>(0, 0, -1), make_vector<V>(0, 0, 1), eta);
        REQUIRE(surface.has_value());
        const V found = surface->differentiate(zero_vector<V>(), make_vector<V>(1 / radius, 0, 0));
        const double expected = -(1 - double(eta)) / double(radius);
        CHECK(tests::distance(found, Space{expected, 0, 0}) <= 4 * epsilon<T>() / double(radius));
    });
}

/// A ray in the xz plane, downwards, whose sine is the given one.
template <class V>
V at_sine(const Wide& sine) {
    return tests::narrow<V>({sine, 0, -sqrt(Wide(1) - sine * sine)});
}

// c'² = 1 − eta² sin² is found to 13 eta² u + u (above) <= 16 epsilon for eta = 1.5; just beyond and just below
// mean more than that.
TEST_CASE_TEMPLATE("refraction: is finite just below the critical angle and nothing just beyond it", T, float, double,
                   Wide) {
    tests::for_each_vector<T>([]<class V>() {
        const V up = make_vector<V>(0, 0, 1);
        const Wide margin = Wide(16) * std::numeric_limits<T>::epsilon(), eta = 1.5;
        CHECK(!refraction(at_sine<V>(sqrt(Wide(1) + margin) / eta), up, T(1.5)).has_value());
        const auto below = refraction(at_sine<V>(sqrt(Wide(1) - margin) / eta), up, T(1.5));
        REQUIRE(below.has_value());
        CHECK(below->cos_refracted() > T(0));
        const V huge = below->differentiate(make_vector<V>(0, 1, 0), make_vector<V>(1, 0, 0));
        CHECK(all_finite(huge));
        // |dω'| is about eta² c sin'... / c' for a normal that turns in the plane: it does diverge, and is not
        // hidden.
        CHECK(tests::magnitude(tests::widen(huge)) > 0.1 / std::sqrt(32 * epsilon<T>()));
        CHECK(!refraction(at_sine<V>(Wide(0.9)), up, T(1.5)).has_value()); // total internal reflection
    });
}

TEST_CASE_TEMPLATE("refraction: refuses a normal on the wrong side and a grazing ray", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        const V down = make_vector<V>(T(0.6), 0, T(-0.8));
        CHECK(refraction(down, make_vector<V>(0, 0, 1), T(0.75)).has_value());
        CHECK(!refraction(down, make_vector<V>(0, 0, -1), T(0.75)).has_value());
        CHECK(!refraction(make_vector<V>(1, 0, 0), make_vector<V>(0, 0, 1), T(0.75)).has_value());
    });
    if constexpr (std::is_floating_point_v<T>) {
        const T nan = std::numeric_limits<T>::quiet_NaN();
        CHECK(!refraction(foreign::Plain<T>{nan, 0, -1}, {0, 0, 1}, T(0.75)).has_value());
        CHECK(!refraction(foreign::Plain<T>{0, 0, -1}, {0, 0, 1}, nan).has_value());
    }
}

// What rounding has put along the ray does not stay. |dω'| <= 2.5 (1 + 1 + 1/c') (3 + 3) for these; 3 epsilon for ω',
// five roundings.
TEST_CASE_TEMPLATE("refraction: the derivative is orthogonal to the ray even where the incoming one is not", T, float,
                   double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(66);
        for (int i = 0; i < 100; ++i) {
            const Event<V> e(draw);
            const auto found = e.found();
            REQUIRE(found.has_value());
            const V askew = tests::narrow<V>(e.d_ray + e.ray), d_normal = tests::narrow<V>(e.d_normal + e.normal);
            const double size = 16 * std::max(1.0, double(e.eta * e.eta)) * (2 + 1 / std::sqrt(double(e.cosine2())));
            const Space direction = tests::widen(found->direction());
            CHECK(std::abs(double(tests::widen(found->differentiate(askew, d_normal)).dot(direction))) <=
                  8 * epsilon<T>() * size);
            const V d_eta_too = found->differentiate(askew, d_normal, static_cast<T>(e.d_eta));
            CHECK(std::abs(double(tests::widen(d_eta_too).dot(direction))) <= 2 * 8 * epsilon<T>() * size);
        }
    });
}

// c' = c exactly, so ω' = ω and dω' = dω whatever the surface does: 4 roundings; then c'/c is off by u and dμ/dc
// by as much.
TEST_CASE_TEMPLATE("refraction: equal indices bend nothing even at grazing incidence", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        const V up = make_vector<V>(0, 0, 1), d_ray = make_vector<V>(0, 1, 0), d_normal = make_vector<V>(3, 4, 0);
        for (const double cosine : {0.5, 0.02, 1e-3, 1e-6}) {
            const Space ray{sqrt(Wide(1) - Wide(cosine) * Wide(cosine)), 0, -Wide(cosine)};
            const auto found = refraction(tests::narrow<V>(ray), up, T(1));
            REQUIRE(found.has_value());
            CHECK(tests::distance(found->direction(), ray) <= 4 * epsilon<T>());
            CHECK(tests::distance(found->differentiate(d_ray, d_normal), Space{0, 1, 0}) <= 4 * epsilon<T>() * (1 + 5));
        }
    });
}

// Light's way back is its way: refracting the reversed refracted ray by 1/eta on the other side gives the reversed ray.
TEST_CASE_TEMPLATE("refraction: can be undone from the other side", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(65);
        for (int i = 0; i < 100; ++i) {
            const Event<V> e(draw);
            const auto there = e.found();
            REQUIRE(there.has_value());
            const Space reversed = Wide(-1) * tests::widen(there->direction());
            const auto back = refraction(tests::narrow<V>(reversed), tests::narrow<V>(Wide(-1) * e.normal),
                                         static_cast<T>(Wide(1) / e.eta));
            REQUIRE(back.has_value());
            // Each way 16 epsilon H / c'; the way there, seen through the way back, times its slope: 1/eta + 1/(eta²
            // c).
            const double eta = double(e.eta), c = -double(e.ray.dot(e.normal)), c_bent = std::sqrt(double(e.cosine2()));
            const double there_error = 16 * epsilon<T>() * std::max(1.0, eta * eta) / c_bent;
            const double back_error = 16 * epsilon<T>() * std::max(1.0, 1 / (eta * eta)) / c;
            const double slope = 1 / eta + (1 / eta + 1 / (eta * eta * c)); // |dω| plus |dμ|
            CHECK(tests::distance(back->direction(), Wide(-1) * e.ray) <= slope * there_error + back_error);
        }
    });
}

// dn means the derivative of the normal that was given: with the other sign it is a lens of the other kind.
TEST_CASE_TEMPLATE("refraction: turning only the derivative of the normal round turns the lens round", T, float,
                   double) {
    tests::for_each_vector<T>([]<class V>() {
        const auto surface = refraction(make_vector<V>(0, 0, -1), make_vector<V>(0, 0, 1), T(0.5));
        REQUIRE(surface.has_value());
        CHECK(tests::distance(surface->differentiate(zero_vector<V>(), make_vector<V>(1, 0, 0)), Space{-0.5, 0, 0}) ==
              0);
        CHECK(tests::distance(surface->differentiate(zero_vector<V>(), make_vector<V>(-1, 0, 0)), Space{0.5, 0, 0}) ==
              0);
    });
}

} // namespace

} // namespace nephroid::tests::refraction_test
