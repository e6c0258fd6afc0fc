// SPDX-License-Identifier: MIT
/// @file  Footprints from 1e-20 to 1e20 in area with axis ratios to 1e12, against wide precision: radii, area, filter
///        matrix, box, and what is splatted of them. Needle triangles.
#include "support/space.hpp"

#include "nephroid/differential/curvature.hpp"
#include "nephroid/footprint/ellipse.hpp"
#include "nephroid/footprint/policies.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

namespace nephroid::tests::footprint_range_test {

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
constexpr double epsilon = double(std::numeric_limits<T>::epsilon());

double log_uniform(Draws& draws, double low, double high) { return std::exp(draws.in(std::log(low), std::log(high))); }

/// An ellipse rounded to T, and its exact covariance in the plane that a and b span.
template <class T>
struct Case {
    Ellipse<Vec<T>> ellipse;
    Space a, b;
    double major, minor, area_scale, skew; ///< |a| |b| over the area: what the rounding of a and b costs
};

template <class T>
Case<T> random_ellipse(Draws& draws) {
    const Space n = draws.direction(), u = n.cross(draws.direction()).unit(), v = n.cross(u);
    const double area = log_uniform(draws, 1e-20, 1e20), ratio = log_uniform(draws, 1, 1e12), turn = draws.in(0, 6.28);
    const Wide major = std::sqrt(area * ratio), minor = std::sqrt(area / ratio);
    // [a b] = [major u, minor v] times a rotation: fully skewed, or not at all.
    const Wide c = std::cos(turn), s = std::sin(turn);
    const Space x = major * u, y = minor * v;
    Case<T> result;
    result.ellipse = {narrow<Vec<T>>(c * x + s * y), narrow<Vec<T>>(c * y - s * x), narrow<Vec<T>>(n)};
    result.a = widen(result.ellipse.a);
    result.b = widen(result.ellipse.b);
    const Space face = result.a.cross(result.b);
    const double aa = magnitude(result.a), bb = magnitude(result.b);
    const Wide sum = result.a.dot(result.a) + result.b.dot(result.b);
    const Wide under = sum * sum - Wide(4) * face.dot(face);
    result.area_scale = magnitude(face);
    const Wide major2 = Wide(0.5) * (sum + sqrt(under < Wide(0) ? Wide(0) : under));
    result.major = static_cast<double>(sqrt(major2));
    result.minor = result.area_scale / result.major;
    result.skew = result.area_scale > 0 ? aa * bb / result.area_scale : std::numeric_limits<double>::infinity();
    return result;
}

constexpr int count = 5000;

} // namespace

// The normal is rounded: it is off by a few epsilon, and with it what |a × b| has along it, not at all to first order
// where a and b lie across it; they do to a rounding of the longer one, which is what skew stands for.
TEST_CASE_TEMPLATE("footprint range: area and radii hold from 1e-20 to 1e20 and to needles", T, float, double) {
    Draws draws(21);
    for (int i = 0; i < count; ++i) {
        const Case<T> c = random_ellipse<T>(draws);
        CAPTURE(c.major);
        CAPTURE(c.minor);
        const auto sigma = radii(c.ellipse);
        CHECK(std::isfinite(double(sigma.major)));
        CHECK(std::abs(double(sigma.major) - c.major) <= 16 * epsilon<T> * c.major);
        const double rounding = 16 * epsilon<T> * c.area_scale * c.skew;
        CHECK(std::abs(double(area(c.ellipse)) / pi<double> - c.area_scale) <= rounding);
        CHECK(std::abs(double(sigma.minor) - c.minor) <= rounding / c.major + 16 * epsilon<T> * c.minor);
        CHECK(sigma.minor <= sigma.major);
        CHECK(axis_ratio(c.ellipse) >= T(0));
        CHECK(axis_ratio(c.ellipse) <= T(1));
    }
}

// M [a b] is the identity: its entries are triple products over the determinant. With u = epsilon / 2, a cross product
// is off by 2 √2 u |a| |b| at most and the determinant by that and 3 u |a| |b|: 11 u skew together, with a few u for
// the scaling.
TEST_CASE_TEMPLATE("footprint range: the filter matrix times the footprint is the identity", T, float, double) {
    Draws draws(22);
    int tried = 0;
    for (int i = 0; i < count; ++i) {
        const Case<T> c = random_ellipse<T>(draws);
        if (!(c.skew < 1 / (64 * epsilon<T>))) // collapsed to rounding
            continue;
        const auto m = filter_matrix(c.ellipse);
        if (!all_finite(m.row_a) || !all_finite(m.row_b)) {
            // Only where an entry, up to one over the minor radius, leaves the type's range: a splat then is
            // `collapsed`.
            CHECK(c.minor < 64 * double((std::numeric_limits<T>::min)()));
            continue;
        }
        ++tried;
        const Space row_a = widen(m.row_a), row_b = widen(m.row_b);
        // The error of a point of the outline is the rounding of the rows times the longer axis.
        const double tolerance = 8 * epsilon<T> * c.skew;
        CHECK(std::abs(static_cast<double>(row_a.dot(c.a)) - 1) <= tolerance);
        CHECK(std::abs(static_cast<double>(row_b.dot(c.b)) - 1) <= tolerance);
        const double ratio = magnitude(c.b) / magnitude(c.a);
        CHECK(std::abs(static_cast<double>(row_a.dot(c.b))) <= tolerance * ratio);
        CHECK(std::abs(static_cast<double>(row_b.dot(c.a))) <= tolerance / ratio);
    }
    CHECK(tried > count / 4);
}

TEST_CASE_TEMPLATE("footprint range: no point of the outline is outside of the box and each side is touched", T, float,
                   double) {
    Draws draws(23);
    for (int i = 0; i < count / 10; ++i) {
        const Case<T> c = random_ellipse<T>(draws);
        const Vec<T> half = half_extents(c.ellipse);
        Space most{};
        for (int k = 0; k < 256; ++k) {
            const double phi = 2 * pi<double> * k / 256;
            const Space p = Wide(std::cos(phi)) * c.a + Wide(std::sin(phi)) * c.b;
            most = {abs(p.x) > most.x ? abs(p.x) : most.x, abs(p.y) > most.y ? abs(p.y) : most.y,
                    abs(p.z) > most.z ? abs(p.z) : most.z};
        }
        const auto check_side = [&](T side, const Wide& reached) {
            const double r = static_cast<double>(reached);
            CHECK(double(side) >= r * (1 - 8 * epsilon<T>));
            CHECK(double(side) <= r / std::cos(pi<double> / 256) * (1 + 8 * epsilon<T>)); // between two of the points
        };
        check_side(half.x, most.x);
        check_side(half.y, most.y);
        check_side(half.z, most.z);
    }
}

// The disk in quadrature, in range and out of proportion: the area that is filtered is what the covariance says.
TEST_CASE_TEMPLATE("footprint range: the pixel filter's area is the covariance's", T, float, double) {
    Draws draws(24);
    for (int i = 0; i < count; ++i) {
        const Case<T> c = random_ellipse<T>(draws);
        const double radius = log_uniform(draws, 1e-6, 1e6) * std::sqrt(c.area_scale > 0 ? c.area_scale : c.major);
        const T r = T(radius);
        const auto filtered = add_disk(c.ellipse, r);
        const double rr = double(r) * double(r),
                     longest2 = magnitude(c.a) * magnitude(c.a) + magnitude(c.b) * magnitude(c.b);
        // det(A Aᵀ + r² I) = det² + r² |A|² + r⁴: nothing cancels but in the determinant itself.
        const double exact = std::sqrt(c.area_scale * c.area_scale + rr * longest2 + rr * rr);
        CHECK(std::abs(double(area_scale(filtered)) - exact) <= 64 * epsilon<T> * (exact + c.area_scale * c.skew));
        CHECK(double(radii(filtered).major) >= c.major * (1 - 64 * epsilon<T>));
    }
}

TEST_CASE_TEMPLATE("footprint range: a footprint beyond any scene is bounded to finite numbers", T, float, double) {
    Draws draws(25);
    int bounded = 0;
    for (int i = 0; i < count; ++i) {
        Case<T> c = random_ellipse<T>(draws);
        const T diagonal = T(log_uniform(draws, 1e-3, 1e3));
        const Verdict verdict = BoundMajorRadius{}(c.ellipse, diagonal);
        if (std::abs(c.major / double(diagonal) - 1) > 64 * epsilon<T>)
            CHECK((verdict == Verdict::bounded) == (c.major > double(diagonal)));
        CHECK(all_finite(c.ellipse.a));
        CHECK(all_finite(c.ellipse.b));
        if (verdict == Verdict::bounded) {
            ++bounded;
            // The part that was subtracted leaves its rounding.
            CHECK(double(radii(c.ellipse).major) <= double(diagonal) + 64 * epsilon<T> * (double(diagonal) + c.major));
        }
    }
    CHECK(bounded > count / 4);
}

// A triangle as thin as a millionth of its length, anywhere: the change of its normal, against differences of the
// normal interpolated in wide precision. Along the needle nothing is lost; across it the gradient is as large as it is
// thin.
TEST_CASE_TEMPLATE("needle triangles: the normal changes as its interpolation does", T, float, double) {
    Draws draws(26);
    for (int i = 0; i < 400; ++i) {
        const double thin = log_uniform(draws, 1e-6, 1), size = log_uniform(draws, 1e-4, 1e4);
        const Space n = draws.direction(), u = n.cross(draws.direction()).unit(), v = n.cross(u);
        const auto at = [&](double x, double y) {
            return narrow<Vec<T>>(Wide(size * x) * u + Wide(size * thin * y) * v);
        };
        const std::array<Vec<T>, 3> p{at(0, 0), at(1, draws.in(-1, 1)), at(draws.in(0, 1), draws.in(1, 2))};
        std::array<Vec<T>, 3> normals;
        for (Vec<T>& normal : normals)
            normal = narrow<Vec<T>>(n + Wide(0.3) * draws.direction());
        const T b1 = T(draws.in(0.1, 0.4)), b2 = T(draws.in(0.1, 0.4));
        const auto curvature = interpolated_normals(p[0], p[1], p[2], normals[0], normals[1], normals[2], b1, b2);

        const std::array<Space, 3> corner{widen(p[0]), widen(p[1]), widen(p[2])};
        const Space e1 = corner[1] - corner[0], e2 = corner[2] - corner[0], face = e1.cross(e2);
        const double height = magnitude(face) / magnitude(e1); // the needle's own width, after rounding
        if (!(height > 256 * epsilon<T> * size))
            continue;
        const Space point = corner[0] + Wide(b1) * e1 + Wide(b2) * e2;
        for (const bool across : {false, true}) {
            const Space step = across ? (Wide(1) / Wide(magnitude(face))) * e1.cross(face) : e1;
            const Vec<T> dx = narrow<Vec<T>>(step);
            const Space exact = derivative([&](const Wide& h) {
                const auto [c1, c2] = barycentric(corner, point + (h * Wide(height / size)) * widen(dx));
                return (widen(normals[0]) + c1 * (widen(normals[1]) - widen(normals[0])) +
                        c2 * (widen(normals[2]) - widen(normals[0])))
                    .unit();
            });
            const Space scaled = Wide(size / height) * exact;
            // dx is rounded, and what of it then lies across the needle counts by one over the height.
            const double tolerance = 32 * epsilon<T> * magnitude(widen(dx)) / height * (size / height);
            CHECK(distance(curvature(dx), scaled) <= tolerance);
        }
    }
}

} // namespace nephroid::tests::footprint_range_test
