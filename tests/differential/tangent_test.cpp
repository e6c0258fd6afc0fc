// SPDX-License-Identifier: MIT
// What a tangent is for: carried through a glass ball to a plane, event by event, it is the derivative of the whole
// path.
#include "nephroid/differential/tangent.hpp"

#include "nephroid/differential/curvature.hpp"
#include "nephroid/differential/refraction.hpp"
#include "nephroid/differential/transfer.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace nephroid::tests::tangent_test {

using tests::derivative;
using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

static_assert(std::is_same_v<PhotonDifferential<glm::vec3>, std::array<Tangent<glm::vec3>, 2>>);
static_assert(std::is_aggregate_v<Tangent<glm::vec3>> &&
              std::is_trivially_copyable_v<PhotonDifferential<glm::vec3, 4>>);
static_assert(sizeof(PhotonDifferential<glm::vec3>) == 12 * sizeof(float));

/// A ray; its end on the plane below the ball is where it lands.
struct Ray {
    Space x, w;
};

const Wide radius = 1.25;
const Wide index_of_glass = 1.5;
const Space plane_point{0, 0, -3};
const Space plane_normal{0.125, -0.25, 1};

/// Through the ball by angles: the same path in wide precision. `stops` gets each vertex and the direction towards it.
Ray traced(const Ray& from, Ray* stops = nullptr) {
    const Space first = tests::on_sphere(from.x, from.w, radius, false);
    const Space inside = tests::bent(from.w, first.unit(), Wide(1) / index_of_glass);
    const Space second = tests::on_sphere(first, inside, radius, true);
    const Space below = tests::bent(inside, Wide(-1) * second.unit(), index_of_glass);
    const Space end = tests::on_plane(second, below, plane_point, plane_normal);
    if (stops != nullptr)
        stops[0] = {first, from.w}, stops[1] = {second, inside}, stops[2] = {end, below};
    return {end, below};
}

/// A tangent on its way with bounds on its size (dx, dω) and on its error and its ray's, in epsilons. Each step adds
/// the bound that the event's own test derives, and magnifies the errors so far by the event's slope.
struct Bound {
    double position, direction, position_error, direction_error;
    double ray_error = 1;

    // The ray counts as ω in the correction (once) and in n · ω under it (once more, over the cosine squared).
    void fly(double distance, double cosine) {
        const double f = position + distance * direction, cosine2 = cosine * cosine;
        position_error = (position_error + distance * direction_error) / cosine + (10 + 2 * ray_error) * f / cosine2;
        position = f / cosine;
    }
    // The ray changes c by its error e, c' by eta² c/c' e and so dμ/dc by (eta²/c' + eta⁴/c'³) e; it is in dc
    // itself, by e, which dμ/dc magnifies, and in the projection twice: 8 H²/c'³ holds them all. Principal
    // curvatures: 24 dx / R.
    void refract(double eta, double cosine, double bent_cosine, double curvature) {
        const double h = std::max(1.0, eta * eta), bent_cosine3 = bent_cosine * bent_cosine * bent_cosine;
        const double slope = std::abs(eta - eta * eta * cosine / bent_cosine);
        const double magnified = eta + slope + std::abs(eta * cosine - bent_cosine);
        const double d = direction + curvature * position;
        const double d_error = direction_error + curvature * (position_error + 24 * position);
        direction_error = magnified * d_error + (128 + 8 * ray_error) * d * h * h / bent_cosine3;
        direction = magnified * d;
        ray_error = (eta + slope) * ray_error + 16 * h / bent_cosine;
    }
};

/// The same by the library. Hits are the exact ones, rounded; directions are its own.
template <class V>
Tangent<V> carried(const Ray& from, const Tangent<V>& emitted, Bound& bound) {
    using T = scalar_t<V>;
    Tangent<V> tangent = emitted;
    Ray stops[3];
    (void)traced(from, stops);
    V direction = tests::narrow<V>(from.w);
    Space position = from.x;
    for (int i = 0; i < 3; ++i) {
        const Space normal = i == 2 ? plane_normal : stops[i].x.unit();
        const Wide distance = (stops[i].x - position).length();
        position = stops[i].x;
        const auto flight = transfer(direction, static_cast<T>(distance), tests::narrow<V>(normal));
        REQUIRE(flight.has_value());
        tangent = (*flight)(tangent);
        bound.fly(double(distance), std::abs(double(stops[i].w.dot(normal.unit()))));
        if (i == 2)
            break;
        // On leaving, normal and curvature face the ray: both change sign.
        const Wide side = i == 0 ? 1 : -1, eta = i == 0 ? Wide(1) / index_of_glass : index_of_glass;
        const Space e1 = normal.cross(Space{1, 0, 0}).unit(), e2 = normal.cross(e1);
        const T k = static_cast<T>(side / radius);
        const auto curvature = principal_curvatures(tests::narrow<V>(e1), k, tests::narrow<V>(e2), k);
        const auto surface = refraction(direction, tests::narrow<V>(side * normal), static_cast<T>(eta));
        REQUIRE(surface.has_value());
        tangent.d_direction = surface->differentiate(tangent.d_direction, curvature(tangent.d_position));
        direction = surface->direction();
        bound.refract(double(eta), std::abs(double(stops[i].w.dot(normal))),
                      std::abs(double(stops[i + 1].w.dot(normal))), double(Wide(1) / radius));
    }
    return tangent;
}

// `Bound` holds the roundings. The difference: the nearest singularity is the ray that grazes the ball, farther than
// 1/16.
template <class V>
void check(const Ray& from, const Tangent<V>& tangent) {
    using T = scalar_t<V>;
    const Space dx = tests::widen(tangent.d_position), dw = tests::widen(tangent.d_direction).across(from.w);
    const auto path = [&](const Wide& p) { return traced({from.x + p * dx, (from.w + p * dw).unit()}); };
    const Space expected_x = derivative([&](const Wide& p) { return path(p).x; });
    const Space expected_w = derivative([&](const Wide& p) { return path(p).w; });

    Bound bound{tests::magnitude(dx), tests::magnitude(dw), 2 * tests::magnitude(dx), 2 * tests::magnitude(dw)};
    const Tangent<V> found = carried(from, tangent, bound);
    const double epsilon = double(std::numeric_limits<T>::epsilon()),
                 difference = 4 * tests::derivative_error(1.0 / 16);
    CHECK(bound.position_error * epsilon <
          (std::is_same_v<T, float> ? 1 : 1e-8) * bound.position); // else it bounds nothing
    CHECK(tests::distance(found.d_position, expected_x) <= bound.position_error * epsilon + difference);
    CHECK(tests::distance(found.d_direction, expected_w) <= bound.direction_error * epsilon + difference);
}

template <class V>
Space rounded(const Space& s) {
    return tests::widen(tests::narrow<V>(s));
}

TEST_CASE_TEMPLATE("tangent: through a glass ball to a plane is the path's derivative for a point light", T, float,
                   double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(91);
        for (int i = 0; i < 20; ++i) {
            const Space light{0.5, -0.25, 4}, aim{draw.in(-0.7, 0.7), draw.in(-0.7, 0.7), 0};
            const Ray ray{light, rounded<V>((aim - light).unit()).unit()};
            check<V>(ray, {zero_vector<V>(), tests::narrow<V>(draw.in_cube().across(ray.w))});
        }
    });
}

TEST_CASE_TEMPLATE("tangent: through a glass ball to a plane is the path's derivative for collimated light", T, float,
                   double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(92);
        for (int i = 0; i < 20; ++i) {
            const Ray ray{rounded<V>({draw.in(-1.1, 0.3), draw.in(-0.5, 0.9), 4}),
                          rounded<V>(Space{0.1, -0.05, -1}.unit()).unit()};
            check<V>(ray, {tests::narrow<V>(draw.in_cube().across(ray.w)), zero_vector<V>()});
        }
    });
}

// Every event is linear, so a sum of tangents is carried to the sum; to the bounds of the three.
TEST_CASE_TEMPLATE("tangent: the path acts linearly on tangents", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const Ray ray{{0.5, -0.25, 4}, rounded<V>(Space{0, 0.125, -1}.unit()).unit()};
        const auto vector = [](double x, double y) { return make_vector<V>(T(x), T(y), 0); };
        const Tangent<V> a{vector(1, 0), vector(0, 0.25)}, b{vector(-0.5, 2), vector(0.5, 0)},
            both{vector(0.5, 2), vector(0.5, 0.25)};
        Bound bound_a{1, 0.25, 0, 0}, bound_b{2.1, 0.5, 0, 0}, bound{2.1, 0.6, 0, 0};
        const Tangent<V> a_end = carried(ray, a, bound_a), b_end = carried(ray, b, bound_b),
                         end = carried(ray, both, bound);
        const double error = double(std::numeric_limits<T>::epsilon()) *
                             (bound.position_error + bound_a.position_error + bound_b.position_error);
        CHECK(tests::distance(end.d_position, tests::widen(a_end.d_position) + tests::widen(b_end.d_position)) <=
              error);
    });
}

// The ball lens: paraxially, light from infinity meets at n R / (2 (n − 1)) from the centre.
TEST_CASE_TEMPLATE("tangent: a ball lens focuses at n R over 2 n minus 2", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        const V down = make_vector<V>(0, 0, -1), up = make_vector<V>(0, 0, 1);
        const T n = T(1.5), r = T(1.25), focus = n * r / (T(2) * (n - T(1)));
        const auto into = refraction(down, up, T(1) / n), out = refraction(down, up, n);
        const auto through = transfer(down, T(2) * r, up), beyond = transfer(down, focus - r, up);
        REQUIRE((into.has_value() && out.has_value() && through.has_value() && beyond.has_value()));
        Tangent<V> tangent{make_vector<V>(1, 0, 0), zero_vector<V>()};
        const V x = make_vector<V>(1, 0, 0), y = make_vector<V>(0, 1, 0);
        tangent.d_direction = into->differentiate(tangent.d_direction,
                                                  principal_curvatures(x, T(1) / r, y, T(1) / r)(tangent.d_position));
        tangent = (*through)(tangent);
        tangent.d_direction = out->differentiate(tangent.d_direction,
                                                 principal_curvatures(x, T(-1) / r, y, T(-1) / r)(tangent.d_position));
        tangent = (*beyond)(tangent);
        // About 20 roundings of numbers below 2: c = c' = 1 exactly.
        CHECK(tests::distance(tangent.d_position, Space{0, 0, 0}) <= 20 * double(std::numeric_limits<T>::epsilon()));
    });
}

} // namespace

} // namespace nephroid::tests::tangent_test
