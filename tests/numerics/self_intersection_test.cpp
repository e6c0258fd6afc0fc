// SPDX-License-Identifier: MIT
/// @file  A spawned ray starts on the side of the surface that it leaves to, by the exact equation of the surface and
///        at any scale: on the shapes of the examples, and in a tracer of its own that knows no double and no shape.
#include "common/numerics/arithmetic.hpp"

#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#if __has_include("common/scene.hpp")
#define NEPHROID_TESTS_HAVE_SHAPES
#include "common/scene.hpp"
#endif

namespace nephroid::tests::self_intersection_test {

namespace {

using namespace nephroid::examples::numerics;

template <class T>
using Vec = glm::vec<3, T>;

/// NEPHROID_TESTS_LONG=1 runs as many cases as the issue asks for: millions.
int times(int usual, int in_full) {
    const char* wanted = std::getenv("NEPHROID_TESTS_LONG");
    return wanted && *wanted == '1' ? in_full : usual;
}

/// The size of a scene, and its distance from the origin.
struct Place {
    double size, distance;
};
template <class T>
inline constexpr std::array places{Place{1, 0},    Place{1e-4, 0}, Place{1e4, 0},  Place{1e-4, 1},
                                   Place{30, 1e4}, Place{30, 1e5}, Place{30, 1e6}, Place{1, 1e3}};

Point<double> direction(Draws& draws) {
    const Space d = draws.direction();
    return {as_double(d.x), as_double(d.y), as_double(d.z)};
}

/// A unit direction to the side of n: any one, or one within a millionth to a hundredth of the tangent plane.
Point<double> leaving(Draws& draws, const Point<double>& n) {
    const Point<double> d = direction(draws), across = d.across(n).unit();
    const double rise = draws.in(0, 1) < 0.5 ? std::abs(d.dot(n)) : std::exp(draws.in(std::log(1e-6), std::log(1e-2)));
    return std::sqrt(1 - rise * rise) * across + rise * n;
}

template <class T>
Vec<T> narrow(const Point<double>& p) {
    return Vec<T>(T(p.x), T(p.y), T(p.z));
}
template <class T>
Point<double> widen(const Vec<T>& v) {
    return {double(v.x), double(v.y), double(v.z)};
}

/// A ray to a point of a surface with the normal n there: from anywhere on one side, often at a grazing angle.
template <class T>
struct Shot {
    Vec<T> origin, direction;
};
template <class T>
Shot<T> shot_at(Draws& draws, const Point<double>& p, const Point<double>& n, double size) {
    const Point<double> from = leaving(draws, draws.in(0, 1) < 0.5 ? n : -n);
    const Vec<T> origin = narrow<T>(p + size * draws.in(0.01, 1.5) * from);
    return {origin, narrow<T>((p - widen(origin)).unit())};
}

/// The walk's own rule.
template <class T, class H>
Vec<T> spawned(const H& hit, const Vec<T>& direction) {
    struct Space {
        std::optional<H> intersect(const Vec<T>&, const Vec<T>&, T, T) const { return std::nullopt; }
    } space;
    Statistics account;
    nephroid::Photon<Vec<T>, T> photon{hit.position, direction, T(1), {}};
    nephroid::detail::PhotonSteps<Space, Vec<T>, T, 2> steps(space, photon, account);
    steps.leave(hit, false);
    return steps.photon().position;
}

/// The errors found over many rays.
struct Departures {
    int rays = 0, wrong_side = 0, hit_again = 0;
};

#ifdef NEPHROID_TESTS_HAVE_SHAPES
using examples::Ray;

/// @param outside   the exact signed height above the surface, on the side of its normal, in any unit
/// @param convex    nothing of the shape can be met by a ray that leaves outwards
/// @param flat      nor by one that leaves inwards
template <class T, class Shape, class Outside>
void try_ray(Departures& seen, Draws& draws, const Shape& shape, const Shot<T>& shot, const Outside& outside,
             bool convex, bool flat) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Ray<T> ray{shot.origin, shot.direction};
    const auto found = shape.nearest(ray, infinity);
    if (!found)
        return;
    const auto hit = shape.hit(ray, *found);
    const Point<double> n = widen(hit.geometric_normal).unit();
    for (const bool outwards : {true, false}) {
        const Vec<T> next = narrow<T>(leaving(draws, outwards ? n : -n));
        if ((dot(next, hit.geometric_normal) > T(0)) != outwards)
            continue; // rounded into the surface
        ++seen.rays;
        const Vec<T> origin = spawned<T>(hit, next);
        const double above = as_double(outside(lift<Wide>(widen(origin))));
        seen.wrong_side += !(outwards ? above > 0 : above < 0);
        if ((outwards && convex) || flat)
            seen.hit_again += shape.nearest({origin, next}, infinity).has_value();
    }
}

void check(const Departures& seen, int at_least) {
    CHECK(seen.rays >= at_least);
    CHECK(seen.wrong_side == 0);
    CHECK(seen.hit_again == 0);
}

template <class T>
Vec<T> centre_of(Draws& draws, const Place& place) {
    return narrow<T>(place.distance * direction(draws));
}
#endif

} // namespace

#ifdef NEPHROID_TESTS_HAVE_SHAPES
TEST_CASE_TEMPLATE("self-intersection: no ray that leaves a sphere meets it where it starts", T, float, double) {
    for (const Place& place : places<T>) {
        CAPTURE(place.size);
        CAPTURE(place.distance);
        Draws draws(11);
        Departures seen;
        const int count = times(4000, 150000);
        for (int i = 0; i < count; ++i) {
            const Vec<T> centre = centre_of<T>(draws, place);
            const T radius = T(place.size * draws.in(0.5, 2));
            const Point<double> n = direction(draws);
            const auto shot = shot_at<T>(draws, widen(centre) + double(radius) * n, n, place.size);
            const Point<Wide> c = lift<Wide>(widen(centre));
            try_ray(
                seen, draws, examples::Sphere<T>(centre, radius), shot,
                [&](const Point<Wide>& p) { return (p - c).dot(p - c) - Wide(radius) * Wide(radius); }, true, false);
        }
        check(seen, count / 2);
    }
}

TEST_CASE_TEMPLATE("self-intersection: no ray that leaves a cylinder meets it where it starts", T, float, double) {
    for (const Place& place : places<T>) {
        CAPTURE(place.size);
        CAPTURE(place.distance);
        Draws draws(12);
        Departures seen;
        const int count = times(4000, 150000);
        for (int i = 0; i < count; ++i) {
            const Vec<T> base = centre_of<T>(draws, place);
            const T radius = T(place.size * draws.in(0.5, 2)), height = T(4 * place.size);
            const double turn = draws.in(0, 2 * std::numbers::pi);
            const Point<double> n{std::cos(turn), std::sin(turn), 0};
            const Point<double> at = widen(base) + double(radius) * n + Point<double>{0, 0, 0.5 * double(height)};
            const Point<Wide> b = lift<Wide>(widen(base));
            try_ray(
                seen, draws, examples::Cylinder<T>({.base = base, .radius = radius, .height = height}),
                shot_at<T>(draws, at, n, place.size),
                [&](const Point<Wide>& p) {
                    const Wide x = p.x - b.x, y = p.y - b.y;
                    return x * x + y * y - Wide(radius) * Wide(radius);
                },
                true, false);
        }
        check(seen, count / 2);
    }
}

TEST_CASE_TEMPLATE("self-intersection: no ray that leaves a wave meets it where it starts", T, float, double) {
    for (const Place& place : places<T>) {
        CAPTURE(place.size);
        CAPTURE(place.distance);
        Draws draws(13);
        Departures seen;
        const int count = times(1000, 40000);
        for (int i = 0; i < count; ++i) {
            const Vec<T> middle = centre_of<T>(draws, place);
            const T a = T(0.04 * place.size * draws.in(0.1, 1)), kx = T(2 / place.size), ky = T(1 / place.size);
            const examples::SineWave<T> wave({.height = middle.z, .amplitude = a, .kx = kx, .ky = ky});
            const double x = double(middle.x) + place.size * draws.in(-1, 1), y = double(middle.y);
            const double phase = 2 * std::numbers::pi * (double(kx) * x + double(ky) * y);
            const double slope = 2 * std::numbers::pi * double(a) * std::cos(phase);
            const Point<double> n = Point<double>{-slope * double(kx), -slope * double(ky), 1}.unit();
            const Point<double> at{x, y, double(middle.z) + double(a) * std::sin(phase)};
            // 2π in three doubles.
            const Wide two_pi = Wide(6.283185307179586) + Wide(2.4492935982947064e-16) + Wide(-5.989539619436679e-33);
            try_ray(
                seen, draws, wave, shot_at<T>(draws, at, n, place.size),
                [&](const Point<Wide>& p) {
                    return p.z - Wide(middle.z) - Wide(a) * sine_of(two_pi * (Wide(kx) * p.x + Wide(ky) * p.y));
                },
                false, false);
        }
        check(seen, count / 2);
    }
}

// Triangles thin and wide, flat and smooth. A ray that leaves one to either side does not meet it again.
TEST_CASE_TEMPLATE("self-intersection: no ray that leaves a triangle meets it again", T, float, double) {
    for (const Place& place : places<T>) {
        CAPTURE(place.size);
        CAPTURE(place.distance);
        Draws draws(14);
        Departures seen;
        const int count = times(2000, 60000);
        for (int i = 0; i < count; ++i) {
            const Vec<T> middle = centre_of<T>(draws, place);
            const double thin = draws.in(0, 1) < 0.3 ? 1e-3 : 1;
            examples::MeshData<T> data;
            for (int k = 0; k < 3; ++k)
                data.positions.push_back(
                    narrow<T>(widen(middle) +
                              place.size * Point<double>{draws.in(-1, 1), thin * draws.in(-1, 1), draws.in(-1, 1)}));
            data.triangles.push_back({0, 1, 2});
            const std::array<Point<double>, 3> p{widen(data.positions[0]), widen(data.positions[1]),
                                                 widen(data.positions[2])};
            const Point<double> face = (p[1] - p[0]).cross(p[2] - p[0]);
            if (!(face.length() > 1e-6 * place.size * place.size))
                continue;
            const Point<double> n = face.unit();
            if (draws.in(0, 1) < 0.5)
                for (int k = 0; k < 3; ++k)
                    data.normals.push_back(narrow<T>((n + 0.3 * direction(draws)).unit()));
            const double b1 = draws.in(0, 0.5), b2 = draws.in(0, 0.5);
            const Point<double> at = p[0] + b1 * (p[1] - p[0]) + b2 * (p[2] - p[0]);
            const Point<Wide> o = lift<Wide>(p[0]);
            const Point<Wide> exact = (lift<Wide>(p[1]) - o).cross(lift<Wide>(p[2]) - o);
            try_ray(
                seen, draws, examples::TriangleMesh<T>(data), shot_at<T>(draws, at, n, place.size),
                [&](const Point<Wide>& q) { return (q - o).dot(exact); }, true, true);
        }
        check(seen, count / 4);
    }
}

TEST_CASE_TEMPLATE("self-intersection: no ray that leaves a quad or a disk meets it again", T, float, double) {
    for (const Place& place : places<T>) {
        CAPTURE(place.size);
        CAPTURE(place.distance);
        Draws draws(15);
        Departures seen;
        const int count = times(2000, 60000);
        for (int i = 0; i < count; ++i) {
            const Vec<T> middle = centre_of<T>(draws, place), normal = narrow<T>(direction(draws));
            const auto [e, f] = two_across(widen(normal).unit());
            const Vec<T> u = narrow<T>(place.size * e), v = narrow<T>(place.size * (0.5 * e + f));
            const Point<Wide> o = lift<Wide>(widen(middle));
            const Point<double> at = widen(middle) + 0.3 * place.size * (e + f);
            const Point<Wide> face = lift<Wide>(widen(u)).cross(lift<Wide>(widen(v)));
            try_ray(
                seen, draws, examples::Quad<T>(middle, u, v), shot_at<T>(draws, at, widen(normal).unit(), place.size),
                [&](const Point<Wide>& q) { return (q - o).dot(face); }, true, true);
            const Point<Wide> axis = lift<Wide>(widen(normal));
            try_ray(
                seen, draws, examples::Disk<T>(middle, normal, T(place.size)),
                shot_at<T>(draws, at, widen(normal).unit(), place.size),
                [&](const Point<Wide>& q) { return (q - o).dot(axis); }, true, true);
        }
        check(seen, count);
    }
}

namespace {
struct Halves {
    template <class T>
    [[nodiscard]] T next() const {
        return T(0.5);
    }
};
} // namespace

// The whole walk: on a mirror ball alone in space each photon is reflected once and is gone; through a glass ball it
// goes in by one refraction and out by another, and nothing is met twice. What grazes the glass leaves it at the
// critical angle to rounding, and may go round and round: only rays above 0.1 are let in, and only where a hit is known
// to 1e-5 of the ball.
TEST_CASE_TEMPLATE("self-intersection: photons meet a mirror ball once and a glass ball twice", T, float, double) {
    using examples::Scene;
    using M = examples::Material<T>;
    for (const Place& place : places<T>) {
        CAPTURE(place.size);
        CAPTURE(place.distance);
        Draws draws(16);
        Statistics mirrored, passed;
        std::uint64_t arrived = 0, entered = 0;
        const int count = times(2000, 60000);
        for (int i = 0; i < count; ++i) {
            const Vec<T> centre = centre_of<T>(draws, place);
            const T radius = T(place.size * draws.in(0.5, 2));
            const Point<double> n = direction(draws);
            const Point<double> from = leaving(draws, n);
            const Vec<T> origin = narrow<T>(widen(centre) + double(radius) * n + place.size * from);
            const Photon<Vec<T>, T> photon{origin, narrow<T>(-from), T(1), {}};
            Halves sampler;
            const examples::Sphere<T> ball(centre, radius);
            const Scene<T, T> mirror({{ball, 0}}, {M::mirror(T(1))});
            const Scene<T, T> glass({{ball, 0}}, {M::dielectric(1.5, false)});
            if (!mirror.intersect(photon.position, photon.direction, T(0), std::numeric_limits<T>::infinity()))
                continue;
            ++arrived;
            CHECK(!walk(mirror, photon, sampler, WalkLimits{}, mirrored));
            const auto first =
                glass.intersect(photon.position, photon.direction, T(0), std::numeric_limits<T>::infinity());
            if (first->position_error < T(1e-5) * radius && -dot(first->geometric_normal, photon.direction) > T(0.1)) {
                ++entered;
                CHECK(!walk(glass, photon, sampler, WalkLimits{}, passed));
            }
        }
        CHECK(arrived > std::uint64_t(count) / 2);
        CHECK(mirrored.specular_events == arrived);
        CHECK(mirrored.rays == 2 * arrived);
        CHECK(mirrored[Fate::escaped].photons == arrived);
        CHECK(passed.specular_events == 2 * entered);
        CHECK(passed[Fate::escaped].photons == entered);
        if (place.distance == 0)
            CHECK(entered > std::uint64_t(count) / 10);
    }
}
#endif

namespace {

/// A tracer as small renderers have them: all in T, the textbook's quadratic, and the library's bound on its error.
template <class T>
struct PlainBall {
    Vec<T> centre;
    T radius;

    [[nodiscard]] std::optional<SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>> intersect(const Vec<T>& o, const Vec<T>& d,
                                                                                     T t_min, T t_max) const {
        const Vec<T> from = o - centre;
        const T b = dot(from, d), c = dot(from, from) - radius * radius;
        const T under = b * b - c;
        if (!(under > T(0)))
            return std::nullopt;
        for (const T t : {-b - std::sqrt(under), -b + std::sqrt(under)})
            if (t > t_min && t < t_max) {
                const Vec<T> n = normalize(Vec<T>(from + t * d)), at = centre + radius * n;
                return SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>{
                    t, at, n, n, sphere_curvature<Vec<T>>(radius), rounding_error(o, t, at)};
            }
        return std::nullopt;
    }
};

} // namespace

TEST_CASE_TEMPLATE("self-intersection: a plain tracer with the library's rounding error leaves its ball", T, float,
                   double) {
    for (const Place& place : {Place{1, 0}, Place{1e-4, 0}, Place{1e4, 0}, Place{1, 10}, Place{30, 1e3}}) {
        CAPTURE(place.size);
        CAPTURE(place.distance);
        Draws draws(17);
        int rays = 0, wrong_side = 0, again = 0;
        const int count = times(10000, 300000);
        for (int i = 0; i < count; ++i) {
            const PlainBall<T> ball{narrow<T>(place.distance * direction(draws)), T(place.size * draws.in(0.5, 2))};
            const Point<double> n = direction(draws);
            const auto shot = shot_at<T>(draws, widen(ball.centre) + double(ball.radius) * n, n, place.size);
            const auto hit = ball.intersect(shot.origin, shot.direction, T(0), std::numeric_limits<T>::infinity());
            if (!hit)
                continue;
            const Vec<T> out = narrow<T>(leaving(draws, widen(hit->geometric_normal).unit()));
            if (!(dot(out, hit->geometric_normal) > T(0)))
                continue;
            ++rays;
            const Point<Wide> c = lift<Wide>(widen(ball.centre));
            const auto height = [&](const Vec<T>& p) {
                const Point<Wide> q = lift<Wide>(widen(p)) - c;
                return as_double(q.dot(q) - Wide(ball.radius) * Wide(ball.radius));
            };
            const Vec<T> outside = spawned<T>(*hit, out), inside = spawned<T>(*hit, Vec<T>(-out));
            wrong_side += !(height(outside) > 0) + !(height(inside) < 0);
            again += ball.intersect(outside, out, T(0), std::numeric_limits<T>::infinity()).has_value();
        }
        CHECK(rays > count / 3);
        CHECK(wrong_side == 0);
        CHECK(again == 0);
    }
}

} // namespace nephroid::tests::self_intersection_test
