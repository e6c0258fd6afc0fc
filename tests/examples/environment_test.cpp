// SPDX-License-Identifier: MIT
#include "common/direct_light.hpp"
#include "common/environment_light.hpp"
#include "common/shapes.hpp"
#include "emission/light/light_laws.hpp"

#include "nephroid/execution/executor.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

namespace nephroid::examples::environment_test {

using nephroid::tests::check_light_laws;
using nephroid::tests::check_same;
using nephroid::tests::flux_of;
using nephroid::tests::Mean;

namespace {

using V = Vec3<double>;
using Around = Environment<double, double>;

/// A picture of 8 by 4 pixels that is bright on the right, dark on the left.
Samples shaded() {
    Samples picture(8, 4, 1, {});
    for (std::size_t y = 0; y < 4; ++y)
        for (std::size_t x = 0; x < 8; ++x)
            picture.samples.push_back(0.5f + float(x) + 2 * float(y));
    return picture;
}

/// The mean over directions drawn uniformly from the sphere.
template <class Function>
double over_the_sphere(const Function& function) {
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double height = 1 - 2 * (i + 0.5) / n, longitude = 2 * pi<double> * (j + 0.5) / n;
            const double across = std::sqrt(1 - height * height);
            sum += function(V(across * std::cos(longitude), height, across * std::sin(longitude)));
        }
    return sum * 4 * pi<double> / (n * n);
}

std::vector<std::shared_ptr<const Around>> all_kinds() {
    return {std::make_shared<const Around>(Around::constant(2)),
            std::make_shared<const Around>(Around::sun(normalize(V(1, -2, 0.5)), 3, 0.3)),
            std::make_shared<const Around>(Around::picture(shaded()))};
}

} // namespace

TEST_CASE(
    "environment: directions are drawn with the density that is said, and radiance over it adds up to the total") {
    for (const auto& around : all_kinds()) {
        Mean total;
        constexpr int n = 300;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const auto drawn = around->sample((i + 0.5) / n, (j + 0.5) / n);
                CHECK(std::abs(length(drawn.towards) - 1) < 1e-12);
                CHECK(drawn.density == doctest::Approx(around->density(drawn.towards)).epsilon(1e-6));
                CHECK(drawn.radiance == doctest::Approx(around->radiance(drawn.towards)).epsilon(1e-6));
                total.add(drawn.radiance / drawn.density);
            }
        // Interpolation spreads what pixels hold, among few and unlike ones by some percent of the total.
        CHECK(total.value() ==
              doctest::Approx(around->total()).epsilon(around->is_lamp() || around->is_constant() ? 1e-6 : 0.05));
        if (!around->is_lamp()) {
            CHECK(over_the_sphere([&](const V& d) { return around->density(d); }) == doctest::Approx(1).epsilon(0.01));
            CHECK(over_the_sphere([&](const V& d) { return around->radiance(d); }) ==
                  doctest::Approx(total.value()).epsilon(0.01));
        }
    }
}

// Across a sun of irradiance E the integral of its radiance times the cosine is E.
TEST_CASE("environment: a sun of any size has its irradiance and its diameter") {
    const V direction = normalize(V(0.2, -1, 0.4));
    for (const double diameter : {0.0093, 0.1, 1.0}) {
        const Around sun = Around::sun(direction, 5, diameter);
        CHECK(sun.is_lamp());
        double irradiance = 0, widest = 0;
        constexpr int n = 200;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const auto drawn = sun.sample((i + 0.5) / n, (j + 0.5) / n);
                irradiance += drawn.radiance * -dot(drawn.towards, direction) / drawn.density / (n * n);
                widest = (std::max)(widest, length(cross(drawn.towards, direction)));
            }
        CHECK(irradiance == doctest::Approx(5).epsilon(1e-4));
        CHECK(widest <= std::sin(diameter / 2) * (1 + 1e-9));
        CHECK(widest > std::sin(diameter / 2) * 0.99);
        CHECK(sun.radiance(direction) == 0);
        CHECK(sun.radiance(-direction) > 0);
    }
}

TEST_CASE("environment: a picture's middle is at -z, its right half at +x, its upper half above") {
    const Around around = Around::picture(shaded());
    // Interpolated between the four pixels about the middle: columns 3 and 4, rows 1 and 2.
    CHECK(around.radiance({0, 0, -1}) == doctest::Approx(0.5 + 3.5 + 2 * 1.5));
    CHECK(around.radiance({1, 0, 0}) == doctest::Approx(0.5 + 5.5 + 3));
    CHECK(around.radiance({-1, 0, 0}) == doctest::Approx(0.5 + 1.5 + 3));
    CHECK(around.radiance({0, 1, 0}) > around.radiance({0, -1, 0}));
    // It goes round: behind, the last column lies beside the first.
    CHECK(around.radiance({0, 0, 1}) == doctest::Approx(0.5 + 3.5 + 3));
    CHECK(around.radiance(normalize(V(1e-9, 0, 1))) == doctest::Approx(around.radiance(normalize(V(-1e-9, 0, 1)))));
}

TEST_CASE("environment: pictures that cannot shine are refused") {
    const auto picture = [](std::vector<float> samples) { return Samples(samples.size(), 1, 1, samples); };
    CHECK_THROWS_AS(static_cast<void>(Around::picture({})), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Around::picture(picture({0, 0}))), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Around::picture(picture({1, -1}))), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Around::picture(picture({1, std::nanf("")}))), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Around::sun({0, -1, 0}, 1, 0)), std::invalid_argument);
    CHECK_THROWS_AS(static_cast<void>(Around::sun({0, -1, 0}, 1, 4)), std::invalid_argument);
}

TEST_CASE("environment light: it is a light as the library wants it, with the flux through its target") {
    const BoundingSphere<V> target{{1, 2, 3}, 0.5}, scene{{0, 0, 0}, 10};
    for (const auto& around : all_kinds()) {
        const EnvironmentLight<double, double> light(around, target, scene);
        check_light_laws(light, 4);
        const Mean flux = flux_of(light, 20000, &target);
        const bool is_picture = !around->is_lamp() && !around->is_constant();
        check_same<double>(flux, light.power(), is_picture ? 0.01 * light.power() : 0);
        for (std::uint64_t i = 0; i < 100; ++i) { // in front of all that may cast a shadow
            const auto photon = nephroid::tests::photon_of(light, i, 1);
            CHECK(dot(photon.position - scene.centre, photon.direction) < -scene.radius * 0.999);
        }
    }
}

// Light that is the same from everywhere goes through every disk about the target's centre alike, pi L times its area.
TEST_CASE("environment light: the same light from everywhere is the same on every plane") {
    const BoundingSphere<V> target{{1, 2, 3}, 0.5}, scene{{0, 0, 0}, 10};
    const EnvironmentLight<double, double> light(std::make_shared<const Around>(Around::constant(2)), target, scene);
    for (const V& normal : {V(0, 1, 0), normalize(V(1, 1, 0)), normalize(V(-1, 0.5, 2))}) {
        Mean flux;
        for (std::uint64_t i = 0; i < 40000; ++i) {
            const auto photon = nephroid::tests::photon_of(light, i, 1);
            const double cosine = -dot(photon.direction, normal);
            const V at = photon.position + dot(photon.position - target.centre, normal) / cosine * photon.direction;
            flux.add(cosine > 0 && length(V(at - target.centre)) < 0.4 ? photon.flux : 0);
        }
        check_same<double>(flux, 2 * pi<double> * pi<double> * 0.16);
    }
}

// The domain is a place on the disk through the target's centre and a direction: there the tangents are as far apart as
// N photons on that disk, and beyond it they spread by the angle.
TEST_CASE("environment light: footprints are those of the disk at the target, and spread beyond it") {
    const BoundingSphere<V> target{{1, 2, 3}, 0.5}, scene{{0, 0, 0}, 10};
    for (const auto& around : all_kinds()) {
        const EnvironmentLight<double, double> light(around, target, scene);
        const auto photon = nephroid::tests::photon_of(light, 5, 1000);
        const double to_disk = dot(target.centre - photon.position, photon.direction);
        const auto flight = transfer(photon.direction, to_disk, photon.direction);
        REQUIRE(flight.has_value());
        for (const auto& tangent : photon.differential)
            CHECK(length((*flight)(tangent).d_position) ==
                  doctest::Approx(2 * std::sqrt(pi<double> * 0.25 / (pi<double> * 1000))).epsilon(1e-6));
    }
}

TEST_CASE(
    "environment: its direct light on an open floor is exact where it is the same everywhere, and halved by a wall") {
    using S = examples::Scene<double, double>;
    using M = Material<double>;
    const auto irradiance = [](const S& scene, const V& position, std::shared_ptr<const Around> around) {
        Lamps<double, double> lamps;
        lamps.environments.push_back(std::move(around));
        const DirectLight<double, double> light(scene, lamps, {.environment_rays = 4096});
        return light.irradiance({position, {0, 0, 1}, {0, 0, 1}, 1e-12, 0, 1}, 7);
    };
    const S open({{Floor<double>(0), 0}}, {M::diffuse(1)});
    CHECK(irradiance(open, {0, 0, 0}, std::make_shared<const Around>(Around::constant(2))) ==
          doctest::Approx(2 * pi<double>).epsilon(1e-6));
    CHECK(irradiance(open, {0, 0, 0}, std::make_shared<const Around>(Around::sun(normalize(V(0, 3, -4)), 5, 0.01))) ==
          doctest::Approx(5 * 0.8).epsilon(1e-3));
    // The picture's z is forwards, so that over this floor, which faces +z, shines what lies behind: by quadrature.
    const auto picture = std::make_shared<const Around>(Around::picture(shaded()));
    const double exact = over_the_sphere([&](const V& d) { return d.z > 0 ? d.z * picture->radiance(d) : 0; });
    CHECK(irradiance(open, {0, 0, 0}, picture) == doctest::Approx(exact).epsilon(0.02));
}

} // namespace nephroid::examples::environment_test
