// SPDX-License-Identifier: MIT
#include "common/caustics/assume.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace nephroid::examples::assume_test {

namespace {

/// A square of half-size h at height y.
MeshDescription square(float h, float y, std::size_t material) {
    MeshDescription mesh;
    mesh.positions = {{-h, y, -h}, {-h, y, h}, {h, y, h}, {h, y, -h}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.material = material;
    return mesh;
}

/// Material 0 is glass, 1 matt, 2 shines.
SceneDescription with(std::vector<MeshDescription> meshes) {
    SceneDescription scene;
    MaterialDescription glass, matt, lamp;
    glass.metallic = matt.metallic = 0;
    glass.transmission = 1;
    lamp.emission = {1, 1, 1};
    scene.materials = {glass, matt, lamp};
    scene.meshes = std::move(meshes);
    return scene;
}

bool says(const Additions& additions, const char* part) {
    for (const std::string& sentence : additions.assumed)
        if (sentence.find(part) != std::string::npos)
            return true;
    return false;
}

} // namespace

TEST_CASE("assume: a file of glass alone gets a sun and a ground, and both are told") {
    SceneDescription scene = with({square(1, 0, 0), square(1, 2, 0)});
    const Additions additions = add_sun_and_ground(scene, Options{});
    REQUIRE(additions.assumed.size() == 2);
    CHECK(says(additions, "assumed --ground 0.8"));
    CHECK(says(additions, "assumed --sun -0.5,-1,0.35"));
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].kind == LightDescription::Kind::directional);
    CHECK(std::abs(glm::length(scene.lights[0].direction) - 1) < 1e-6f);
    REQUIRE(scene.meshes.size() == 3);
    REQUIRE(additions.ground_level.has_value());
    // Just below the lowest point: by a ten-thousandth of the size, sqrt(12).
    CHECK(*additions.ground_level < 0);
    CHECK(*additions.ground_level > -4e-4f);
    const MeshDescription& ground = scene.meshes[2];
    CHECK(scene.materials[ground.material].base_color == glm::vec3(0.8f));
    const glm::vec3 up =
        glm::cross(ground.positions[1] - ground.positions[0], ground.positions[2] - ground.positions[0]);
    CHECK(up.y > 0);
}

TEST_CASE("assume: what a file has is left alone") {
    const auto added = [](SceneDescription scene) {
        const Additions additions = add_sun_and_ground(scene, Options{});
        return additions;
    };
    SceneDescription lit = with({square(1, 1, 0), square(3, 0, 1)});
    lit.lights.push_back({});
    CHECK(added(lit).assumed.empty());
    // A lamp under the water, and a ceiling: light from the file itself says where it wants to go.
    SceneDescription below = with({square(1, 0, 0), square(3, 2, 1)});
    below.lights.push_back({});
    CHECK(added(below).assumed.empty());
    CHECK(added(with({square(1, 1, 0), square(3, 0, 1), square(1, 5, 2)})).assumed.empty());
    const Additions unlit = added(with({square(1, 1, 0), square(3, 0, 1)}));
    CHECK(unlit.assumed.size() == 1);
    CHECK(says(unlit, "--sun"));
    CHECK_FALSE(unlit.ground_level.has_value());
    // Something diffuse that is not below, in a file without lamps.
    CHECK(says(added(with({square(1, 1, 0), square(0.2f, 0, 1)})), "--ground"));
    CHECK(says(added(with({square(1, 1, 0), square(3, 2, 1)})), "--ground"));
    CHECK(added(SceneDescription{}).assumed.empty());
}

TEST_CASE("assume: what is asked for is added, whatever the file has, and not told") {
    SceneDescription scene = with({square(1, 1, 0), square(3, 0, 1)});
    scene.lights.push_back({});
    Options options;
    options.sun = Sun{{0, -2, 0}, 0.5};
    options.ground = 0.25;
    const Additions additions = add_sun_and_ground(scene, options);
    CHECK(additions.assumed.empty());
    REQUIRE(scene.lights.size() == 2);
    CHECK(scene.lights[1].direction == glm::vec3(0, -1, 0));
    CHECK(double(scene.lights[1].angular_diameter) == doctest::Approx(0.5 * std::numbers::pi / 180));
    CHECK(scene.materials.back().base_color == glm::vec3(0.25f));

    SceneDescription surrounded = with({square(1, 1, 0), square(3, 0, 1)});
    Options environment;
    environment.environment = "constant";
    CHECK(add_sun_and_ground(surrounded, environment).assumed.empty());
    CHECK(surrounded.lights.empty());
}

TEST_CASE("assume: the camera is to show what is specular and where its light falls on the ground") {
    SceneDescription scene = with({square(1, 0, 0), square(1, 2, 0), square(100, -1, 1)});
    Options options;
    options.sun = Sun{{1, -1, 0}, 0};
    options.ground = 0.5;
    const Additions additions = add_sun_and_ground(scene, options);
    const auto points = points_of_interest(scene, additions);
    REQUIRE(points.size() == 2);
    // The upper sheet's far edge, x = 1, throws its shadow at x = 3; a tenth of the width is margin.
    CHECK(points[1].x == doctest::Approx(3.4f).epsilon(0.01));
    CHECK(points[0].x == doctest::Approx(-1.4f).epsilon(0.01));
    CHECK(points[1].z == doctest::Approx(1.2f).epsilon(0.01));
}

} // namespace nephroid::examples::assume_test
