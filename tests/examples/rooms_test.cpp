// SPDX-License-Identifier: MIT
// The rooms' light against a table that another path tracer made (Cornell's: a light tracer, 10⁸ photons), means over
// whole walls; and the conservation of energy.
#include "common/rooms.hpp"

#include "common/path_tracer/layers.hpp"
#include "common/photon_lights.hpp"
#include "examples/room_points.hpp"
#include "examples/worlds.hpp"

#include "nephroid/emission/light/mesh.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace nephroid::examples::rooms_test {

using namespace nephroid::examples::testing;

namespace {

using Color = Vec3<double>;

/// Floor, x = 0 and z = 0 as pixels 0, 1 and 2.
[[nodiscard]] std::vector<EyeVertex<double, Color>> walls_of_the_cube(int n) {
    std::vector<EyeVertex<double, Color>> vertices;
    add_wall<double, Color>(vertices, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, n, 0);
    add_wall<double, Color>(vertices, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}, n, 1);
    add_wall<double, Color>(vertices, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n, 2);
    return vertices;
}

/// Four standard errors by band. The table's own are a hundredth of these.
void check(const Color& found, const Color& error, const Color& expected, double most_error) {
    for (int band = 0; band < 3; ++band) {
        CAPTURE(band);
        CAPTURE(found[band]);
        CAPTURE(error[band]);
        CAPTURE(expected[band]);
        CHECK(std::abs(found[band] - expected[band]) < 4 * error[band]);
        CHECK(error[band] < most_error * expected[band]);
    }
}

using Walls = std::array<Color, 3>;

void check_indirect(const char* name, int n, std::uint64_t samples, const Walls& expected, double most_error) {
    const auto room = built_in_room<double>(name).value();
    SerialExecutor serial;
    const auto found =
        path_trace_layers(room.scene, room.lamps, walls_of_the_cube(n), 3, {.samples = samples, .seed = 1}, serial);
    for (std::size_t wall = 0; wall < 3; ++wall) {
        CAPTURE(wall);
        check(found.mean[wall].indirect, found.standard_error[wall].indirect, expected[wall], most_error);
    }
}

/// The flux that the lamps send out.
[[nodiscard]] Color emitted(const Lamps<double, Color>& lamps) {
    Color sum(0);
    for (const auto& lamp : lamps.areas)
        sum += pi<double> * detail::SampledAreaLamp<double, Color>(lamp).area() * lamp.radiance;
    return sum;
}

} // namespace

TEST_CASE("rooms: the box's indirect light is that of the table") {
    check_indirect("box", 32, 32,
                   {{{0.22918, 0.18109, 0.12674}, {0.25295, 0.23373, 0.17625}, {0.24049, 0.19170, 0.13640}}}, 0.011);
}

TEST_CASE("rooms: Cornell's indirect light is that of the table") {
    check_indirect("cornell", 32, 48,
                   {{{0.23349, 0.18577, 0.13133}, {0.25071, 0.22995, 0.17290}, {0.23825, 0.18978, 0.13433}}}, 0.02);
}

TEST_CASE("rooms: Cornell's caustic on the floor is that of the table") {
    const auto room = built_in_room<double>("cornell").value();
    std::vector<EyeVertex<double, Color>> floor = walls_of_the_cube(48);
    floor.resize(48 * 48);
    SerialExecutor serial;
    const auto found = path_trace_layers(room.scene, room.lamps, floor, 1, {.samples = 16, .bounces = 0}, serial);
    check(found.mean[0].caustic, found.standard_error[0].caustic, Color(0.05689), 0.1);
    CHECK(found.mean[0].indirect == Color(0));
}

TEST_CASE("rooms: the box's lamp sends a flux of 1 in each band") {
    const Color flux = emitted(built_in_room<double>("box").value().lamps);
    for (int band = 0; band < 3; ++band)
        CHECK(std::abs(flux[band] - 1) < 1e-12);
}

// What a closed room emits its surfaces absorb: ∫ (1 - ρ) E over all of them is the lamps' flux. Glass takes none.
// Points are drawn evenly from the whole mesh, also from faces on which others stand, which are dark.
TEST_CASE("rooms: the table's room absorbs what its lamp emits") {
    const auto room = built_in_room<double>("table").value();
    const auto& mesh = std::get<TriangleMesh<double>>(room.scene.parts()[0].shape);
    AreaLamp<double, Color> everything{{}, Color(0)};
    std::vector<double> area_up_to{0};
    for (std::size_t i = 0; i < mesh.data().triangles.size(); ++i) {
        const auto corners = mesh.corners(i);
        everything.triangles.push_back(corners);
        area_up_to.push_back(area_up_to.back() + 0.5 * length(cross(corners[1] - corners[0], corners[2] - corners[0])));
    }
    const detail::SampledAreaLamp<double, Color> surface(everything);
    Numbers numbers(5);
    std::vector<EyeVertex<double, Color>> vertices;
    constexpr int count = 6000;
    for (int i = 0; i < count; ++i) {
        const double u = (i + numbers(0, 1)) / count;
        const auto point = surface.point(u, numbers(0, 1));
        const auto above = std::upper_bound(area_up_to.begin(), area_up_to.end(), u * area_up_to.back());
        const auto triangle = std::size_t(above - area_up_to.begin()) - 1;
        vertices.push_back(on_wall<double, Color>(point.position, point.normal));
        vertices.back().weight =
            (Color(1) - room.scene.materials()[mesh.material(triangle)].color) * (area_up_to.back() / count);
    }
    SerialExecutor serial;
    const auto found = path_trace_layers(room.scene, room.lamps, vertices, 1, {.samples = 6}, serial);
    // Paths tell the error at these points. That of the points is less: they are stratified.
    const Color error = Color(2) * found.sum_error[0];
    check(found.mean[0].sum(), error, emitted(room.lamps), 0.06);
}

TEST_CASE("rooms: no ray leaves a room") {
    for (const std::string_view name : room_names) {
        const auto room = built_in_room<float>(name).value();
        const auto bounds = room.scene.bounds();
        Numbers numbers(7);
        for (int i = 0; i < 2000; ++i) {
            const Vec3<float> at = Vec3<float>(room.camera.position) + numbers.point<float>(-0.01, 0.01);
            const auto hit = room.scene.intersect(at, numbers.direction<float>(), 0, HUGE_VALF);
            REQUIRE(hit.has_value());
            CHECK(dot(hit->position - at, hit->geometric_normal) < 0); // faces look inwards, blocks' outwards
            CHECK(bounds.contains(hit->position));
        }
    }
}

TEST_CASE("rooms: their lamps become the library's, which send all of their light") {
    for (const std::string_view name : room_names) {
        const auto room = built_in_room<float>(name).value();
        double power = 0;
        for (const auto& lamp : room.lamps.areas)
            power +=
                MeshLight<Vec3<float>, Vec3<float>>({.triangles = lamp.triangles, .radiance = lamp.radiance}).power();
        const double expected = flux_traits<Color>::power(emitted(built_in_room<double>(name).value().lamps));
        CHECK(power == doctest::Approx(expected).epsilon(1e-5));
        CHECK(room.scene.has_specular() == (name != "box"));
    }
    CHECK_FALSE(built_in_room<double>("nowhere").has_value());
    CHECK(names_of_rooms() == "box, cornell, table");
}

} // namespace nephroid::examples::rooms_test
