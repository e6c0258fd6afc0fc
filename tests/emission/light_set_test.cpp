// SPDX-License-Identifier: MIT
#include "nephroid/emission/light_set.hpp"

#include "nephroid/vector/glm.hpp"

#include "emission/light/coloured_sun.hpp"
#include "emission/light/light_laws.hpp"
#include "nephroid/emission/emission_sample.hpp"
#include "nephroid/emission/light/standard_lights.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

namespace nephroid::tests::light_set_test {

using detail::RecordingSource;

namespace {

using D = glm::dvec3;
using Lights = StandardLights<D, double>;
using Point = PointLight<D, double>;

/// A user's own light: all photons alike.
struct Laser {
    using vector = D;
    using flux_type = double;
    double watts;

    template <class S>
    Photon<D, double> emit(S&, const Spread<double>& spread) const {
        return {D(0), D(0, 0, 1), watts / spread.photons, {}};
    }
    double power() const { return watts; }
};

/// Three tangents, and no domain.
struct PlainSun {
    using vector = D;
    using flux_type = double;
    ColouredSun<D> sun;

    template <class S>
    Photon<D, double, 3> emit(S& samples, const Spread<double>& spread) const {
        return sun.emit(samples, spread);
    }
    double power() const { return sun.power(); }
};

} // namespace

static_assert(Light<Lights>);
static_assert(Light<StandardLights<glm::vec3, glm::vec3>>);
static_assert(Light<LightSet<Laser>>);

constexpr detail::EmissionDomains of_point = detail::emission_domains<Point>,
                                  of_laser = detail::emission_domains<Laser>,
                                  of_both = detail::emission_domains<LightSet<Point, DiskLight<D, double>>>,
                                  of_any = detail::emission_domains<LightSet<Point, Laser>>;
static_assert(of_point.two && !of_point.four && !of_point.others);
static_assert(!of_laser.two && !of_laser.four && of_laser.others); // it declares no domain
static_assert(of_both.two && of_both.four && !of_both.others);
static_assert(of_any.two && !of_any.four && of_any.others);

namespace {

/// A renderer's own lights, to which `domain` means something else.
struct Panel : Laser {
    D domain{1, 2, 0};
};
struct Leased : Laser {
    static constexpr const char* domain = "example.org";
};

} // namespace

static_assert(coordinates_of<Panel> == 0 && detail::emission_domains<Panel>.others);
static_assert(coordinates_of<Leased> == 0 && detail::emission_domains<Leased>.others);
static_assert(of_both.four && !of_both.others && of_any.others);
static_assert(Light<LightSet<Lights, Laser>>); // sets nest

TEST_CASE("light set: a single light emits as if it were alone and draws no sample more") {
    const Point point({.position = {1, 2, 3}, .intensity = 5});
    const Lights set({point});
    check_light_laws(set, 2);
    const auto alone = photon_of(point, 7, 1000), in_set = photon_of(set, 7, 1000);
    CHECK(length(D(alone.direction - in_set.direction)) == 0);
    CHECK(alone.flux == in_set.flux);
    CHECK(set.power() == point.power());
}

TEST_CASE("light set: lights of several kinds add up their fluxes") {
    const BoundingSphere<D> target{{0, 0, 0}, 1};
    const Lights set({Point({.position = {0, 0, 4}, .intensity = 5, .target = target}),
                      DiskLight<D, double>(
                          {.centre = {0, 3, 3}, .normal = {0, -1, -1}, .radius = 1, .radiance = 1, .target = target}),
                      DirectionalLight<D, double>({.direction = {1, 1, -1}, .irradiance = 2, .patch = target})});
    const Mean disk = flux_of(std::get<DiskLight<D, double>>(set.lights()[1]), 50000);
    const double expected =
        std::visit([](const auto& l) { return l.power(); }, set.lights()[0]) + disk.value() + 2 * pi<double>;
    check_same<double>(flux_of(set, 50000), expected, disk.error());
}

// Each light gets its share of the photons, and its footprints are as if it had them for itself.
TEST_CASE("light set: photons are shared by power and their footprints follow") {
    const Point strong({.position = {0, 0, 0}, .intensity = 3}), weak({.position = {1, 0, 0}, .intensity = 1});
    const Lights set({strong, weak});
    check_light_laws(set, 3);
    const std::uint64_t n = 20000;
    double from_strong = 0;
    for (std::uint64_t i = 0; i < n; ++i) {
        const auto photon = photon_of(set, i, double(n), 2);
        const bool is_strong = photon.position.x == 0;
        from_strong += is_strong ? 1 : 0;
        const Spread<double> own{double(n) * (is_strong ? 0.75 : 0.25), 2};
        const auto flux = (is_strong ? strong : weak).power() / own.photons;
        CHECK(photon.flux == doctest::Approx(flux).epsilon(1e-13));
        CHECK(length(photon.differential[0].d_direction) == doctest::Approx(own.length(4 * pi<double>)).epsilon(1e-13));
    }
    CHECK(std::abs(from_strong / double(n) - 0.75) <= 5 * std::sqrt(0.75 * 0.25 / double(n)));
}

TEST_CASE("light set: dark lights alone have their domain too") {
    const LightSet<Point> dark({Point({.position = D(0), .intensity = 0}), Point({.position = D(1), .intensity = 0})});
    GivenSamples given({0.5, 0.25, 0.75});
    RecordingSource recorder(given, 0);
    (void)dark.emit(recorder, Spread<double>{10, 1});
    CHECK(recorder.sample().coordinates == 2);
    CHECK(recorder.sample().at[0] == 0.25);
}

TEST_CASE("light set: a dark light gets no photons and dark lights alone send none with flux") {
    const Point dark({.position = {0, 0, 0}, .intensity = 0}), bright({.position = {1, 0, 0}, .intensity = 1});
    const Lights set({dark, bright, dark});
    for (const double u : {0.0, 0.5, std::nextafter(1.0, 0.0)}) {
        GivenSamples samples({u, 0.5, 0.5});
        CHECK(set.emit(samples, Spread<double>{1, 1}).position.x == 1);
    }
    CHECK(photon_of(Lights({dark, dark}), 3, 10).flux == 0);
}

TEST_CASE("light set: a user's own light takes part") {
    const LightSet<Laser, Point> set({Laser{2}, Point({.position = {0, 0, 0}, .intensity = 1})});
    check_same<double>(flux_of(set, 1000), 2 + 4 * pi<double>);
}

TEST_CASE("light set: no lights and lights of impossible power are refused") {
    CHECK_THROWS_AS(Lights({}), std::invalid_argument);
    CHECK_THROWS_AS(LightSet<Laser>({Laser{-1}}), std::invalid_argument);
    CHECK_THROWS_AS(LightSet<Laser>({Laser{std::nan("")}}), std::invalid_argument);
}

TEST_CASE("light set: lights of three tangents make a set, with extras or without") {
    using Set = LightSet<ColouredSun<D>, PlainSun>;
    static_assert(Light<Set> && emitted_t<Set>::tangent_count == 3);
    static_assert(detail::emission_domains<Set>.two && detail::emission_domains<Set>.others &&
                  !detail::emission_domains<Set>.four);
    const Set set({ColouredSun<D>(), PlainSun()});
    for (const double choice : {0.25, 0.75}) {
        GivenSamples samples({choice, 0.3, 0.4, 0.5});
        RecordingSource recorder(samples, coordinates_of<Set>);
        const auto photon = set.emit(recorder, Spread<double>{1, 1});
        CHECK(photon.differential.size() == 3);
        CHECK(recorder.sample().light == (choice < 0.5 ? 0 : 1));
        CHECK(recorder.sample().coordinates == (choice < 0.5 ? 2 : 0));
        CHECK(recorder.sample().at[0] == (choice < 0.5 ? 0.3 : 0));
        CHECK(samples.drawn() == 4); // the wavelength too
    }
}

} // namespace nephroid::tests::light_set_test
