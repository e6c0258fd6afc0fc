// SPDX-License-Identifier: MIT
#include "common/scenes/scenes.hpp"

#include "common/builtin_cases.hpp"
#include "common/photon_lights.hpp"
#include "common/spectral_view.hpp"

#include "nephroid/emission/emit_at.hpp"
#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

namespace nephroid::tests::scenes_test {

namespace {

using namespace nephroid::examples;
using Color = glm::dvec3;

/// Draws one half.
struct Half {
    template <class T>
    T next() {
        return T(0.5);
    }
};

/// The flux of a photon after its first reflection.
struct AfterFirst {
    Color flux{0};
    void flight(const Flight<glm::dvec3, Color, 2>& flight) {
        if (flight.specular_events == 1)
            flux = flight.flux;
    }
};

/// Six times the signed volume, and the sum of the area vectors.
template <class T>
std::pair<double, glm::dvec3> volume_and_area(const MeshData<T>& mesh) {
    double volume = 0;
    glm::dvec3 area(0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = mesh.corners(i);
        volume += dot(glm::dvec3(a), cross(glm::dvec3(b), glm::dvec3(c))) / 6;
        area += 0.5 * cross(glm::dvec3(b - a), glm::dvec3(c - a));
    }
    return {volume, area};
}

} // namespace

// The twin of gold-ring: light at elevation e meets a cylinder's inside at the azimuth φ under cos i = cos e cos φ,
// and the beam has cos φ dφ of it there. Midpoints of 8,000 cells in y are exact to 10⁻⁵ at the ends, where φ is
// steep.
TEST_CASE("gold ring: the first reflection in a cylinder leaves the integral of gold's reflectance") {
    const auto mirror = builtin_case<double, Color>("ring", false).value();
    const Color eta(0.14, 0.43, 1.38), k(3.697, 2.455, 1.914);
    auto materials = mirror.scene.materials();
    for (auto& material : materials)
        if (material.surface == Surface::mirror)
            material = Material<Color>::conductor(eta, k);
    const examples::Scene<double, Color> scene(mirror.scene.parts(), materials);
    const auto& sun = std::get<RingBeam<double, Color>>(mirror.light.lights()[0]);
    constexpr int cells = 8000;
    Color reflected(0), emitted(0);
    double elevation = 0;
    for (int i = 0; i < cells; ++i) {
        const auto photon = emit_at(sun, {(i + 0.5) / cells, 0.5}, {double(cells), 1});
        elevation = std::asin(-photon.direction.z);
        AfterFirst first;
        Statistics account;
        Half half;
        Photon<glm::dvec3, Color> walker = photon;
        (void)walk(scene, std::move(walker), half, {.roulette_after = 1u << 16}, account, first);
        reflected += first.flux;
        emitted += photon.flux;
    }
    constexpr int steps = 4000;
    Color expected(0);
    for (int i = 0; i < steps; ++i) {
        const double phi = std::numbers::pi * ((i + 0.5) / steps - 0.5), c = std::cos(phi);
        for (int band = 0; band < 3; ++band)
            expected[band] +=
                0.5 * c * std::numbers::pi / steps * conductor_reflectance(std::cos(elevation) * c, eta[band], k[band]);
    }
    for (int band = 0; band < 3; ++band)
        CHECK(std::abs(reflected[band] / emitted[band] / expected[band] - 1) < 1e-5);
    // And at normal incidence it is what the metal is known for.
    CHECK(conductor_reflectance(1., eta.x, k.x) == doctest::Approx(0.963).epsilon(1e-3));
    CHECK(conductor_reflectance(1., eta.z, k.z) == doctest::Approx(0.408).epsilon(2e-3));
}

// Deviation by a prism of 60° at the incidence that is least for an index of 1.785: floats, and some 3 per unit of
// angle.
TEST_CASE("prism: each wavelength is turned by what Snell's law says and falls on the screen") {
    const auto room = built_in_scene<float>("prism").value();
    const SpectralColor<16> colors{EqualBands<16>{}};
    const SpectralView<16> view(room.scene, colors);
    const glm::vec3 beam = room.lamps.lamps.at(0).direction;
    const double down = std::atan2(double(beam.y), double(beam.x)), incident = std::asin(1.785 / 2);
    const double least = 2 * incident - std::numbers::pi / 3;
    // The chief ray: through the middle of the first face.
    const double within = down + least / 2;
    const glm::dvec3 along(std::cos(within), std::sin(within), 0), to_base(-along.y, along.x, 0);
    const glm::dvec3 middle(0, 0.9, 0);
    const glm::dvec3 entry = middle - std::sqrt(0.75) / 6 * to_base - 0.25 * along;
    const glm::vec3 zero(0);
    Material<double> flint = Material<double>::dielectric(1.785);
    flint.dispersion = 20 / 25.7;
    for (const double wavelength : {450., 486.13, 587.56, 656.27, 690.}) {
        using P = Wavelength<EqualBands<16>>;
        const ParametricPhoton<glm::vec3, Bands<float, 16>, 3, P> photon{
            glm::vec3(entry - 2. * glm::dvec3(beam)),
            beam,
            Bands<float, 16>(1),
            {Tangent<glm::vec3>{{0, 0, 1}, zero}, {glm::vec3(-beam.y, beam.x, 0), zero}, {zero, zero}},
            P{wavelength, {}}};
        Half half; // above the reflectances: light is refracted
        Statistics account;
        const auto deposit = walk(view, photon, half, {}, account);
        REQUIRE(deposit);
        const double n = flint.index_at(wavelength).value;
        const double turned = incident +
                              std::asin(n * std::sin(std::numbers::pi / 3 - std::asin(std::sin(incident) / n))) -
                              std::numbers::pi / 3;
        const double found = std::atan2(double(deposit->direction.y), double(deposit->direction.x));
        CHECK(std::abs(found - (down + turned)) < 2e-5);
        CHECK(deposit->position.x == doctest::Approx(4).epsilon(1e-4));
        CHECK(length(deposit->d_position[2]) > 1e-4f); // it disperses
    }
}

TEST_CASE("revolved bodies: they are closed, face outwards, and have the volume of a torus and of a ring") {
    MeshData<double> torus;
    add_revolved(torus, circle(0.6, 0.2, 128), 256, 0);
    const auto [volume, area] = volume_and_area(torus);
    // A polygon of m corners lacks 2π²/3m² of a circle's area.
    CHECK(volume == doctest::Approx(2 * square(std::numbers::pi) * 0.6 * 0.04).epsilon(1e-3));
    CHECK(length(area) < 1e-12);
    MeshData<double> ring;
    add_revolved(ring, rounded_rectangle(1, 1.12, 0, 0.5, 0.04, 8), 512, 0);
    const auto [of_ring, none] = volume_and_area(ring);
    const double section = 0.12 * 0.5 - (4 - std::numbers::pi) * square(0.04);
    CHECK(of_ring == doctest::Approx(2 * std::numbers::pi * 1.06 * section).epsilon(1e-3));
    CHECK(length(none) < 1e-12);
    for (const MeshData<double>* mesh : {&torus, &ring})
        for (std::size_t i = 0; i < mesh->triangles.size(); ++i) {
            const auto [a, b, c] = mesh->corners(i);
            for (const std::uint32_t corner : mesh->triangles[i])
                CHECK(dot(cross(b - a, c - a), mesh->normals[corner]) > 0);
        }
}

TEST_CASE("wave field: slopes are the differences of heights and a ray meets the surface where it is") {
    const WaveField waves = examples::detail::pool_waves(2);
    CHECK(waves.steepest() == doctest::Approx(24 * 0.0035 * 2 * std::numbers::pi).epsilon(1e-12));
    double squares = 0, slopes = 0;
    constexpr int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double x = std::fmod(0.6180339887 * i, 1) * 400, y = std::fmod(0.7548776662 * i, 1) * 400, h = 1e-5;
        const WaveField::Relief at = waves.at(x, y);
        squares += square(at.z - 2);
        slopes += square(at.z_x) + square(at.z_y);
        if (i % 100 != 0)
            continue;
        CHECK(std::abs((waves.at(x + h, y).z - waves.at(x - h, y).z) / (2 * h) - at.z_x) < 1e-8);
        CHECK(std::abs((waves.at(x + h, y).z_x - waves.at(x - h, y).z_x) / (2 * h) - at.z_xx) < 1e-6);
        CHECK(std::abs((waves.at(x, y + h).z_x - waves.at(x, y - h).z_x) / (2 * h) - at.z_xy) < 1e-6);
        for (const glm::dvec3& slant : {glm::dvec3(0.3, -0.4, -1), glm::dvec3(3, 2, -0.4), glm::dvec3(1, 0, 0.2)}) {
            const glm::dvec3 direction = normalize(slant), origin = glm::dvec3(x, y, at.z) - 1.7 * direction;
            const bool from_below = slant.z > 0;
            const auto t = waves.crossing(origin, direction, 0, 10);
            REQUIRE(t);
            CHECK(*t <= 1.7 + 1e-9); // flat rays may meet a wave before
            const glm::dvec3 p = origin + *t * direction;
            CHECK(std::abs(p.z - waves.at(p.x, p.y).z) < 1e-12);
            CHECK((origin.z > waves.at(origin.x, origin.y).z) != from_below);
        }
    }
    CHECK(std::sqrt(squares / n) == doctest::Approx(0.0158).epsilon(0.02));
    CHECK(std::sqrt(slopes / n) == doctest::Approx(0.0762).epsilon(0.02));
}

TEST_CASE("scenes: each has lamps that shine on its mirrors or glass") {
    for (const std::string_view name : scene_names) {
        CAPTURE(name);
        CHECK(is_scene(name));
        const auto room = built_in_scene<float>(name).value();
        CHECK(room.scene.has_specular());
        CHECK(photon_lights(room.lamps, room.scene).power() > 0);
    }
    CHECK(!built_in_scene<float>("nowhere"));
    CHECK(names_of_scenes() == "gold-ring, prism, embedded-torus, swimming-pool");
}

} // namespace nephroid::tests::scenes_test
