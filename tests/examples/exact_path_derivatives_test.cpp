// SPDX-License-Identifier: MIT
// The examples' shapes in dual numbers: second and third derivatives of photons' paths through them, against
// differences of the whole path in wide precision.
#include "nephroid/smoothing/second_order/exact_path_derivatives.hpp"

#include "common/numerics/arithmetic.hpp"
#include "common/shapes/cylinder.hpp"
#include "common/shapes/flat.hpp"
#include "common/shapes/sphere.hpp"
#include "common/shapes/wave.hpp"
#include "smoothing/second_order/emission_differences.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/sequence/halton.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <optional>

namespace nephroid::examples::exact_path_derivatives_test {

using namespace nephroid::detail;
using tests::Space;
using tests::Wide;
using tests::WideRay;

namespace {

template <class T>
using ShapeHit = nephroid::examples::Hit<T>;

using Once = Dual<double, 2>;
using Twice = Dual<Once, 2>;

/// One shape over the floor z = 0, of glass with an index of refraction, or a mirror where that is 0.
template <class T, template <class> class Shape>
struct OverFloor {
    Shape<T> shape;
    T index;
    Floor<T> floor{T(0)};

    [[nodiscard]] std::optional<ShapeHit<T>> intersect(const Vec3<T>& origin, const Vec3<T>& direction, const T& t_min,
                                                       const T& t_max) const {
        const Ray<T> ray{origin, direction, t_min, t_max};
        if (const auto found = shape.nearest(ray, wide_t<T>(t_max))) {
            ShapeHit<T> hit = shape.hit(ray, *found);
            hit.surface = 1;
            return hit;
        }
        const auto found = floor.nearest(ray, wide_t<T>(t_max));
        return found ? std::optional(floor.hit(ray, *found)) : std::nullopt;
    }

    template <class Sampler>
    [[nodiscard]] Scattering<T, T> scatter(const ShapeHit<T>& hit, const Vec3<T>& direction, Sampler&) const {
        using Answer = Scattering<T, T>;
        if (hit.surface == 0)
            return Answer::deposit();
        if (!(index > T(0)))
            return Answer::reflect(T(1));
        return Answer::refract(T(1), dot(direction, hit.geometric_normal) < T(0) ? T(1) / index : index);
    }
};

[[nodiscard]] Space point(double x, double y, double z) { return {Wide(x), Wide(y), Wide(z)}; }

[[nodiscard]] Space on_floor(const WideRay& ray) {
    return tests::on_plane(ray.origin, ray.direction, point(0, 0, 0), point(0, 0, 1));
}

/// @param scene  scene(T()): in the scalar T
/// @param end    where a ray ends, in wide precision
template <class L, class MakeScene, class End>
void check(const L& light, const MakeScene& scene, const End& end) {
    tests::for_photons(light, [&](const auto& photon, auto sampler) {
        auto again = sampler, plain = sampler;
        const auto twice = exact_path_derivatives<Vec3<Twice>>(scene(Twice()), photon, sampler);
        const auto once = exact_path_derivatives<Vec3<Once>>(scene(Once()), photon, again);
        Statistics account;
        const auto deposit = walk(scene(double()), photon, plain, {}, account);
        REQUIRE((twice && once && deposit));
        const tests::Neighbours neighbours(photon);
        const Double3 off = twice->position - tests::narrowed(end(neighbours.at(Wide(0), Wide(0))));
        CHECK(std::sqrt(inner(off, off)) < 1e-13);
        const Double3 landed{deposit->position.x, deposit->position.y, deposit->position.z};
        CHECK(std::sqrt(inner(landed - once->position, landed - once->position)) < 1e-14);

        const PathDerivatives expected = tests::derivatives_by_differences(neighbours, end);
        // The differences are wrong by 1e-10 of the derivatives two orders up, and those of so small a unit by 1e-2 of
        // what they are compared with at most; each derivative of a path in double loses a digit or so.
        CHECK(tests::relative_difference(once->map.first, expected.first) < 1e-11);
        CHECK(tests::relative_difference(once->map.second, expected.second) < 1e-10);
        CHECK(tests::relative_difference(twice->map.second, expected.second) < 1e-10);
        CHECK(tests::relative_difference(twice->map.third, expected.third) < 1e-9);
    });
}

} // namespace

#if defined(__SIZEOF_FLOAT128__) // else the differences have no digits left
TEST_CASE("exact path derivatives: through a wave of water they are those of differences of the whole path") {
    constexpr double amplitude = 0.04, index = 1.33;
    const auto scene = []<class T>(T) {
        return OverFloor<T, SineWave>{SineWave<T>({.height = T(1), .amplitude = T(amplitude)}), T(index)};
    };
    const auto end = [](const WideRay& ray) {
        // Newton's method along the ray, from the wave's mean height.
        const Wide a(amplitude);
        const Wide two_pi =
            Wide(4) * (Wide(1.5707963267948966) + Wide(6.123233995736766e-17) + Wide(-1.4973849048591833e-33));
        const auto phase = [&](const Space& p) { return two_pi * (Wide(2) * p.x + p.y); };
        Wide t = (Wide(1) - ray.origin.z) / ray.direction.z;
        for (int i = 0; i < 12; ++i) {
            const Space p = ray.origin + t * ray.direction;
            const examples::numerics::SineCosine wave = examples::numerics::sine_cosine(phase(p));
            const Wide climb = two_pi * (Wide(2) * ray.direction.x + ray.direction.y);
            t = t - (p.z - Wide(1) - a * wave.sine) / (ray.direction.z - a * climb * wave.cosine);
        }
        const Space p = ray.origin + t * ray.direction;
        const Wide slope = a * two_pi * examples::numerics::sine_cosine(phase(p)).cosine;
        const Space normal = Space{Wide(-2) * slope, -slope, Wide(1)}.unit();
        return on_floor({p, tests::bent(ray.direction, normal, Wide(1) / Wide(index))});
    };
    check(DirectionalLight<Vec3<double>, double>(
              {.direction = {0.2, 0.1, -1},
               .irradiance = 1,
               .patch = Parallelogram<Vec3<double>>{{0, 0, 1.25}, {1, 0, 0}, {0, 1, 0}}}),
          scene, end);
    check(PointLight<Vec3<double>, double>(
              {.position = {0.3, 0.2, 3}, .intensity = 1, .target = BoundingSphere<Vec3<double>>{{0.5, 0.5, 1}, 0.5}}),
          scene, end);
}

TEST_CASE("exact path derivatives: from a bent mirror they are those of differences of the whole path") {
    const auto scene = []<class T>(T) {
        const typename Cylinder<T>::Options half{
            .radius = T(1), .height = T(0.5), .facing_x = T(1), .facing_y = T(0), .least_cosine = T(0)};
        return OverFloor<T, Cylinder>{Cylinder<T>(half), T(0)};
    };
    const auto end = [](WideRay ray) {
        for (;;) {
            // The far crossing with the cylinder of radius 1 about the axis, seen from above.
            const Space o{ray.origin.x, ray.origin.y, Wide(0)}, d{ray.direction.x, ray.direction.y, Wide(0)};
            const Wide dd = d.dot(d), middle = -o.dot(d) / dd;
            const Space closest = o + middle * d;
            const Wide t = middle + sqrt((Wide(1) - closest.dot(closest)) / dd);
            const Space p = ray.origin + t * ray.direction;
            if (p.z < Wide(0) || p.z > Wide(0.5) || p.x < Wide(0))
                return on_floor(ray);
            ray = {p, tests::mirrored(ray.direction, {-p.x, -p.y, Wide(0)})};
        }
    };
    // Onto the upper half of the mirror's middle.
    check(DirectionalLight<Vec3<double>, double>(
              {.direction = {0.8, 0.1, -0.55},
               .irradiance = 1,
               .patch = Parallelogram<Vec3<double>>{{-0.1, -0.8, 0.8}, {0, 1.4, 0}, {0, 0, 0.15}}}),
          scene, end);
}

TEST_CASE("exact path derivatives: through the examples' sphere they are those of differences of the whole path") {
    const auto scene = []<class T>(T) {
        return OverFloor<T, Sphere>{Sphere<T>(Vec3<T>(T(0), T(0), T(1.25)), T(1)), T(1.5)};
    };
    const auto end = [](const WideRay& ray) {
        const Wide one(1), index(1.5);
        const Space centre = point(0, 0, 1.25);
        const Space in = tests::on_sphere(ray.origin - centre, ray.direction, one, false);
        const Space inside = tests::bent(ray.direction, in.unit(), one / index);
        const Space out = tests::on_sphere(in, inside, one, true);
        return on_floor({out + centre, tests::bent(inside, Wide(-1) * out.unit(), index)});
    };
    check(PointLight<Vec3<double>, double>(
              {.position = {0.5, 0, 5}, .intensity = 1, .target = BoundingSphere<Vec3<double>>{{0, 0, 1.25}, 0.7}}),
          scene, end);
}
#endif

} // namespace nephroid::examples::exact_path_derivatives_test
