// SPDX-License-Identifier: MIT
#include "nephroid/footprint/ellipse.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nephroid::tests::ellipse_test {

using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
constexpr double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());

double narrow(const Wide& x) { return static_cast<double>(x); }

/// In a random plane: |a| = size, |b| = size * ratio, at an angle from a. 0 and π are collapsed, π/2 is not skewed.
template <class V>
Ellipse<V> ellipse_in(Draws& draw, double size, double ratio, double angle) {
    const Space n = tests::widen(tests::narrow<V>(draw.direction()));
    Space across = draw.direction().across(n);
    while (narrow(across.length()) < 0.1)
        across = draw.direction().across(n);
    const Space e1 = across.unit(), e2 = n.cross(e1);
    return {tests::narrow<V>(Wide(size) * e1),
            tests::narrow<V>(Wide(size * ratio) * (Wide(std::cos(angle)) * e1 + Wide(std::sin(angle)) * e2)),
            tests::narrow<V>(n)};
}

/// The same in wide precision, moved into its plane: rounding leaves the given axes off it by as much.
struct Exact {
    Space a, b, n;
    template <class V>
    explicit Exact(const Ellipse<V>& e) : n(tests::widen(e.normal).unit()) {
        a = tests::widen(e.a).across(n);
        b = tests::widen(e.b).across(n);
    }
    [[nodiscard]] Wide scale() const { return n.dot(a.cross(b)); }
    [[nodiscard]] Space at(double phi) const { return Wide(std::cos(phi)) * a + Wide(std::sin(phi)) * b; }
    /// sqrt of the eigenvalues of the 2 x 2 covariance in the plane, plus r².
    [[nodiscard]] std::array<Wide, 2> radii(const Wide& r = 0) const {
        const Wide half = Wide(0.5) * (a.dot(a) + b.dot(b)), difference = Wide(0.5) * (a.dot(a) - b.dot(b));
        const Wide major2 = half + sqrt(difference * difference + a.dot(b) * a.dot(b));
        const Wide minor2 = major2 > Wide(0) ? scale() * scale() / major2 : Wide(0);
        return {sqrt(major2 + r * r), sqrt(minor2 + r * r)};
    }
};

using Matrix = std::array<std::array<Wide, 3>, 3>;

void add_outer(Matrix& m, const Space& v, const Wide& factor = 1) {
    const std::array<Wide, 3> c{v.x, v.y, v.z};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            m[i][j] = m[i][j] + factor * c[i] * c[j];
}

template <class V>
Matrix covariance(const Ellipse<V>& e) {
    Matrix m{};
    add_outer(m, tests::widen(e.a));
    add_outer(m, tests::widen(e.b));
    return m;
}

double largest_difference(const Matrix& a, const Matrix& b) {
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            largest = (std::max)(largest, narrow(abs(a[i][j] - b[i][j])));
    return largest;
}

/// a aᵀ + b bᵀ + r² (I − n nᵀ)
template <class V>
Matrix with_disk(const Ellipse<V>& e, double r) {
    Matrix m = covariance(e);
    const Wide r2 = Wide(r) * Wide(r);
    for (std::size_t i = 0; i < 3; ++i)
        m[i][i] = m[i][i] + r2;
    add_outer(m, tests::widen(e.normal), -r2);
    return m;
}

template <class V>
double trace(const Ellipse<V>& e) {
    return narrow(tests::widen(e.a).dot(tests::widen(e.a)) + tests::widen(e.b).dot(tests::widen(e.b)));
}

} // namespace

TEST_CASE_TEMPLATE("footprint: its semi-axes are half the displacements", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const Ellipse<V> e = footprint(make_vector<V>(2, 4, 0), make_vector<V>(-6, 1, 0), make_vector<V>(0, 0, 1));
        CHECK(tests::distance(e.a, {1, 2, 0}) == 0);
        CHECK(tests::distance(e.b, {-3, 0.5, 0}) == 0);
        CHECK(narrow(Wide(area_scale(e))) == 6.5); // 1 · 0.5 − 2 · (−3), no rounding
        CHECK(narrow(Wide(area_scale(Ellipse<V>{e.b, e.a, e.normal}))) == -6.5);
    });
}

// The polygon through m points of the ellipse at even steps of φ has exactly the area |a × b| m/2 sin(2π/m). The
// cross product is right to a few roundings of itself (not of |a| |b|), the dot product adds a few of its length.
TEST_CASE_TEMPLATE("ellipse: the area is that of a polygon on its outline", T, float, double) {
    Draws draw(1);
    constexpr int m = 64;
    for (int i = 0; i < 200; ++i) {
        const auto e = ellipse_in<Vec<T>>(draw, draw.in(0.1, 3), draw.in(0.01, 1), draw.in(0.01, 3.1));
        const Exact exact(e);
        Wide doubled = 0;
        for (int k = 0; k < m; ++k) {
            const double step = 2 * std::numbers::pi / m;
            doubled = doubled + exact.n.dot(exact.at(k * step).cross(exact.at((k + 1) * step)));
        }
        const double polygon = std::abs(narrow(doubled)) / 2;
        const double expected = polygon / (m / (2 * std::numbers::pi) * std::sin(2 * std::numbers::pi / m));
        // The axes' rounding out of the plane tilts a × b by up to epsilon / sin: second order in the area.
        const double sine = narrow(abs(exact.scale()) / (exact.a.length() * exact.b.length()));
        const double tolerance = 8 * epsilon<T> * (1 + epsilon<T> / (sine * sine)) * expected;
        CHECK(std::abs(double(area(e)) - expected) <= tolerance);
    }
}

// In the plane z = 0 nothing rounds out of it: to a few roundings for any size and shape.
TEST_CASE_TEMPLATE("ellipse: the radii are the singular values from circles to needles", T, float, double) {
    const double least_ratio = std::is_same_v<T, float> ? 1e-4 : 1e-6;
    Draws draw(2);
    for (const double size : {1e-10, 1e-5, 1.0, 1e3, 1e10})
        for (const double ratio : {1.0, 0.999, 0.7, 0.1, 1e-3, least_ratio})
            for (const double angle : {0.0, 1e-4, 0.3, std::numbers::pi / 4, std::numbers::pi / 2, 2.0, 3.1}) {
                const double turn = draw.in(0, 6.28);
                const auto at = [&](double radius, double a) {
                    return Vec<T>{T(radius * std::cos(a)), T(radius * std::sin(a)), 0};
                };
                const Ellipse<Vec<T>> e{at(size, turn), at(size * ratio, turn + angle), {0, 0, 1}};
                const auto expected = Exact(e).radii();
                const auto sigma = radii(e);
                CAPTURE(size);
                CAPTURE(ratio);
                CAPTURE(angle);
                CHECK(std::abs(double(sigma.major) - narrow(expected[0])) <= 8 * epsilon<T> * narrow(expected[0]));
                CHECK(std::abs(double(sigma.minor) - narrow(expected[1])) <= 16 * epsilon<T> * narrow(expected[1]));
                CHECK(sigma.minor <= sigma.major);
            }
}

// |x(φ)|² is a constant plus a cosine of 2φ: m steps miss its extremes by (π/m)² of its amplitude at most.
TEST_CASE_TEMPLATE("ellipse: the radii are the longest and the shortest distance to the outline", T, float, double) {
    Draws draw(3);
    constexpr int m = 1024;
    const double missed = 2 * std::pow(std::numbers::pi / m, 2);
    for (int i = 0; i < 50; ++i) {
        const auto e = ellipse_in<Vec<T>>(draw, draw.in(0.1, 3), draw.in(0.05, 1), draw.in(0.1, 3));
        const Exact exact(e);
        double longest2 = 0, shortest2 = 1e9;
        for (int k = 0; k < m; ++k) {
            const Space x = exact.at(std::numbers::pi * k / m);
            longest2 = (std::max)(longest2, narrow(x.dot(x)));
            shortest2 = (std::min)(shortest2, narrow(x.dot(x)));
        }
        const double rounding = 64 * epsilon<T> * longest2;
        const auto sigma = radii(e);
        CHECK(std::abs(square(double(sigma.major)) - longest2) <= missed * longest2 + rounding);
        CHECK(std::abs(square(double(sigma.minor)) - shortest2) <= missed * longest2 + rounding);
        CHECK(double(sigma.major) * double(sigma.minor) ==
              doctest::Approx(narrow(abs(exact.scale()))).epsilon(64 * epsilon<T>));
    }
}

// Two unit axes at the angle t span an ellipse of major radius sqrt(1 + cos t), up to √2: the paper's ½ max(|Dux|,
// |Dvx|) is 1 whatever t.
TEST_CASE("ellipse: the longer axis vector is up to root two shorter than the major radius") {
    for (const double t : {1e-3, 0.1, 0.5, 1.0, 1.5}) {
        const Ellipse<glm::dvec3> e{{1, 0, 0}, {std::cos(t), std::sin(t), 0}, {0, 0, 1}};
        CHECK(std::abs(radii(e).major - std::sqrt(1 + std::cos(t))) <= 1e-15);
        CHECK(std::abs(radii(e).minor - std::sqrt(2) * std::sin(t / 2)) <= 1e-15);
    }
    const Ellipse<glm::dvec3> thin{{1, 0, 0}, {std::cos(1e-3), std::sin(1e-3), 0}, {0, 0, 1}};
    CHECK(radii(thin).major > 1.41421);
    CHECK((std::max)(length(thin.a), length(thin.b)) <= 1);
}

// Lengths of scenes in nanometres and in light years: a power of two scales every rounding.
TEST_CASE_TEMPLATE("ellipse: a scaled ellipse has the same shape bit for bit", T, float, double) {
    Draws draw(4);
    for (int i = 0; i < 50; ++i) {
        const auto e = ellipse_in<Vec<T>>(draw, draw.in(0.1, 3), draw.in(1e-3, 1), draw.in(0, 3.1));
        const T r = T(draw.in(0, 1));
        const auto wide = add_disk(e, r);
        // Areas of 1e-24 to 1e24, and 1e-60 to 1e60 in double.
        for (const int power :
             std::is_same_v<T, float> ? std::array{-40, -20, 20, 40} : std::array{-100, -40, 40, 100}) {
            const T scale = std::ldexp(T(1), power);
            const Ellipse<Vec<T>> scaled{scale * e.a, scale * e.b, e.normal};
            CAPTURE(power);
            CHECK(radii(scaled).major == scale * radii(e).major);
            CHECK(radii(scaled).minor == scale * radii(e).minor);
            CHECK(axis_ratio(scaled) == axis_ratio(e));
            const auto scaled_wide = add_disk(scaled, scale * r);
            CHECK(scaled_wide.a == scale * wide.a);
            CHECK(scaled_wide.b == scale * wide.b);
        }
    }
}

TEST_CASE_TEMPLATE("ellipse: the box touches the outline on all sides and contains it", T, float, double) {
    Draws draw(5);
    constexpr int m = 2048;
    for (int i = 0; i < 50; ++i) {
        const auto e = ellipse_in<Vec<T>>(draw, draw.in(0.1, 3), draw.in(0, 1), draw.in(0, 3.1));
        const Exact exact(e);
        double x = 0, y = 0, z = 0;
        for (int k = 0; k < m; ++k) {
            const Space p = exact.at(2 * std::numbers::pi * k / m);
            x = (std::max)(x, narrow(p.x)), y = (std::max)(y, narrow(p.y)), z = (std::max)(z, narrow(p.z));
        }
        // A coordinate is a cosine of φ: the samples miss its top by 1 − cos(π/m) of it.
        const Vec<T> half = half_extents(e);
        const double missed = 0.5 * square(std::numbers::pi / m), rounding = 8 * epsilon<T> * std::sqrt(trace(e));
        for (const auto& [box, sampled] : {std::pair{double(half.x), x}, {double(half.y), y}, {double(half.z), z}}) {
            CHECK(box >= sampled - rounding);
            CHECK(box * (1 - missed) <= sampled + rounding);
        }
    }
}

// M's rows are right to a few roundings of 1 / (height of the parallelogram over the other axis).
TEST_CASE_TEMPLATE("filter matrix: takes the semi-axes to unit vectors and the outline to the unit circle", T, float,
                   double) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(6);
        for (int i = 0; i < 100; ++i) {
            const auto e = ellipse_in<V>(draw, draw.in(0.1, 3), draw.in(0.01, 1), draw.in(0.05, 3.09));
            const Exact exact(e);
            const auto m = filter_matrix(e);
            const Space row_a = tests::widen(m.row_a), row_b = tests::widen(m.row_b);
            const Wide sine = abs(exact.scale()) / (exact.a.length() * exact.b.length());
            const double tolerance = 16 * epsilon<T> / narrow(sine);
            CHECK(std::abs(narrow(row_a.dot(exact.a)) - 1) <= tolerance);
            CHECK(std::abs(narrow(row_b.dot(exact.b)) - 1) <= tolerance);
            // These compare with |row| |other axis| = |other| / (|own| sine).
            const double elongation = narrow(exact.a.length() / exact.b.length());
            CHECK(std::abs(narrow(row_a.dot(exact.b))) <= tolerance / elongation);
            CHECK(std::abs(narrow(row_b.dot(exact.a))) <= tolerance * elongation);
            CHECK(std::abs(narrow(row_a.dot(exact.n))) <= 8 * epsilon<T> * narrow(row_a.length()));
            CHECK(std::abs(narrow(row_b.dot(exact.n))) <= 8 * epsilon<T> * narrow(row_b.length()));
            for (int k = 0; k < 16; ++k) {
                const Space x = exact.at(k * 0.4);
                const double r2 = square(narrow(row_a.dot(x))) + square(narrow(row_b.dot(x)));
                CHECK(std::abs(r2 - 1) <= 4 * tolerance * (std::max)(elongation, 1 / elongation));
            }
        }
    });
}

TEST_CASE_TEMPLATE("ellipse: the axis ratio is exact", T, float, double) {
    Draws draw(7);
    for (int i = 0; i < 200; ++i) {
        const bool orthogonal = i % 4 == 0;
        const double angle = orthogonal ? std::numbers::pi / 2 : draw.in(0.05, 3.09);
        auto e = ellipse_in<Vec<T>>(draw, draw.in(0.1, 3), draw.in(0.02, 1), angle);
        if (i % 2 == 1)
            std::swap(e.a, e.b);
        const Exact exact(e);
        const auto sigma = exact.radii();
        CHECK(std::abs(double(axis_ratio(e)) - narrow(sigma[1] / sigma[0])) <= 32 * epsilon<T>);
    }
    using E = Ellipse<Vec<T>>;
    CHECK(axis_ratio(E{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}) == 1);
    CHECK(axis_ratio(E{{0, 0, 0}, {2, 0, 0}, {0, 0, 1}}) == 0);
    CHECK(radii(E{{0, 0, 0}, {0, 0, 0}, {0, 0, 1}}).major == 0);
    CHECK(area(E{{1, 1, 0}, {2, 2, 0}, {0, 0, 1}}) == 0);
}

// Every entry of the covariance is a sum of products of lengths: 32 roundings of |a|² + |b|² + r². And the minor
// radius keeps its own digits, which those entries do not have.
TEST_CASE_TEMPLATE("add_disk: the covariance grows by that of the disk", T, float, double) {
    const double least_ratio = std::is_same_v<T, float> ? 1e-3 : 1e-6;
    tests::for_each_vector<T>([&]<class V>() {
        Draws draw(8);
        for (const double ratio : {1.0, 0.5, 0.03, least_ratio, 0.0})
            for (const double angle : {std::numbers::pi / 2, 1.0, 2.5, 0.0})
                for (const double radius : {0.0, 1e-8, 1e-3, 0.3, 1.0, 20.0}) {
                    Ellipse<V> e = ellipse_in<V>(draw, draw.in(0.5, 2), ratio, angle);
                    if (draw.in(0, 1) < 0.5)
                        std::swap(e.a, e.b);
                    const auto wide = add_disk(e, T(radius));
                    CAPTURE(ratio);
                    CAPTURE(angle);
                    CAPTURE(radius);
                    const double tolerance = 32 * epsilon<T> * (trace(e) + radius * radius);
                    CHECK(largest_difference(covariance(wide), with_disk(e, double(T(radius)))) <= tolerance);
                    CHECK(tests::distance(wide.normal, tests::widen(e.normal)) == 0);

                    const auto expected = Exact(e).radii(Wide(T(radius)));
                    const auto sigma = radii(wide);
                    CHECK(std::abs(double(sigma.major) - narrow(expected[0])) <= 32 * epsilon<T> * narrow(expected[0]));
                    // What rounding took out of the plane is not minor radius: epsilon |a| |b| / |a|.
                    const double floor = 8 * epsilon<T> * (std::min)(double(length(e.a)), double(length(e.b)));
                    CHECK(std::abs(double(sigma.minor) - narrow(expected[1])) <=
                          64 * epsilon<T> * narrow(expected[1]) + floor);
                }
    });
}

TEST_CASE("add_disk: a needle a million times longer than wide keeps the digits of its width") {
    Draws draw(9);
    for (int i = 0; i < 100; ++i) {
        const auto e = ellipse_in<glm::dvec3>(draw, 1, 1e-6, draw.in(1.0, 2.0));
        for (const double radius : {0.0, 1e-8, 1e-6, 1e-4}) {
            const auto expected = Exact(e).radii(Wide(radius));
            const auto sigma = radii(add_disk(e, radius));
            CHECK(std::abs(sigma.minor - narrow(expected[1])) <= 32 * epsilon<double> * narrow(expected[1]));
            CHECK(std::abs(sigma.major - narrow(expected[0])) <= 32 * epsilon<double> * narrow(expected[0]));
        }
    }
}

TEST_CASE_TEMPLATE("add_disk: a point becomes a disk and a line segment becomes an ellipse", T, float, double) {
    const Vec<T> zero{0, 0, 0}, n{0, 0, -1}, long_axis{3, 4, 0};
    const auto check = [](const Ellipse<Vec<T>>& e, double major, double minor) {
        const auto sigma = radii(e);
        CHECK(std::abs(double(sigma.major) - major) <= 8 * epsilon<T> * major);
        CHECK(std::abs(double(sigma.minor) - minor) <= 8 * epsilon<T> * minor);
    };
    check(add_disk(Ellipse<Vec<T>>{zero, zero, n}, T(0.25)), 0.25, 0.25);
    check(add_disk(Ellipse<Vec<T>>{long_axis, zero, n}, T(12)), 13, 12);
    check(add_disk(Ellipse<Vec<T>>{zero, long_axis, n}, T(12)), 13, 12);
    check(add_disk(Ellipse<Vec<T>>{long_axis, -long_axis, n}, T(1)), std::sqrt(51.0), 1);
    const auto nothing = add_disk(Ellipse<Vec<T>>{zero, zero, n}, T(0));
    CHECK(nothing.a == zero);
    CHECK(nothing.b == zero);
}

// C(t) − C(0) = t² e eᵀ (and t (a eᵀ + e aᵀ) when a changes): no jump, however a footprint collapses.
TEST_CASE_TEMPLATE("add_disk: the ellipse is continuous through collapse", T, float, double) {
    Draws draw(10);
    const double least = std::is_same_v<T, float> ? 1e-30 : 1e-300;
    for (int i = 0; i < 20; ++i) {
        const auto e = ellipse_in<Vec<T>>(draw, 1, 1, 2.2);
        const Vec<T> zero{0, 0, 0};
        for (double t = 1; t > least; t *= 1e-3) {
            const T s = T(t), radius = T(0.5);
            const double tolerance = 2 * t * t + 64 * epsilon<T>;
            const Ellipse<Vec<T>> point{zero, zero, e.normal}, small{s * e.a, s * e.b, e.normal};
            CHECK(largest_difference(covariance(add_disk(small, radius)), covariance(add_disk(point, radius))) <=
                  tolerance);
            const Ellipse<Vec<T>> needle{e.a, zero, e.normal}, nearly{e.a, s * e.b, e.normal};
            CHECK(largest_difference(covariance(add_disk(nearly, radius)), covariance(add_disk(needle, radius))) <=
                  tolerance);
            const Ellipse<Vec<T>> turned{zero, e.b, e.normal}, nearly_turned{s * e.a, e.b, e.normal};
            CHECK(largest_difference(covariance(add_disk(nearly_turned, radius)),
                                     covariance(add_disk(turned, radius))) <= tolerance);
        }
    }
}

TEST_CASE_TEMPLATE("footprint: any number of tangents adds up to the ellipse of their covariances", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(11);
        for (int i = 0; i < 50; ++i) {
            const auto uv = ellipse_in<V>(draw, 1, draw.in(0, 1), draw.in(0, 3.1));
            const Space n = tests::widen(uv.normal);
            const auto in_plane = [&](double size) {
                return tests::narrow<V>(Wide(size) * draw.direction().across(n));
            };
            const V third = in_plane(draw.in(0, 2)), fourth = in_plane(draw.in(0, 2));
            const std::array<V, 2> two{uv.a, uv.b};
            const std::array<V, 3> three{uv.a, uv.b, third};
            const std::array<V, 4> four{uv.a, uv.b, third, fourth};
            // A quarter: semi-axes are half the displacements. 32 roundings of the sum of squares, at most 1 + 1 + 4 +
            // 4.
            Matrix expected{};
            const auto add = [&](const V& d) { add_outer(expected, tests::widen(d), 0.25); };
            add(uv.a), add(uv.b);
            CHECK(largest_difference(covariance(footprint(two, uv.normal)), expected) <= 32 * epsilon<T>);
            CHECK(tests::distance(footprint(two, uv.normal).a, Wide(0.5) * tests::widen(uv.a)) == 0);
            add(third);
            CHECK(largest_difference(covariance(footprint(three, uv.normal)), expected) <= 32 * 2 * epsilon<T>);
            add(fourth);
            CHECK(largest_difference(covariance(footprint(four, uv.normal)), expected) <= 32 * 3 * epsilon<T>);
        }
    });
}

TEST_CASE_TEMPLATE("footprint: a tangent that is not finite makes the footprint not finite", T, float, double) {
    for (const T bad : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()})
        for (std::size_t which = 0; which < 3; ++which) {
            std::array<Vec<T>, 3> tangents{Vec<T>{1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
            tangents[which].y = bad;
            const auto e = footprint(tangents, Vec<T>{0, 0, 1});
            CHECK(!(all_finite(e.a) && all_finite(e.b)));
        }
}

// A tangent of a scene where nothing moves is zero: it must not cost the others their digits.
TEST_CASE_TEMPLATE("footprint: a third tangent of zero leaves even a needle as it was", T, float, double) {
    Draws draw(12);
    const double ratio = std::is_same_v<T, float> ? 1e-3 : 1e-6;
    for (int i = 0; i < 50; ++i) {
        const auto e = ellipse_in<Vec<T>>(draw, 1, ratio, std::numbers::pi / 2);
        const Vec<T> zero{0, 0, 0};
        const auto two = radii(footprint(e.a, e.b, e.normal));
        for (const auto& order : {std::array{e.a, e.b, zero}, {zero, e.b, e.a}, {e.b, zero, e.a}}) {
            const auto three = radii(footprint(order, e.normal));
            CHECK(std::abs(double(three.major - two.major)) <= 16 * epsilon<T> * double(two.major));
            CHECK(std::abs(double(three.minor - two.minor)) <= 64 * epsilon<T> * double(two.minor));
        }
        CHECK(radii(footprint(std::array{zero, zero, zero}, e.normal)).major == 0);
        const auto line = radii(footprint(std::array{e.a, zero, e.a}, e.normal));
        CHECK(std::abs(double(line.major) - std::sqrt(0.5) * double(length(e.a))) <= 16 * epsilon<T>);
        CHECK(double(line.minor) <= 8 * epsilon<T>); // what was rounded out of the plane
    }
}

} // namespace nephroid::tests::ellipse_test
