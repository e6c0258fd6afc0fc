// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/exact_path_derivatives.hpp"

#include "smoothing/second_order/emission_differences.hpp"
#include "support/foreign_vectors.hpp"
#include "support/glass_ball.hpp"

#include "nephroid/emission/light/point.hpp"
#include "nephroid/smoothing/pilot.hpp"
#include "nephroid/smoothing/second_order/footprint_field.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::tests::exact_path_derivatives_test {

using namespace nephroid::detail;
using tests::for_photons;
using tests::Neighbours;
using tests::relative_difference;
using tests::Space;
using tests::Wide;

namespace {

template <class T>
using Plain = foreign::Plain<T>;
template <class T>
using Ball = tests::GlassBall<Plain<T>, T>;

using Once = Dual<double, 2>;
using Twice = Dual<Once, 2>;

constexpr double photons = 1000;

/// Light that comes down at a slant onto the middle of the ball.
template <class T>
[[nodiscard]] DirectionalLight<Plain<T>, T> sun() {
    return DirectionalLight<Plain<T>, T>(
        {.direction = {T(0.25), T(0), T(-1)},
         .irradiance = 1,
         .patch = Parallelogram<Plain<T>>{{T(-1), T(-0.5), T(3.5)}, {T(1), T(0), T(0)}, {T(0), T(1), T(0)}}});
}

[[nodiscard]] PointLight<Plain<double>, double> bulb() {
    return PointLight<Plain<double>, double>(
        {.position = {0.5, 0, 6}, .intensity = 8, .target = BoundingSphere<Plain<double>>{{0, 0, 1.5}, 0.7}});
}

/// Through the ball of GlassBall onto the floor, in wide precision: Snell's law by angles.
[[nodiscard]] Space under_ball(const tests::WideRay& ray) {
    const Wide one(1), index(1.5);
    const Space centre{Wide(0), Wide(0), Wide(1.5)}, up{Wide(0), Wide(0), one};
    const Space in = tests::on_sphere(ray.origin - centre, ray.direction, one, false);
    const Space inside = tests::bent(ray.direction, in.unit(), one / index);
    const Space out = tests::on_sphere(in, inside, one, true);
    const Space ahead = tests::bent(inside, Wide(-1) * out.unit(), index);
    return tests::on_plane(out + centre, ahead, {Wide(0), Wide(0), Wide(0)}, up);
}

template <class T, class P, class S>
[[nodiscard]] std::optional<ExactPath> follow(const P& photon, S sampler) {
    return exact_path_derivatives<Plain<T>>(Ball<T>{.tint = T(1)}, photon, sampler);
}

} // namespace

#if defined(__SIZEOF_FLOAT128__) // else the differences have no digits left
// Differences of step 1e-5 of the ball's own scale, in units: wrong by 1e-10 of the next derivatives but one, each of
// which is the unit, 0.05, times the one before or smaller; the walk's own rounding is 1e-13.
TEST_CASE("exact path derivatives: under a ball of glass they are the central differences of the whole path") {
    const auto check = [](const auto& light) {
        for_photons(light, [](const auto& photon, const auto& sampler) {
            const auto path = follow<Twice>(photon, sampler);
            REQUIRE(path);
            const Neighbours neighbours(photon);
            const Double3 end = tests::narrowed(under_ball(neighbours.at(Wide(0), Wide(0))));
            const Double3 off = path->position - end;
            CHECK(std::sqrt(inner(off, off)) < 1e-13);
            const PathDerivatives expected = tests::derivatives_by_differences(neighbours, under_ball);
            CHECK(relative_difference(path->map.first, expected.first) < 1e-11);
            CHECK(relative_difference(path->map.second, expected.second) < 1e-11);
            CHECK(relative_difference(path->map.third, expected.third) < 1e-10);
        });
    };
    check(sun<double>());
    check(bulb());
}
#endif

TEST_CASE(
    "exact path derivatives: with one layer of dual numbers the second ones are the same and the third are zero") {
    for_photons(bulb(), [](const auto& photon, const auto& sampler) {
        const auto once = follow<Once>(photon, sampler), twice = follow<Twice>(photon, sampler);
        REQUIRE((once && twice));
        CHECK(relative_difference(once->map.first, twice->map.first) < 1e-14);
        CHECK(relative_difference(once->map.second, twice->map.second) < 1e-13);
        for (const Double3& third : once->map.third)
            CHECK(inner(third, third) == 0);
        CHECK(once->signature == twice->signature);
    });
}

TEST_CASE("exact path derivatives: the path is the plain walk's and so are the tangents") {
    for_photons(sun<double>(), [](const auto& photon, const auto& sampler) {
        auto plain = sampler;
        Statistics account;
        PathSignature signature;
        const auto deposit = walk(Ball<double>{.tint = 1}, photon, plain, {}, account, signature);
        const auto path = follow<Once>(photon, sampler);
        REQUIRE((deposit && path));
        CHECK(path->signature == signature.value());
        const auto tangents = half_tangents(*deposit);
        CHECK(relative_difference(path->map.first, tangents) < 1e-13);
    });
}

TEST_CASE("exact path derivatives: a photon that does not land has none") {
    // Beside the ball, onto the floor: direct light.
    const Photon<Plain<double>, double> astray{{3, 0, 3}, {0, 0, -1}, 1.0, {}};
    const HaltonSequence sequence(1);
    CHECK(!follow<Once>(astray, Sampler<HaltonSequence>(sequence, 0)));
}

TEST_CASE("exact path derivatives: a photon in float has them to within its rounding") {
    const HaltonSequence sequence(1);
    for (std::uint64_t i = 0; i < 8; ++i) {
        Sampler<HaltonSequence> of_float(sequence, i), of_double(sequence, i);
        const auto narrow = follow<Once>(sun<float>().emit(of_float, Spread<float>{float(photons), 1.f}), of_float);
        const auto wide = follow<Once>(sun<double>().emit(of_double, Spread<double>{photons, 1}), of_double);
        REQUIRE((narrow && wide));
        CHECK(relative_difference(narrow->map.second, wide->map.second) < 1e-4);
    }
}

namespace {

/// The field's second derivatives against the exact ones, over photons in the middle of the ball: root mean square,
/// relative to the root mean square of the exact ones.
template <class L>
[[nodiscard]] double error_of_field(const L& light, std::size_t count) {
    const HaltonSequence sequence(1);
    const PhotonPass pass{.count = count};
    SerialExecutor executor;
    const Ball<double> ball{.tint = 1};
    const auto pilot = detail::trace_pilot(ball, light, pass, SecondOrder{}, sequence, executor);
    const FootprintField field(pilot.photons, {.stratified = true, .photons = double(count)}, executor);
    double difference2 = 0, sum2 = 0;
    for (std::uint64_t i = 0; i < 200; ++i) {
        const auto& photon = pilot.photons[i];
        Sampler<HaltonSequence> sampler(sequence, i);
        const auto emitted = light.emit(sampler, Spread<double>{double(count), 1});
        const auto& at = photon.sample.at;
        const double x = std::abs(at[0] - 0.5), y = std::abs(at[1] - 0.5);
        // At the border the fit is one-sided; on the diagonals a light's map from the square to a disk has creases,
        // over which the cells' values are interpolated to first order only.
        if ((std::max)(x, y) > 0.3 || std::abs(x - y) < 0.08)
            continue;
        const auto exact = follow<Once>(emitted, sampler);
        const auto fitted = field.at(at, photon.frame, photon.signature);
        REQUIRE((exact && fitted));
        for (std::size_t k = 0; k < 3; ++k) {
            const Double3 off = fitted->second[k] - exact->map.second[k];
            difference2 += inner(off, off);
            sum2 += inner(exact->map.second[k], exact->map.second[k]);
        }
    }
    return std::sqrt(difference2 / sum2);
}

} // namespace

// Within a cell, whose side falls like the root of the photons' number, H is fitted and then interpolated to second
// order: four times the photons make a quarter of the error.
TEST_CASE("exact path derivatives: fitted derivatives converge to them as photons get denser") {
    const auto check = [](const auto& light) {
        std::vector<double> errors;
        for (const std::size_t count : {1500u, 6000u, 24000u})
            errors.push_back(error_of_field(light, count));
        CAPTURE(errors[0]);
        CAPTURE(errors[1]);
        CAPTURE(errors[2]);
        CHECK(errors[0] < 0.1);
        for (std::size_t i = 1; i < errors.size(); ++i) {
            CHECK(errors[i - 1] / errors[i] > 3);
            CHECK(errors[i - 1] / errors[i] < 5.5);
        }
    };
    check(sun<double>());
    check(bulb());
}

} // namespace nephroid::tests::exact_path_derivatives_test
