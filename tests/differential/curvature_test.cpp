// SPDX-License-Identifier: MIT
#include "nephroid/differential/curvature.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <type_traits>

namespace nephroid::tests::curvature_test {

using tests::derivative;
using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

template <class T>
double epsilon() {
    return double(std::numeric_limits<T>::epsilon());
}

static_assert(Curvature<Flat, glm::vec3> && Curvature<Flat, foreign::Plain<double>>);
static_assert(Curvature<ShapeOperator<glm::dvec3>, glm::dvec3> &&
              !Curvature<ShapeOperator<foreign::Plain<double>>, foreign::Plain<float>>);
static_assert(Curvature<ParametricCurvature<glm::vec3>, glm::vec3> &&
              Curvature<InterpolatedCurvature<glm::vec3>, glm::vec3>);
static_assert(Curvature<AnyCurvature<Flat, ShapeOperator<glm::vec3>>, glm::vec3>);
static_assert(!Curvature<int, glm::vec3> && !Curvature<Flat, int> && !Curvature<std::string, glm::vec3> &&
              !Curvature<Flat, std::string>);

TEST_CASE_TEMPLATE("Flat: the normal of a plane never changes", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        CHECK(tests::distance(Flat{}(make_vector<V>(3, -4, 5)), Space{0, 0, 0}) == 0);
    });
}

/// Two orthogonal unit vectors across a third: a tangent plane.
struct Tangents {
    Space e1, e2;

    explicit Tangents(Draws& draw) : e1(draw.direction()) {
        do
            e2 = draw.direction();
        while (abs(e1.dot(e2)) > Wide(0.9));
        e2 = e2.across(e1).unit();
    }
};

// In halves u of epsilon: e1, e2 unit to u, each entry k1 e1 e1 + k2 e2 e2 rounds 4 times, three products and sums 4
// times: with (|k1| + |k2|) |dx| as the unit and sqrt(3) for the norm of three components, < 12 epsilon.
TEST_CASE_TEMPLATE("principal_curvatures: of a sphere turn the normal by the displacement over R", T, float, double,
                   Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(81);
        for (int i = 0; i < 50; ++i) {
            const Tangents at(draw);
            const T k = T(1) / T(draw.in(0.1, 10));
            const auto sphere = principal_curvatures(tests::narrow<V>(at.e1), k, tests::narrow<V>(at.e2), k);
            const V dx = tests::narrow<V>(Wide(draw.in(-1, 1)) * at.e1 + Wide(draw.in(-1, 1)) * at.e2);
            const Space expected = Wide(k) * tests::widen(dx);
            CHECK(tests::distance(sphere(dx), expected) <= 12 * epsilon<T>() * 2 * tests::magnitude(expected));
        }
    });
}

TEST_CASE_TEMPLATE("principal_curvatures: of a cylinder turn the normal only round the axis", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(82);
        for (int i = 0; i < 50; ++i) {
            const Tangents at(draw); // e1 round, e2 along the axis
            const T k = T(-3);       // the inner side
            const auto cylinder = principal_curvatures(tests::narrow<V>(at.e1), k, tests::narrow<V>(at.e2), T(0));
            const Wide round = draw.in(-1, 1), along = draw.in(-1, 1);
            const double size = std::hypot(double(round), double(along));
            CHECK(tests::distance(cylinder(tests::narrow<V>(round * at.e1 + along * at.e2)),
                                  Wide(-3) * round * at.e1) <= 12 * epsilon<T>() * 3 * size);
        }
    });
}

TEST_CASE_TEMPLATE("ShapeOperator: is a matrix by columns", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const ShapeOperator<V> matrix{make_vector<V>(1, 2, 3), make_vector<V>(4, 5, 6), make_vector<V>(7, 8, 9)};
        CHECK(tests::distance(matrix(make_vector<V>(1, 10, 100)), Space{741, 852, 963}) == 0);
    });
}

// In halves u of epsilon: a cross product's components 4 u, the dot product of two 8 + 3 u, |dpdu × dpdv|² as much,
// quotient, product and sum 3 u: 25 u of a and b, which are at most q |dx| / |dpd.| with q = |dpdu| |dpdv| / |dpdu ×
// dpdv| >= 1 (how skewed the coordinates are). A scalar without exact differences of products has u |dpdu| |dpdv|
// there: q² more.
template <class V>
double parametric_bound(const Space& dpdu, const Space& dpdv, const Space& dndu, const Space& dndv, const Space& dx) {
    const double u = tests::magnitude(dpdu), v = tests::magnitude(dpdv), q = u * v / tests::magnitude(dpdu.cross(dpdv));
    const double skew = std::is_floating_point_v<scalar_t<V>> ? q : q * q * q;
    return 13 * epsilon<scalar_t<V>>() * skew * tests::magnitude(dx) *
           (tests::magnitude(dndu) / u + tests::magnitude(dndv) / v);
}

// p = R (sin θ cos φ, sin θ sin φ, cos θ) with u, v any mixture of θ and φ; the normal is p/R whatever the
// coordinates are.
TEST_CASE_TEMPLATE("ParametricCurvature: of a sphere turns the normal by the displacement over R in any coordinates", T,
                   float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(83);
        const Wide radius = 2.5;
        for (int i = 0; i < 100; ++i) {
            const Tangents at(draw);
            const auto mixed = [&] {
                return tests::narrow<V>(Wide(draw.in(-5, 5)) * at.e1 + Wide(draw.in(-5, 5)) * at.e2);
            };
            const V dpdu = mixed(), dpdv = mixed(), dx = mixed();
            const auto over_radius = [&](const V& d) { return tests::narrow<V>((Wide(1) / radius) * tests::widen(d)); };
            const Space u = tests::widen(dpdu), v = tests::widen(dpdv), x = tests::widen(dx);
            if (magnitude(u.cross(v)) < 0.2 * magnitude(u) * magnitude(v))
                continue;
            const ParametricCurvature<V> sphere{dpdu, dpdv, over_radius(dpdu), over_radius(dpdv)};
            const Space n = u.cross(v).unit(), expected = (Wide(1) / radius) * x.across(n);
            const double bound = parametric_bound<V>(u, v, (Wide(1) / radius) * u, (Wide(1) / radius) * v, x);
            CHECK(tests::distance(sphere(dx), expected) <= bound);
        }
    });
}

TEST_CASE_TEMPLATE("ParametricCurvature: of a cylinder turns the normal only round the axis", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        // p = (2 cos u, 2 sin u, v) at u = 0, outward normal (1, 0, 0).
        const ParametricCurvature<V> cylinder{make_vector<V>(0, 2, 0), make_vector<V>(0, 0, 1), make_vector<V>(0, 1, 0),
                                              zero_vector<V>()};
        CHECK(tests::distance(cylinder(make_vector<V>(0, 3, 7)), Space{0, 1.5, 0}) <= 12 * epsilon<T>() * 8);
    });
}

// Coordinates sheared until their axes are a thousandth, then ten thousandth of a radian apart; any dndu, dndv.
TEST_CASE_TEMPLATE("ParametricCurvature: keeps its digits in sheared coordinates", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(86);
        for (const double shear : {0.1, 0.01, 1e-3, 1e-4}) {
            for (int i = 0; i < 20; ++i) {
                const Tangents at(draw);
                const V dpdu = tests::narrow<V>(at.e1), dpdv = tests::narrow<V>(at.e1 + Wide(shear) * at.e2);
                const V dndu = tests::narrow<V>(draw.in_cube()), dndv = tests::narrow<V>(draw.in_cube()),
                        dx = tests::narrow<V>(draw.in_cube());
                const Space u = tests::widen(dpdu), v = tests::widen(dpdv), x = tests::widen(dx);
                const Wide uu = u.dot(u), uv = u.dot(v), vv = v.dot(v),
                           gram = uu * vv - uv * uv; // double digits: no harm
                const Space expected = ((vv * x.dot(u) - uv * x.dot(v)) / gram) * tests::widen(dndu) +
                                       ((uu * x.dot(v) - uv * x.dot(u)) / gram) * tests::widen(dndv);
                const double bound = parametric_bound<V>(u, v, tests::widen(dndu), tests::widen(dndv), x);
                CHECK(tests::distance(ParametricCurvature<V>{dpdu, dpdv, dndu, dndv}(dx), expected) <= bound);
            }
        }
    });
}

// What dx has off the tangent plane (rounding, a shading normal) is ignored: least squares.
TEST_CASE_TEMPLATE("ParametricCurvature: solves in the least-squares sense", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const ParametricCurvature<V> surface{make_vector<V>(1, 0, 0), make_vector<V>(1, 1, 0), make_vector<V>(0, 0, 1),
                                             make_vector<V>(5, 0, 0)};
        CHECK(tests::distance(surface(make_vector<V>(3, 2, 9)), Space{10, 0, 1}) == 0); // a = 1, b = 2: small integers
    });
}

TEST_CASE_TEMPLATE("ParametricCurvature: a uv map of any scale gives the same change", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        for (const int k : {-20, -7, 9, 20}) { // powers of two: no rounding
            const T s = std::ldexp(T(1), k);
            const ParametricCurvature<V> plain{make_vector<V>(3, 1, 0), make_vector<V>(1, 2, 0),
                                               make_vector<V>(1, 0, 0), make_vector<V>(0, 1, 0)};
            const ParametricCurvature<V> scaled{s * 3 == 0 ? zero_vector<V>() : make_vector<V>(3 * s, s, 0),
                                                make_vector<V>(1, 2, 0), make_vector<V>(s, 0, 0),
                                                make_vector<V>(0, 1, 0)};
            const V dx = make_vector<V>(T(0.3), T(0.7), 0);
            CHECK(tests::distance(scaled(dx), tests::widen(plain(dx))) == 0);
        }
    });
}

TEST_CASE_TEMPLATE("ParametricCurvature: with parallel derivatives only the longer is used and with none nothing", T,
                   float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        const V zero = zero_vector<V>(), x = make_vector<V>(1, 0, 0), y2 = make_vector<V>(0, 2, 0),
                y4 = make_vector<V>(0, 4, 0);
        const V dn1 = make_vector<V>(8, 0, 0), dn2 = make_vector<V>(0, 0, 16), dx = make_vector<V>(5, 3, 0);
        const auto change = [&](const V& dpdu, const V& dpdv) {
            return ParametricCurvature<V>{dpdu, dpdv, dn1, dn2}(dx);
        };
        CHECK(tests::distance(change(zero, zero), Space{0, 0, 0}) == 0);
        CHECK(tests::distance(change(x, zero), Space{40, 0, 0}) == 0);
        CHECK(tests::distance(change(zero, y2), Space{0, 0, 24}) == 0); // the pole of a sphere
        CHECK(tests::distance(change(y2, y4), Space{0, 0, 12}) == 0);
        CHECK(tests::distance(change(y4, y2), Space{6, 0, 0}) == 0);
        CHECK(tests::distance(change(y2, y2), Space{12, 0, 0}) == 0);
    });
}

// Multiples that round: the Gram determinant is nothing but rounding, and must not be divided by. The longer one alone
// turns the normal by at most |dx| |dnd.| / |dpd.|, after six roundings.
TEST_CASE_TEMPLATE("ParametricCurvature: derivatives that are parallel but for rounding do not blow up", T, float,
                   double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(85);
        for (int i = 0; i < 200; ++i) {
            const Space along = draw.direction(), dn = draw.in_cube(), dx = draw.in_cube();
            const Wide u = Wide(1) / Wide(draw.in(0.1, 9)), v = Wide(1) / Wide(draw.in(-9, -0.1));
            const ParametricCurvature<V> seam{tests::narrow<V>(u * along), tests::narrow<V>(v * along),
                                              tests::narrow<V>(dn), tests::narrow<V>(dn)};
            const double longer = (std::max)(std::abs(double(u)), std::abs(double(v)));
            CHECK(tests::magnitude(tests::widen(seam(tests::narrow<V>(dx)))) <=
                  tests::magnitude(dx) * tests::magnitude(dn) / longer * (1 + 6 * epsilon<T>()));
        }
    });
}

/// A triangle with a normal at each corner, and a hit in it, as the vector type V rounds them.
template <class V>
struct Phong {
    std::array<Space, 3> corner, normal;
    Wide b1, b2;

    explicit Phong(Draws& draw) {
        const auto rounded = [](const Space& s) { return tests::widen(tests::narrow<V>(s)); };
        do
            corner = {rounded(draw.in_cube()), rounded(draw.in_cube()), rounded(draw.in_cube())};
        while (skew() > 10);
        const Space face = (corner[1] - corner[0]).cross(corner[2] - corner[0]).unit();
        for (Space& n : normal)
            n = rounded(Wide(draw.in(0.5, 2)) * (face + Wide(0.5) * draw.direction()));
        b1 = static_cast<scalar_t<V>>(draw.in(0, 0.6)), b2 = static_cast<scalar_t<V>>(draw.in(0, 0.4));
    }
    /// |e1| |e2| / |e1 × e2|, 1 for a right angle.
    [[nodiscard]] double skew() const {
        const Space e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
        return tests::magnitude(e1) * tests::magnitude(e2) / tests::magnitude(e1.cross(e2));
    }
    [[nodiscard]] Space interpolated(const Space& point) const {
        const auto b = tests::barycentric(corner, point);
        return (Wide(1) - b[0] - b[1]) * normal[0] + b[0] * normal[1] + b[1] * normal[2];
    }
    [[nodiscard]] InterpolatedCurvature<V> curvature() const {
        const auto v = [](const Space& s) { return tests::narrow<V>(s); };
        return interpolated_normals(v(corner[0]), v(corner[1]), v(corner[2]), v(normal[0]), v(normal[1]), v(normal[2]),
                                    static_cast<scalar_t<V>>(b1), static_cast<scalar_t<V>>(b2));
    }
};

// In halves u of epsilon: the edges round by u, which turns the face by q u (q the skew, as for parameters) and
// stretches it as much; its components 2 u, the gradients 10 u + 3 q u, twice products 3 u. N rounds by 5 u max|n|, so
// a direction by 5 u r with r = max|n| / |N|, three times in the projection; that has 8 u of its own. In all (13 + 3 q
// + 15 r + 8 + 4) u < 24 q r epsilon of G = (|grad b1| |n1 − n0| + |grad b2| |n2 − n0|) |dx| / |N|. The difference:
// N vanishes no nearer than |N| / (G |N|), from which a quarter is taken.
TEST_CASE_TEMPLATE("interpolated_normals: change as differences of the normalised normal do", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(84);
        for (int i = 0; i < 100; ++i) {
            const Phong<V> triangle(draw);
            const Space e1 = triangle.corner[1] - triangle.corner[0], e2 = triangle.corner[2] - triangle.corner[0];
            const Space hit = triangle.corner[0] + triangle.b1 * e1 + triangle.b2 * e2;
            const V dx = tests::narrow<V>(Wide(draw.in(-1, 1)) * e1 + Wide(draw.in(-1, 1)) * e2);
            const Space expected =
                derivative([&](const Wide& p) { return triangle.interpolated(hit + p * tests::widen(dx)).unit(); });
            const V found = triangle.curvature()(dx);

            const double face = tests::magnitude(e1.cross(e2)), n = tests::magnitude(triangle.interpolated(hit));
            double longest = 0;
            for (const Space& corner_normal : triangle.normal)
                longest = std::max(longest, tests::magnitude(corner_normal));
            const double g = (tests::magnitude(e2) * tests::magnitude(triangle.normal[1] - triangle.normal[0]) +
                              tests::magnitude(e1) * tests::magnitude(triangle.normal[2] - triangle.normal[0])) *
                             tests::magnitude(tests::widen(dx)) / (face * n);
            CHECK(tests::distance(found, expected) <=
                  24 * triangle.skew() * (longest / n) * epsilon<T>() * g + tests::derivative_error(0.25 / g));
            CHECK(std::abs(double(tests::widen(found).dot(triangle.interpolated(hit)))) / n <=
                  24 * triangle.skew() * (longest / n) * epsilon<T>() * g); // across the normal
        }
    });
}

// On the triangle (1,0,0) (0,1,0) (0,0,1) inscribed in the unit sphere, with the sphere's normals, N is the point
// itself: dn = dx / |N| across N.
TEST_CASE_TEMPLATE("interpolated_normals: of a sphere's normals turn by the displacement over the distance", T, float,
                   double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        const V a = make_vector<V>(1, 0, 0), b = make_vector<V>(0, 1, 0), c = make_vector<V>(0, 0, 1);
        const auto curvature = interpolated_normals(a, b, c, a, b, c, T(0.25), T(0.5));
        const Space hit{0.25, 0.25, 0.5}, dx{1, -2, 1};
        const Space expected = (Wide(1) / hit.length()) * dx.across(hit.unit());
        CHECK(tests::distance(curvature(tests::narrow<V>(dx)), expected) <=
              24 * 1.16 * 1.64 * epsilon<T>() * 11); // G = 8/sqrt(3) sqrt(6)
    });
}

TEST_CASE_TEMPLATE("interpolated_normals: equal normals are a flat triangle whatever their length", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const V n = make_vector<V>(0, 3, 4);
        const auto flat = interpolated_normals(make_vector<V>(0, 0, 0), make_vector<V>(1, 0, 0),
                                               make_vector<V>(0, 1, 0), n, n, n, T(0.2), T(0.3));
        CHECK(tests::distance(flat(make_vector<V>(7, 8, 0)), Space{0, 0, 0}) == 0);
    });
}

TEST_CASE_TEMPLATE("interpolated_normals: a triangle without area and a vanishing normal change nothing", T, float,
                   double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        const V o = zero_vector<V>(), x = make_vector<V>(1, 0, 0), y = make_vector<V>(0, 1, 0),
                z = make_vector<V>(0, 0, 1);
        const V x2 = make_vector<V>(2, 0, 0), minus_z = make_vector<V>(0, 0, -1), dx = make_vector<V>(5, 7, 11);
        const auto none = [&](const InterpolatedCurvature<V>& curvature) {
            return tests::distance(curvature(dx), Space{0, 0, 0}) == 0;
        };
        CHECK(none(interpolated_normals(o, o, o, x, y, z, T(0.25), T(0.25))));      // a point
        CHECK(none(interpolated_normals(o, x, x2, x, y, z, T(0.25), T(0.25))));     // a line
        CHECK(none(interpolated_normals(o, x, y, z, minus_z, z, T(0.5), T(0.25)))); // z − z
        CHECK(none(interpolated_normals(o, x, y, o, o, o, T(0.5), T(0.25))));
        CHECK(!none(interpolated_normals(o, x, y, z, x, y, T(0.5), T(0.25)))); // and one that does
    });
}

// Powers of two: no rounding, from the smallest normal number to the largest. Below it is a triangle without area, or a
// normal without length.
TEST_CASE_TEMPLATE("interpolated_normals: a triangle and its normals may have any size", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const auto turned = [](T s, T n) {
            const auto curvature = interpolated_normals(
                make_vector<V>(0, 0, 0), make_vector<V>(s, 0, 0), make_vector<V>(s, s, 0), make_vector<V>(0, 0, n),
                make_vector<V>(n, 0, n), make_vector<V>(0, n, n), T(0.25), T(0.5));
            return curvature(make_vector<V>(T(0.5) * s, T(0.25) * s, 0));
        };
        using Limits = std::numeric_limits<T>;
        const Space expected = tests::widen(turned(1, 1));
        REQUIRE(expected.length() > Wide(0.1));
        int none = 0;
        for (int exponent = Limits::min_exponent - Limits::digits; exponent < Limits::max_exponent; ++exponent) {
            const T size = std::ldexp(T(1), exponent);
            CAPTURE(exponent);
            for (const V& found : {turned(size, 1), turned(1, size)}) {
                const bool vanishes = size < Limits::min();
                CHECK(tests::distance(found, vanishes ? Space{0, 0, 0} : expected) == 0);
                none += vanishes ? 1 : 0;
            }
        }
        CHECK(none > 0);
    });
}

TEST_CASE_TEMPLATE("AnyCurvature: calls the kind that it holds", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        using Any = AnyCurvature<Flat, ShapeOperator<V>, ParametricCurvature<V>, InterpolatedCurvature<V>>;
        static_assert(Curvature<Any, V>);
        const V x = make_vector<V>(1, 0, 0), y = make_vector<V>(0, 1, 0), z = make_vector<V>(0, 0, 1),
                dx = make_vector<V>(3, 4, 0);
        const ParametricCurvature<V> parametric{x, y, y, z};
        const InterpolatedCurvature<V> triangle =
            interpolated_normals(zero_vector<V>(), x, y, z, x, y, T(0.25), T(0.25));
        Any any = Flat{};
        CHECK(tests::distance(any(dx), Space{0, 0, 0}) == 0);
        any = ShapeOperator<V>{x, x, x};
        CHECK(tests::distance(any(dx), Space{7, 0, 0}) == 0);
        any = parametric;
        CHECK(tests::distance(any(dx), Space{0, 3, 4}) == 0);
        any = triangle;
        CHECK(tests::distance(any(dx), tests::widen(triangle(dx))) == 0);
        Any copy(any); // of one that is not const
        CHECK(copy.index() == 3);
        CHECK(tests::distance(copy(dx), tests::widen(triangle(dx))) == 0);
    });
}

} // namespace

} // namespace nephroid::tests::curvature_test
