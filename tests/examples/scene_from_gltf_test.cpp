// SPDX-License-Identifier: MIT
#include "common/scene_from_gltf.hpp"

#include "common/eye_paths.hpp"
#include "common/photon_lights.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

namespace nephroid::examples::scene_from_gltf_test {

namespace {

/// A triangle at a height, of a material.
MeshDescription triangle(float z, std::size_t material, bool smooth = false) {
    MeshDescription mesh;
    mesh.positions = {{-3, -3, z}, {3, -3, z}, {0, 3, z}};
    mesh.triangles = {{0, 1, 2}};
    mesh.material = material;
    if (smooth)
        mesh.normals = {{-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0, 0.6f, 0.8f}};
    return mesh;
}

SceneDescription description() {
    SceneDescription d;
    MaterialDescription matt, glass, metal, lamp, brushed;
    matt.base_color = {0.2f, 0.4f, 0.6f};
    matt.metallic = 0;
    glass.metallic = 0;
    glass.transmission = 1;
    glass.roughness = 0;
    glass.ior = 1.33f;
    glass.has_volume = true;
    glass.attenuation_color = {0.25f, 0.5f, 1};
    glass.attenuation_distance = 2;
    metal.roughness = 0.05f;
    metal.base_color = {1, 0.8f, 0.3f};
    lamp.emission = {5, 6, 7};
    lamp.double_sided = true;
    brushed.name = "brushed";
    d.materials = {matt, glass, metal, lamp, brushed};
    d.meshes = {triangle(0, 0), triangle(1, 1, true), triangle(2, 2), triangle(3, 3), triangle(4, 4)};
    LightDescription sun;
    sun.intensity = {1, 2, 3};
    d.lights = {sun};
    return d;
}

} // namespace

TEST_CASE("scene from gltf: a note says that emitters are shown without their opacity and textures") {
    const auto warnings_with = [](const auto& change) {
        SceneDescription d = description();
        d.materials[4] = d.materials[0];
        d.materials[3].name = "lamp";
        change(d.materials[3]);
        const auto result = scene_from<float>(d);
        return std::count_if(result.warnings.begin(), result.warnings.end(), [](const std::string& line) {
            return line == "material \"lamp\": its opacity and textures are not used, as it emits";
        });
    };
    CHECK(warnings_with([](MaterialDescription&) {}) == 0);
    CHECK(warnings_with([](MaterialDescription& m) { m.coverage = 0.5f; }) == 1);
    CHECK(warnings_with([](MaterialDescription& m) { m.color_texture = TextureReference(); }) == 1);
    CHECK(warnings_with([](MaterialDescription& m) { m.normal_texture = TextureReference(); }) == 1);
}

TEST_CASE_TEMPLATE("scene from gltf: materials become what they are nearest to", T, float, double) {
    const auto g = scene_from<T>(description());
    const auto& m = g.scene.materials();
    REQUIRE(m.size() == 5);
    CHECK(m[0].surface == Surface::diffuse);
    CHECK(m[0].color == Vec3<T>(glm::vec3(0.2f, 0.4f, 0.6f)));
    CHECK(m[1].surface == Surface::dielectric);
    CHECK(m[1].ior == doctest::Approx(1.33));
    CHECK(m[1].fresnel);
    CHECK(m[1].follow == Follow::both);
    CHECK(m[2].surface == Surface::mirror);
    CHECK(m[2].color.z == T(0.3f));
    CHECK(m[3].surface == Surface::black);
    CHECK(m[3].emission == Vec3<T>(5, 6, 7));
    CHECK(m[3].emits_on_both_sides);
    CHECK(m[4].surface == Surface::diffuse);
    REQUIRE(g.warnings.size() == 2);
    CHECK(g.warnings[0].find("of roughness 0.05, shown smooth") != std::string::npos);
    CHECK(g.warnings[1].find("\"brushed\": is rough metal") != std::string::npos);
    // Beer's law leaves the attenuation's colour after its distance.
    Medium inside;
    inside.enter(1);
    const Vec3<T> left = g.scene.transmittance(inside, T(2));
    CHECK(std::abs(left.x - T(0.25)) < T(1e-6));
    CHECK(std::abs(left.y - T(0.5)) < T(1e-6));
    CHECK(left.z == 1);
    CHECK(g.scene.transmittance(Medium{}, T(2)) == Vec3<T>(1));
}

TEST_CASE("scene from gltf: what is shown otherwise than the file says is noted, whatever it is") {
    const auto notes = [](const auto& change) {
        SceneDescription d;
        MaterialDescription m;
        m.name = "m";
        m.metallic = 0;
        m.has_volume = true;
        change(m);
        d.materials = {m};
        d.meshes = {triangle(0, 0)};
        const auto g = scene_from<float>(d);
        std::string all;
        for (const std::string& warning : g.warnings)
            all += warning + '\n';
        return all;
    };
    const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    CHECK(notes([](MaterialDescription&) {}).empty());
    for (const float roughness : {0.01f, 0.2f, 0.39f, 0.8f}) {
        CHECK(has(notes([=](auto& m) { m.transmission = 1, m.roughness = roughness; }), "shown smooth"));
        CHECK(has(notes([=](auto& m) { m.metallic = 1, m.roughness = roughness; }),
                  roughness < 0.4f ? "shown smooth" : "shown diffuse"));
    }
    CHECK(notes([](auto& m) { m.transmission = 1, m.roughness = 0; }).empty());
    CHECK(notes([](auto& m) { m.metallic = 1, m.roughness = 0; }).empty());
    CHECK(has(notes([](auto& m) { m.metallic = 0.7f, m.roughness = 0; }), "metallic by 0.7 only"));
    CHECK(has(notes([](auto& m) { m.roughness = 0.1f; }), "glossy"));
    CHECK(has(notes([](auto& m) { m.transmission = 1, m.roughness = 0, m.metallic = 1; }), "set metallicFactor to 0"));
    CHECK(has(notes([](auto& m) { m.coverage = 0.25f; }), "is there by 0.25 (its opacity)"));
}

// KHR_materials_ior: with an index of 0 Fresnel's reflectance is 1 at every angle.
TEST_CASE("scene from gltf: an index of refraction of 0 is a mirror, with a note") {
    for (const float transmission : {0.0f, 1.0f}) {
        SceneDescription d = description();
        d.materials[1].ior = 0;
        d.materials[1].transmission = transmission;
        const auto g = scene_from<float>(d);
        CHECK(g.scene.materials()[1].surface == Surface::mirror);
        CHECK(g.scene.materials()[1].color == Vec3<float>(1));
        REQUIRE(g.warnings.size() == 3);
        CHECK(g.warnings[0].find("index of refraction of 0") != std::string::npos);
    }
}

TEST_CASE(
    "scene from gltf: what transmits without a volume is a window where it is open and solid where it is closed") {
    SceneDescription d;
    MaterialDescription glass;
    glass.name = "glass";
    glass.metallic = 0;
    glass.roughness = 0;
    glass.transmission = 0.5f;
    d.materials = {glass};
    MeshDescription tetrahedron;
    tetrahedron.name = "drop";
    tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    d.meshes = {triangle(-5, 0), tetrahedron, triangle(5, 0)};
    auto g = scene_from<float>(d);
    const auto surface_at = [&](float z) {
        return g.scene.material(*g.scene.intersect({0.1f, 0.1f, z}, {0, 0, 1}, 0, 2)).surface;
    };
    CHECK(surface_at(-6) == Surface::window);
    CHECK(surface_at(-1) == Surface::dielectric);
    CHECK(surface_at(4) == Surface::window);
    REQUIRE(g.warnings.size() == 2); // one for both windows
    CHECK(g.warnings[0].find("thin window") != std::string::npos);
    CHECK(g.warnings[1].find("\"drop\" of material \"glass\" transmits and has no volume") != std::string::npos);

    d.materials[0].has_volume = true;
    g = scene_from<float>(d);
    CHECK(surface_at(-6) == Surface::dielectric);
    CHECK(g.warnings.empty());
    for (auto& t : d.meshes[1].triangles)
        std::swap(t[0], t[1]);
    g = scene_from<float>(d);
    REQUIRE(g.warnings.size() == 1);
    CHECK(g.warnings[0].find("\"drop\"") != std::string::npos);
    CHECK(g.warnings[0].find("inside out") != std::string::npos);
}

TEST_CASE_TEMPLATE("scene from gltf: triangles keep their materials and their normals", T, float, double) {
    const auto g = scene_from<T>(description());
    T from = T(-1);
    for (std::size_t i = 0; i < 5; ++i) {
        const auto hit = g.scene.intersect({T(0.5), T(-1), from}, {0, 0, 1}, T(0), T(100));
        REQUIRE(hit.has_value());
        CHECK(hit->surface == i);
        CHECK(hit->position.z == T(i));
        CHECK((hit->shading_normal != hit->geometric_normal) == (i == 1));
        from = hit->position.z + T(0.01);
    }
    CHECK(g.scene.has_specular());
    CHECK(g.scene.specular_points().size() == 6);
}

TEST_CASE_TEMPLATE("scene from gltf: lamps are those of the file and what shines in it", T, float, double) {
    const auto g = scene_from<T>(description());
    REQUIRE(g.lamps.lamps.size() == 1);
    CHECK(g.lamps.lamps[0].kind == Lamp<T, Vec3<T>>::Kind::directional);
    CHECK(g.lamps.lamps[0].intensity == Vec3<T>(1, 2, 3));
    REQUIRE(g.lamps.areas.size() == 1);
    CHECK(g.lamps.areas[0].triangles.size() == 2); // both sides
    const auto lights = photon_lights(g.lamps, g.scene);
    REQUIRE(lights.lights().size() == 2);
    CHECK(lights.power() > 0);
    CHECK(scene_from<T>(SceneDescription{}).scene.empty());
    CHECK(scene_from<T>(SceneDescription{}).lamps.empty());
}

TEST_CASE_TEMPLATE("scene from gltf: light of one band is the mean of the three", T, float, double) {
    const auto g = scene_from<T, T>(description());
    CHECK(std::abs(g.scene.materials()[0].color - T(0.4)) < T(1e-6));
    CHECK(std::abs(g.lamps.areas[0].radiance - T(6)) < T(1e-6));
}

TEST_CASE("scene from gltf: cameras see what the file's see") {
    CameraDescription c;
    c.position = {0, 0, 10};
    c.yfov = 0.9f;
    c.aspect = 1.5f;
    CHECK(aspect_of(c) == 1.5);
    const auto camera = camera_from<float>(c, 30, 20);
    const auto top = camera.ray(15, 20);
    CHECK(std::abs(std::atan2(top.direction.y, -top.direction.z) - 0.45f) < 1e-6f);
    c.kind = CameraDescription::Kind::orthographic;
    c.xmag = 4;
    c.ymag = 2;
    CHECK(aspect_of(c) == 2);
    CHECK(std::abs(camera_from<float>(c, 20, 10).ray(20, 10).origin.x - 4) < 1e-6f);
    CHECK(std::abs(camera_from<float>(c, 20, 10).ray(20, 10).origin.y - 2) < 1e-6f);
}

TEST_CASE("scene from gltf: without a camera the whole scene is in view") {
    const auto g = scene_from<float>(description());
    const auto camera = camera_from<float>(camera_for(g.scene.bounds()), 64, 64);
    // All corners of the bounds project into the film: a ray through the film comes near each of them.
    for (int i = 0; i < 8; ++i) {
        const Vec3<float> corner = g.scene.bounds().corner(i);
        float nearest = 1e9f;
        for (int y = 0; y <= 64; ++y)
            for (int x = 0; x <= 64; ++x) {
                const Ray<float> ray = camera.ray(float(x), float(y));
                const Vec3<float> to = corner - ray.origin;
                nearest = std::min(
                    nearest, nephroid::length(Vec3<float>(to - nephroid::dot(to, ray.direction) * ray.direction)));
            }
        CHECK(nearest < 0.3f); // a pixel is about 0.25 wide there
    }
}

} // namespace nephroid::examples::scene_from_gltf_test
