// SPDX-License-Identifier: MIT
#include "nephroid/differential/finite_difference_curvature.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/frame.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <vector>

namespace nephroid::tests::finite_difference_curvature_test {

using tests::Draws;

namespace {

template <class T>
double epsilon() {
    return double(std::numeric_limits<T>::epsilon());
}

/// What many renderers know of a hit.
template <class V>
struct BareHit {
    scalar_t<V> distance;
    V position;
    V geometric_normal;
    std::size_t surface = 0;
};

/// A surface f(p) = 0 that a ray meets as plain code finds it: Newton's method along the ray, all in the scalar of V.
template <class V, class Field>
struct ImplicitSurface {
    using T = scalar_t<V>;
    Field field; ///< value and gradient at a point

    [[nodiscard]] std::optional<BareHit<V>> intersect(const V& o, const V& d, T t_min, T t_max) const {
        T t = T(0.5) * (t_min + t_max);
        for (int i = 0; i < 12; ++i) {
            const auto [value, gradient] = field(V(o + t * d));
            t = t - value / dot(gradient, d);
        }
        if (!(t > t_min && t < t_max))
            return std::nullopt;
        const V p = o + t * d;
        return BareHit<V>{t, p, normalize(field(p).second)};
    }
};

template <class V>
struct SphereField {
    V centre;
    std::pair<scalar_t<V>, V> operator()(const V& p) const {
        const V off = p - centre;
        return {length(off) - scalar_t<V>(1), off};
    }
};

/// Ring of radius 2 about the y axis through `centre`, tube of radius 1/2.
template <class V>
struct TorusField {
    V centre;
    std::pair<scalar_t<V>, V> operator()(const V& p) const {
        using t = vector_traits<V>;
        using T = scalar_t<V>;
        const V q = p - centre;
        const T x = t::x(q), y = t::y(q), z = t::z(q), rho = sqrt(x * x + z * z), off = (rho - T(2)) / rho;
        const V to_ring = make_vector<V>(off * x, y, off * z);
        return {length(to_ring) - T(0.5), to_ring};
    }
};

/// z = 0.04 sin(2 pi (2 x + y)), the water of the built-in cases.
template <class V>
struct WaveField {
    V centre;
    std::pair<scalar_t<V>, V> operator()(const V& p) const {
        using t = vector_traits<V>;
        using T = scalar_t<V>;
        const V q = p - centre;
        const T k = T(2) * pi<T>, phase = k * (T(2) * t::x(q) + t::y(q)), slope = T(0.04) * k * cos(phase);
        return {t::z(q) - T(0.04) * sin(phase), make_vector<V>(T(-2) * slope, -slope, T(1))};
    }
};

/// A point of a surface, two orthogonal tangent directions, and how the normal turns along each: closed forms.
struct Known {
    tests::Space offset, normal;
    std::array<tests::Space, 2> along, turn;
    double largest; ///< curvature anywhere on the surface
};

Known on_sphere(Draws& draw) {
    const tests::Space n = draw.direction(), e = n.cross(draw.direction()).unit(), f = n.cross(e);
    return {n, n, {e, f}, {e, f}, 1};
}

// At the angle a about the axis and b about the tube: curvature 2 about the tube, cos b / (2 + cos(b) / 2) about the
// axis.
Known on_torus(Draws& draw) {
    const double a = draw.in(0, 6.28), b = draw.in(0, 6.28), rho = 2 + 0.5 * std::cos(b);
    const tests::Space out{std::cos(a), 0, std::sin(a)}, round{-std::sin(a), 0, std::cos(a)}, up{0, 1, 0};
    const tests::Space n = tests::Wide(std::cos(b)) * out + tests::Wide(std::sin(b)) * up;
    const tests::Space e = tests::Wide(-std::sin(b)) * out + tests::Wide(std::cos(b)) * up;
    return {tests::Wide(2) * out + tests::Wide(0.5) * n,
            n,
            {round, e},
            {tests::Wide(std::cos(b) / rho) * round, tests::Wide(2) * e},
            2};
}

// Along the gradient g the profile is z = A sin(c s), of curvature A c² sin / (1 + z'²)^(3/2); across it is straight.
Known on_wave(Draws& draw) {
    const double x = draw.in(-1, 1), y = draw.in(-1, 1), c = 2 * pi<double> * std::sqrt(5.0);
    const double phase = 2 * pi<double> * (2 * x + y), slope = 0.04 * c * std::cos(phase);
    const double steep = std::sqrt(1 + slope * slope), k = 0.04 * c * c * std::sin(phase) / (steep * steep * steep);
    const tests::Space g = tests::Space{2, 1, 0}.unit(), across{-g.y, g.x, 0};
    const tests::Space e = tests::Wide(1 / steep) * (g + tests::Space{0, 0, slope});
    const tests::Space n = tests::Wide(1 / steep) * (tests::Space{0, 0, 1} - tests::Wide(slope) * g);
    return {{x, y, 0.04 * std::sin(phase)}, n, {e, across}, {tests::Wide(k) * e, {0, 0, 0}}, 0.04 * c * c};
}

/// How far the scale is off, and the position from the origin.
struct Setting {
    double scale_factor = 1;
    double far = 0;
};

/// The distances h of the two rays, in units of the least radius of curvature: the header's formula.
template <class T>
double relative_step(const Known& at, const Setting& setting) {
    const double scale = setting.scale_factor / at.largest;
    return std::cbrt(epsilon<T>() * scale * scale * (scale + setting.far + 3)) * at.largest;
}

struct Errors {
    double median, largest;
    double over_bound;       ///< the largest error over its bound
    double median_over_eta2; ///< what the header says that the error is about
};

// With R = 1/largest, η = h/R: the normal as a function of a shift in the tangent plane is analytic in a disk of
// radius R/2 about the hit and there below 2, so by Cauchy's estimate the third-order term of a central difference is
// at most 2 h²/(R/2)³, times 4/3 for the rest of the series: 22 η² of 1/R. A normal is off by 8 roundings of itself
// and of |p|/R (the hit, the shift from the centre, the normal), so their difference over 2h by 8 ε (1 + |p|/R) / η.
// With the scale a factor too large the rays keep their distance where the normal turns slowly, and elsewhere move
// closer until it does so as on a scale of R/4 and more: the first term has the largest η, the second the smallest.
template <class V, template <class> class Field>
Errors errors_on(Known (*draw_point)(Draws&), const Setting& setting) {
    using T = scalar_t<V>;
    Draws draw(91);
    const tests::Space centre{setting.far, -setting.far / 3, setting.far / 2};
    const ImplicitSurface<V, Field<V>> surface{{tests::narrow<V>(centre)}};
    std::vector<double> errors;
    double over_bound = 0, eta2 = 0;
    for (int i = 0; i < 400; ++i) {
        const Known at = draw_point(draw);
        const V p = tests::narrow<V>(centre + at.offset), n = tests::narrow<V>(at.normal);
        const BareHit<V> hit{T(1), p, n};
        const auto curvature = finite_difference_curvature(surface, hit, T(setting.scale_factor / at.largest));
        for (std::size_t j = 0; j < 2; ++j) {
            const V dn = curvature(tests::narrow<V>(tests::Wide(3) * at.along[j]));
            const double error = tests::distance(dn, tests::Wide(3) * at.turn[j]) / (3 * at.largest);
            const double coarse = relative_step<T>(at, setting);
            const double fine = (std::min)(coarse, relative_step<T>(at, {0.25, setting.far}));
            const double bound = 22 * coarse * coarse + 8 * epsilon<T>() * (1 + (setting.far + 3) * at.largest) / fine;
            eta2 = coarse * coarse;
            over_bound = (std::max)(over_bound, error / bound);
            errors.push_back(error);
        }
    }
    std::sort(errors.begin(), errors.end());
    const double median = errors[errors.size() / 2];
    return {median, errors.back(), over_bound, median / eta2};
}

template <class T>
void check_surfaces(const char* scalar) {
    using V = glm::vec<3, T>;
    const std::array<std::pair<const char*, Setting>, 6> settings = {{{"the right scale", {}},
                                                                      {"scale 8 times too large", {8, 0}},
                                                                      {"scale 1000 times too large", {1000, 0}},
                                                                      {"scale 8 times too small", {0.125, 0}},
                                                                      {"1000 from the origin", {1, 1000}},
                                                                      {"1000000 from the origin", {1, 1e6}}}};
    for (const auto& [name, setting] : settings) {
        if (setting.scale_factor * std::cbrt(epsilon<T>() * (1 + setting.far)) > 0.1)
            continue; // more than the header allows, or too far for the scalar
        const std::array<Errors, 3> errors = {errors_on<V, SphereField>(on_sphere, setting),
                                              errors_on<V, TorusField>(on_torus, setting),
                                              errors_on<V, WaveField>(on_wave, setting)};
        std::printf("%-6s %-28s", scalar, name);
        for (const Errors& e : errors) {
            std::printf("  %8.1e %8.1e", e.median, e.largest);
            CHECK(e.over_bound <= 1);
            if (setting.scale_factor == 1)
                CHECK(e.median_over_eta2 <= 1);
        }
        std::printf("\n");
    }
}

} // namespace

TEST_CASE("finite_difference_curvature: is as wrong as its formula says on a sphere a torus and a wave") {
    std::printf("error of dn, relative to the largest curvature: median and largest\n%-35s  %17s  %17s  %17s\n", "",
                "sphere", "torus", "wave");
    check_surfaces<float>("float");
    check_surfaces<double>("double");
}

TEST_CASE_TEMPLATE("finite_difference_curvature: takes any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() { CHECK(errors_on<V, SphereField>(on_sphere, {}).over_bound <= 1); });
}

namespace {

using V = glm::dvec3;

/// Rectangles, each a plane with its own normal; the nearest one is hit, from either side.
struct Rectangles {
    struct Rectangle {
        V corner, u, v;
        std::size_t surface = 0;
    };
    std::vector<Rectangle> rectangles;
    bool faces_ray = false;

    [[nodiscard]] std::optional<BareHit<V>> intersect(const V& o, const V& d, double t_min, double t_max) const {
        std::optional<BareHit<V>> nearest;
        for (const Rectangle& r : rectangles) {
            V n = normalize(cross(r.u, r.v));
            const double t = dot(n, V(r.corner - o)) / dot(n, d);
            const V p = o + t * d, q = p - r.corner;
            const double a = dot(q, r.u) / dot(r.u, r.u), b = dot(q, r.v) / dot(r.v, r.v);
            if (!(t > t_min && t < t_max && a >= 0 && a <= 1 && b >= 0 && b <= 1))
                continue;
            if (faces_ray && dot(n, d) > 0)
                n = -n;
            t_max = t;
            nearest = {t, p, n, r.surface};
        }
        return nearest;
    }
};

} // namespace

TEST_CASE("finite_difference_curvature: is zero on a plane up to its rim and up to a crease") {
    // An L of two unit squares: the floor and, at x = 1, a wall.
    const Rectangles walls{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
    for (const double x : {0.5, 1e-4, 1e-7, 1 - 1e-4, 1 - 1e-7}) {
        CAPTURE(x);
        const BareHit<V> hit{1, {x, 0.5, 0}, {0, 0, 1}};
        const auto curvature = finite_difference_curvature(walls, hit, 1.0);
        CHECK(length(curvature(V{2, 0, 0})) == 0);
        CHECK(length(curvature(V{0, -3, 0})) == 0);
        CHECK(length(curvature(V{0, 0, 0})) == 0);
    }
}

// Central differences across the ridge would turn the normal by 45 degrees within the rays' distance.
TEST_CASE("finite_difference_curvature: is zero on both sides of a ridge up to the ridge") {
    const Rectangles roof{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{1, 0, 0}, {1, 0, -1}, {0, 1, 0}}}};
    for (const double x : {1e-3, 1e-6, 1e-9}) {
        CAPTURE(x);
        const BareHit<V> left{1, {1 - x, 0.5, 0}, {0, 0, 1}}, right{1, {1 + x, 0.5, -x}, normalize(V{1, 0, 1})};
        CHECK(length(finite_difference_curvature(roof, left, 1.0)(V{1, 0, 0})) == 0);
        CHECK(length(finite_difference_curvature(roof, right, 1.0)(V{1, 0, -1})) == 0);
    }
}

TEST_CASE("finite_difference_curvature: asks only the hit's own surface") {
    // A roof of another surface just above the floor's right half: rays that start above it find it first.
    const Rectangles floor{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 7}, {{0.5, 0, 1e-7}, {0.5, 0, 0.1}, {0, 1, 0}, 8}}};
    const auto change = [&](std::size_t surface) {
        const BareHit<V> hit{1, {0.5 - 1e-7, 0.5, 0}, {0, 0, 1}, surface};
        return length(finite_difference_curvature(floor, hit, 1.0)(V{1, 0, 0}));
    };
    CHECK(change(7) == 0);
    CHECK(std::isnan(change(9))); // no such surface anywhere: nothing is known, and nothing is made up
}

TEST_CASE("finite_difference_curvature: does not mind normals that are turned to the ray") {
    // Seen from below, a tracer that turns normals gives the floor's as (0, 0, -1), from both sides of it.
    for (const bool faces_ray : {false, true}) {
        Rectangles floor{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, faces_ray};
        const BareHit<V> hit{1, {0.5, 0.5, 0}, {0, 0, -1}};
        CHECK(length(finite_difference_curvature(floor, hit, 1.0)(V{1, 1, 0})) == 0);
    }
}

TEST_CASE("finite_difference_curvature: without a tracer or a scale says that it knows nothing") {
    const ImplicitSurface<V, SphereField<V>> sphere{{V{0, 0, 0}}};
    const BareHit<V> hit{1, {0, 0, 1}, {0, 0, 1}};
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    const FiniteDifferenceCurvature<V, ImplicitSurface<V, SphereField<V>>> unset;
    CHECK(std::isnan(unset(V{1, 0, 0}).x));
    for (const double scale : {0.0, -1.0, nan, infinity})
        CHECK(std::isnan(finite_difference_curvature(sphere, hit, scale)(V{1, 0, 0}).x));
    CHECK(std::isnan(finite_difference_curvature(sphere, hit, 1.0)(V{nan, 0, 0}).x));
    const BareHit<V> nowhere{1, {0, 0, 5}, {0, 0, 1}};
    CHECK(std::isnan(finite_difference_curvature(sphere, nowhere, 1.0)(V{1, 0, 0}).x));
}

TEST_CASE("finite_difference_curvature: keeps tangents of any length in range") {
    const ImplicitSurface<V, SphereField<V>> sphere{{V{0, 0, 0}}};
    const auto curvature = finite_difference_curvature(sphere, BareHit<V>{1, {0, 0, 1}, {0, 0, 1}}, 1.0);
    for (const double size : {1e-200, 1e-3, 1e73})
        CHECK(std::abs(curvature(V{size, 0, 0}).x / size - 1) < 1e-9); // of η² = (4 epsilon)^(2/3)
}

namespace {

/// A shading normal that is not the geometric one: a triangle in the plane z = 0 whose corners have normals.
struct SmoothTriangle {
    struct Hit : BareHit<V> {
        V shading_normal;
    };
    std::array<V, 3> normals{V{-0.3, 0, 1}, V{0.4, 0.1, 1}, V{0, 0.5, 1}};

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        const double t = -o.z / d.z;
        const V p = o + t * d;
        if (!(t > t_min && t < t_max && p.x >= 0 && p.y >= 0 && p.x + p.y <= 1))
            return std::nullopt;
        return Hit{{t, p, {0, 0, 1}, 3},
                   normalize(V((1 - p.x - p.y) * normals[0] + p.x * normals[1] + p.y * normals[2]))};
    }
};

} // namespace

TEST_CASE("finite_difference_curvature: follows interpolated normals") {
    const SmoothTriangle triangle;
    const V a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
    const auto exact =
        interpolated_normals(a, b, c, triangle.normals[0], triangle.normals[1], triangle.normals[2], 0.3, 0.2);
    const auto hit = triangle.intersect({0.3, 0.2, 1}, {0, 0, -1}, 0, 2);
    const auto found = finite_difference_curvature(triangle, *hit, 1.0);
    for (const V& dx : {V{1, 0, 0}, V{0, 1, 0}, V{-0.6, 0.8, 0}})
        CHECK(length(V(found(dx) - exact(dx))) < 22 * 4 * std::pow(epsilon<double>(), 2.0 / 3)); // as above, R = 1/2
}

namespace {

/// A glass ball above a floor.
struct BallScene {
    using Hit = SurfaceHit<V, ShapeOperator<V>>;

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        const double b = dot(o, d), root = b * b - dot(o, o) + 1;
        if (root > 0)
            for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)})
                if (t > t_min && t < t_max) {
                    const V n = normalize(V(o + t * d));
                    return Hit{t, n, n, n, sphere_curvature<V>(1), 1e-14, 1};
                }
        const double t = (-1.5 - o.z) / d.z;
        if (!(t > t_min && t < t_max))
            return std::nullopt;
        return Hit{t, o + t * d, {0, 0, 1}, {0, 0, 1}, sphere_curvature<V>(1e9), 1e-14, 0};
    }

    template <class H, class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const H& hit, const V& d, Sampler&) const {
        if (hit.surface == 0)
            return Scattering<double, double>::deposit();
        return Scattering<double, double>::refract(1, dot(d, hit.geometric_normal) < 0 ? 1 / 1.5 : 1.5);
    }
};

/// The same, with its curvature unknown: it refers to itself, as an adapter does.
struct Tracing {
    using Hit = SurfaceHit<V, FiniteDifferenceCurvature<V, Tracing>>;
    BallScene ball;

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        const auto found = ball.intersect(o, d, t_min, t_max);
        if (!found)
            return std::nullopt;
        Hit hit{found->distance, found->position, found->geometric_normal, found->shading_normal, {},
                1e-14,           found->surface};
        hit.curvature = finite_difference_curvature(*this, hit, 1.0);
        return hit;
    }

    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const Hit& hit, const V& d, Sampler& sampler) const {
        return ball.scatter(hit, d, sampler);
    }
};

struct NoNumbers {
    template <class T>
    T next() {
        return T(0.5);
    }
};

} // namespace

// dn's errors of 22 η² and 8 ε/η, η³ = 4 ε, are 1e-9; two refractions and the flight to the floor magnify them
// by less than 20, as dω = (1 − 1/1.5) dn and dω = (1.5 − 1) dn at normal incidence, times 2 of flight and 3 at
// 60 degrees.
TEST_CASE("finite_difference_curvature: gives a walk through glass the tangents that the exact curvature gives") {
    const BallScene known;
    const Tracing traced{known};
    NoNumbers numbers;
    Statistics account;
    for (const double x : {0.0, 0.1, 0.4, 0.8}) {
        const V zero{0, 0, 0};
        const Photon<V, double> photon{
            {x, 0.05, 4}, {0, 0, -1}, 1, {Tangent<V>{{1, 0, 0}, zero}, Tangent<V>{{0, 1, 0}, zero}}};
        const auto exact = walk(known, photon, numbers, {}, account),
                   found = walk(traced, photon, numbers, {}, account);
        REQUIRE(exact);
        REQUIRE(found);
        for (std::size_t i = 0; i < 2; ++i)
            CHECK(length(V(found->d_position[i] - exact->d_position[i])) < 20 * 1e-9);
    }
    CHECK(account[Fate::invalid].photons == 0);
}

static_assert(Curvature<FiniteDifferenceCurvature<V, Tracing>, V>);
static_assert(RayTracer<Tracing, V>);
static_assert(!LiesOnSurface<int> && LiesOnSurface<BareHit<V>>);

} // namespace nephroid::tests::finite_difference_curvature_test
