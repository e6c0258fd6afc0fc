// SPDX-License-Identifier: MIT
#include "common/gltf.hpp"
#include "support/gltf_reading.hpp"
#include "support/gltf_writer.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

namespace nephroid::examples::gltf_test {

namespace {

using nephroid::examples::CameraDescription;
using nephroid::examples::LightDescription;
using nephroid::examples::MaterialDescription;
using nephroid::examples::MeshDescription;
using namespace nephroid::tests;

double distance(const glm::vec3& a, const glm::vec3& b) { return double{glm::distance(a, b)}; }

constexpr double few_roundings = 1e-6; // of numbers about 1, in float

/// Six times the enclosed volume is the sum of the corners' determinants; positive where the front is outside.
double volume(const MeshDescription& mesh) {
    double sum = 0;
    for (const auto& t : mesh.triangles)
        sum += double{glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]]))};
    return sum / 6;
}

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

} // namespace

// Geometry ------------------------------------------------------------------------------------------------------------

TEST_CASE("glTF: a mesh keeps its positions, normals and triangles") {
    const TestMesh sphere = uv_sphere(2);
    const SceneDescription scene = parse(file_with(sphere));
    REQUIRE(scene.meshes.size() == 1);
    const MeshDescription& mesh = scene.meshes[0];
    CHECK(mesh.positions == sphere.positions);
    REQUIRE(mesh.normals.size() == sphere.normals.size());
    for (std::size_t i = 0; i < mesh.normals.size(); ++i)
        CHECK(distance(mesh.normals[i], sphere.normals[i]) < few_roundings);
    CHECK(mesh.triangles.size() == sphere.indices.size() / 3);
    CHECK(mesh.name == "shape");
    CHECK(scene.warnings.empty());
}

TEST_CASE_TEMPLATE("glTF: indices may have any unsigned type", Index, std::uint8_t, std::uint16_t, std::uint32_t) {
    GltfFile file;
    file.add_vectors(four_points);
    file.add_indices(std::vector<Index>{3, 1, 2, 0, 2, 1});
    file.add_mesh(R"({"attributes":{"POSITION":0},"indices":1})");
    file.add_node(R"({"mesh":0})");
    const SceneDescription scene = parse(file);
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.meshes[0].triangles == Triangles{{3, 1, 2}, {0, 2, 1}});
    CHECK(scene.meshes[0].normals.empty());
}

TEST_CASE("glTF: without indices the vertices are taken in their order") {
    const SceneDescription scene = parse(file_with_primitive({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.meshes[0].triangles == Triangles{{0, 1, 2}});
}

// In a strip every second triangle turns, so that all face the same way; a fan is about its first vertex.
TEST_CASE("glTF: strips and fans become triangles that face as their first one does") {
    const std::vector<glm::vec3> strip{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}};
    const std::vector<glm::vec3> fan{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}};
    for (const int mode : {5, 6}) {
        const auto scene = parse(file_with_primitive(mode == 5 ? strip : fan, ",\"mode\":" + std::to_string(mode)));
        REQUIRE(scene.meshes.size() == 1);
        const MeshDescription& mesh = scene.meshes[0];
        REQUIRE(mesh.triangles.size() == 3);
        for (const auto& t : mesh.triangles)
            CHECK(
                glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]).z >
                0);
    }
}

TEST_CASE("glTF: points and lines are left out with a warning") {
    for (const int mode : {0, 1, 2, 3}) {
        const auto scene = parse(file_with_primitive(four_points, ",\"mode\":" + std::to_string(mode)));
        CHECK(scene.meshes.empty());
        CHECK(warns(scene, "points or lines"));
    }
}

TEST_CASE("glTF: interleaved attributes are read with their stride") {
    GltfFile file;
    std::vector<glm::vec3> both;
    for (const glm::vec3& p : four_points) {
        both.push_back(p);
        both.emplace_back(0, 0, 2);
    }
    const std::size_t view = file.add_view(GltfFile::bytes_of(both), R"(,"byteStride":24)");
    file.add_accessor(view, 5126, 4, "VEC3");
    file.add_accessor(view, 5126, 4, "VEC3", R"(,"byteOffset":12)");
    file.add_mesh(R"({"attributes":{"POSITION":0,"NORMAL":1},"mode":5})");
    file.add_node(R"({"mesh":0})");
    const SceneDescription scene = parse(file);
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.meshes[0].positions == four_points);
    CHECK(scene.meshes[0].normals == std::vector<glm::vec3>(4, glm::vec3(0, 0, 1)));
}

// KHR_mesh_quantization: integers are taken as they are, or as f = max(c / 127, -1) and c / 65535 if normalized.
TEST_CASE("glTF: quantized attributes are converted") {
    GltfFile file;
    const std::vector<std::int16_t> shorts{-300, 0, 7, 0, 300, 0, 0, 0, 1, 0, 0, 0}; // the fourth of each is padding
    const std::vector<std::int8_t> bytes{-128, 0, 0, 0, 0, 127, 0, 0, 0, 0, -127, 0};
    const std::vector<std::uint16_t> normalized{65535, 0, 0, 0, 0, 65535, 0, 0, 0, 0, 13107, 0};
    file.add_accessor(file.add_view(GltfFile::bytes_of(shorts), R"(,"byteStride":8)"), 5122, 3, "VEC3");
    file.add_accessor(file.add_view(GltfFile::bytes_of(bytes), R"(,"byteStride":4)"), 5120, 3, "VEC3",
                      R"(,"normalized":true)");
    file.add_accessor(file.add_view(GltfFile::bytes_of(normalized), R"(,"byteStride":8)"), 5123, 3, "VEC3",
                      R"(,"normalized":true)");
    file.add_mesh(R"({"attributes":{"POSITION":0,"NORMAL":1}},{"attributes":{"POSITION":2}})");
    file.add_node(R"({"mesh":0})");
    file.more = R"(,"extensionsRequired":["KHR_mesh_quantization"])";
    const SceneDescription scene = parse(file);
    REQUIRE(scene.meshes.size() == 2);
    // The third short is (1, 0, 0) by its stride of four.
    CHECK(scene.meshes[0].positions == std::vector<glm::vec3>{{-300, 0, 7}, {300, 0, 0}, {1, 0, 0}});
    CHECK(scene.meshes[0].normals == std::vector<glm::vec3>{{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}});
    CHECK(scene.meshes[1].positions == std::vector<glm::vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 0.2f}});
}

TEST_CASE("glTF: a sparse accessor replaces elements of its base, or of zeros") {
    for (const bool base : {true, false}) {
        GltfFile file;
        const std::size_t points = file.add_view(GltfFile::bytes_of(four_points));
        const std::size_t places = file.add_view(GltfFile::bytes_of(std::vector<std::uint16_t>{1, 3}));
        const std::size_t values = file.add_view(GltfFile::bytes_of(std::vector<glm::vec3>{{5, 0, 0}, {0, 6, 1}}));
        file.accessors.push_back((base ? R"({"bufferView":)" + std::to_string(points) + "," : std::string("{")) +
                                 R"("componentType":5126,"count":4,"type":"VEC3","sparse":{"count":2,)" +
                                 R"("indices":{"bufferView":)" + std::to_string(places) +
                                 R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) + "}}}");
        file.add_mesh(R"({"attributes":{"POSITION":0},"mode":5})");
        file.add_node(R"({"mesh":0})");
        const SceneDescription scene = parse(file);
        REQUIRE(scene.meshes.size() == 1);
        const glm::vec3 third = base ? four_points[2] : glm::vec3(0);
        CHECK(scene.meshes[0].positions == std::vector<glm::vec3>{{0, 0, 0}, {5, 0, 0}, third, {0, 6, 1}});
    }
}

TEST_CASE("glTF: triangles without area are dropped") {
    GltfFile file;
    file.add_vectors({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}});
    file.add_indices(std::vector<std::uint8_t>{0, 1, 2, 1, 1, 3, 0, 1, 3});
    file.add_mesh(R"({"attributes":{"POSITION":0},"indices":1})");
    file.add_node(R"({"mesh":0})");
    const SceneDescription scene = parse(file);
    REQUIRE(scene.meshes.size() == 1);
    CHECK(scene.meshes[0].triangles == Triangles{{0, 1, 3}});

    file.nodes[0] = R"({"mesh":0,"scale":[1,0,1]})";
    const SceneDescription flattened = parse(file);
    CHECK(flattened.meshes.empty());
    CHECK(warns(flattened, "no triangle with an area"));
}

TEST_CASE("glTF: normals of length zero are replaced by those of the triangles around") {
    TestMesh sphere = uv_sphere(1, 64, 32);
    const TestMesh exact = sphere;
    sphere.normals[100] = sphere.normals[500] = glm::vec3(0);
    const SceneDescription scene = parse(file_with(sphere));
    REQUIRE(scene.meshes.size() == 1);
    CHECK(distance(scene.meshes[0].normals[100], exact.normals[100]) < 0.1); // the facets' size
    CHECK(distance(scene.meshes[0].normals[500], exact.normals[500]) < 0.1);
    CHECK(warns(scene, "2 normals of length zero"));
}

// Nodes ---------------------------------------------------------------------------------------------------------------

// A quarter turn about z takes x to y and y to -x. Inside out: scale, turn, move; then the parent's.
TEST_CASE("glTF: nested transforms apply from the inside to the outside") {
    GltfFile file = file_with_primitive({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
    const double half = std::sqrt(0.5);
    file.nodes[0] =
        R"({"mesh":0,"translation":[10,0,0],"scale":[2,3,4],"rotation":)" + json_array({0, 0, half, half}) + "}";
    file.add_node(R"({"children":[0],"matrix":)" + json_array({1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 100, 0, 1}) +
                  "}");
    file.roots = {1};
    const SceneDescription scene = parse(file);
    REQUIRE(scene.meshes.size() == 1);
    // Inner: (10, 2, 0), (7, 0, 0), (10, 0, 4). The parent takes y to z, z to -y, and moves by 100 along y.
    const std::vector<glm::vec3> expected{{10, 100, 2}, {7, 100, 0}, {10, 96, 0}};
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(distance(scene.meshes[0].positions[i] + glm::vec3(scene.origin), expected[i]) < 100 * few_roundings);
}

// The normal of an ellipsoid with the half axes a, b, c is along (x / a^2, y / b^2, z / c^2).
TEST_CASE("glTF: normals stay at right angles to a surface that is stretched, and outside of one that is mirrored") {
    for (const double sign : {1.0, -1.0}) {
        const TestMesh sphere = uv_sphere(1);
        const SceneDescription scene = parse(file_with(sphere, R"(,"scale":)" + json_array({sign * 2, 0.5, 3})));
        REQUIRE(scene.meshes.size() == 1);
        const MeshDescription& mesh = scene.meshes[0];
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::vec3 normal = glm::normalize(mesh.positions[i] / glm::vec3(4, 0.25f, 9));
            CHECK(distance(mesh.normals[i], normal) < 4 * few_roundings);
        }
        const double whole = 4.0 / 3 * std::numbers::pi * 3;
        CHECK(volume(mesh) > 0.97 * whole); // positive: the front is still outside
        CHECK(volume(mesh) < whole);
    }
}

TEST_CASE("glTF: each node that shows a mesh makes a copy, named by the node") {
    GltfFile file = file_with(horizontal_square(1), R"(,"name":"left")");
    file.add_node(R"({"mesh":0,"name":"right","translation":[5,0,0]})");
    const SceneDescription scene = parse(file);
    REQUIRE(scene.meshes.size() == 2);
    CHECK(scene.meshes[0].name == "left");
    CHECK(scene.meshes[1].name == "right");
    CHECK(scene.meshes[1].positions[0] - scene.meshes[0].positions[0] == glm::vec3(5, 0, 0));
}

TEST_CASE("glTF: the default scene is read, or else the first, or else every root") {
    GltfFile file = file_with(horizontal_square(1), R"(,"name":"a")");
    file.add_node(R"({"mesh":0,"name":"b"})");
    file.scenes = R"([{"nodes":[0]},{"nodes":[1]}],"scene":1)";
    CHECK(parse(file).meshes.at(0).name == "b");
    file.scenes = R"([{"nodes":[0]},{"nodes":[1]}])";
    CHECK(parse(file).meshes.at(0).name == "a");
    CHECK(parse(file).meshes.size() == 1);
    file.scenes = "[]";
    CHECK(parse(file).meshes.size() == 2);
}

TEST_CASE("glTF: nodes nested very deep are walked") {
    GltfFile file = file_with(horizontal_square(1));
    constexpr std::size_t depth = 50000;
    for (std::size_t i = 0; i < depth; ++i)
        file.add_node(R"({"translation":[1,0,0],"children":[)" + std::to_string(i) + "]}");
    file.roots = {depth};
    const SceneDescription scene = parse(file);
    CHECK(double(scene.meshes.at(0).positions.at(0).x) + scene.origin.x == double(depth) - 1);
}

// Materials, lights, cameras ------------------------------------------------------------------------------------------

TEST_CASE("glTF: a material has its factors, and those of the extensions for glass and for light") {
    GltfFile file;
    file.materials = {R"({"name":"everything","doubleSided":true,"emissiveFactor":[1,0.5,0],
        "pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1],"metallicFactor":0.25,"roughnessFactor":0.75},
        "extensions":{"KHR_materials_transmission":{"transmissionFactor":0.875},"KHR_materials_ior":{"ior":1.33},
        "KHR_materials_volume":{"thicknessFactor":1,"attenuationColor":[0.5,1,0.25],"attenuationDistance":2.5},
        "KHR_materials_dispersion":{"dispersion":0.5},
        "KHR_materials_emissive_strength":{"emissiveStrength":20}}})",
                      "{}"};
    const SceneDescription scene = parse(file);
    REQUIRE(scene.materials.size() == 2);
    const MaterialDescription& material = scene.materials[0];
    CHECK(material.name == "everything");
    CHECK(material.base_color == glm::vec3(0.1f, 0.2f, 0.3f));
    CHECK(material.metallic == 0.25f);
    CHECK(material.roughness == 0.75f);
    CHECK(material.transmission == 0.875f);
    CHECK(material.ior == 1.33f);
    CHECK(material.dispersion == 0.5f);
    CHECK(material.has_volume);
    CHECK(material.attenuation_color == glm::vec3(0.5f, 1, 0.25f));
    CHECK(material.attenuation_distance == 2.5f);
    CHECK(material.emission == glm::vec3(20, 10, 0));
    CHECK(material.double_sided);

    const MaterialDescription& empty = scene.materials[1];
    CHECK(empty.base_color == glm::vec3(1));
    CHECK(empty.metallic == 1);
    CHECK(empty.roughness == 1);
    CHECK(empty.transmission == 0);
    CHECK(empty.ior == 1.5f);
    CHECK(empty.dispersion == 0);
    CHECK_FALSE(empty.has_volume);
    CHECK(std::isinf(empty.attenuation_distance));
    CHECK(empty.emission == glm::vec3(0));
    CHECK_FALSE(empty.double_sided);
    CHECK(scene.warnings.empty());
}

TEST_CASE("glTF: a negative dispersion is taken as none and warned of") {
    GltfFile file;
    file.materials = {R"({"extensions":{"KHR_materials_dispersion":{"dispersion":-1}}})"};
    const SceneDescription scene = parse(file);
    CHECK(scene.materials.at(0).dispersion == 0);
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0].find("negative dispersion") != std::string::npos);
}

TEST_CASE("glTF: a primitive without a material gets the default one, at the end of the list") {
    GltfFile file = file_with(horizontal_square(1));
    file.materials = {R"({"name":"unused"})"};
    const SceneDescription scene = parse(file);
    REQUIRE(scene.materials.size() == 2);
    CHECK(scene.meshes.at(0).material == 1);
    CHECK(scene.materials[1].name == "default");
}

TEST_CASE("glTF: a material that has no meaning is refused, one that is nearly right is repaired") {
    const auto with = [](const std::string& extension) {
        GltfFile file;
        file.materials = {R"({"name":"m","extensions":{)" + extension + "}}"};
        return file;
    };
    check_problem(problem_of(with(R"("KHR_materials_ior":{"ior":0.5})")), "ior");
    check_problem(problem_of(with(R"("KHR_materials_ior":{"ior":"glass"})")), "not a number");
    check_problem(problem_of(with(R"("KHR_materials_ior":{"ior":1e300})")), "not finite in float");
    check_problem(problem_of(with(R"("KHR_materials_volume":{"attenuationColor":[1,1]})")), "three numbers");
    check_problem(problem_of(with(R"("KHR_materials_emissive_strength":{"emissiveStrength":-1},"a":{}},
        "emissiveFactor":[1,1,1],"b":{)")),
                  "negative emission");
    CHECK(parse(with(R"("KHR_materials_ior":{"ior":0})")).materials.at(0).ior == 0);

    const auto clamped = parse(with(R"("KHR_materials_transmission":{"transmissionFactor":1.0001})"));
    CHECK(clamped.materials.at(0).transmission == 1);
    CHECK(warns(clamped, "transmissionFactor outside of 0 to 1"));
    const auto endless = parse(with(R"("KHR_materials_volume":{"attenuationDistance":0})"));
    CHECK(std::isinf(endless.materials.at(0).attenuation_distance));
    CHECK(warns(endless, "attenuationDistance"));
}

TEST_CASE("glTF: lights stand and shine as their nodes do, whatever the scale") {
    GltfFile file;
    file.lights = {R"({"type":"directional","name":"sun","color":[1,0.5,0],"intensity":4})",
                   R"({"type":"point","intensity":2,"range":8})",
                   R"({"type":"spot","spot":{"innerConeAngle":0.25,"outerConeAngle":0.5}})",
                   R"({"type":"spot","spot":{"innerConeAngle":0.5,"outerConeAngle":0.5}})"};
    const double half = std::sqrt(0.5);
    for (int i = 0; i < 4; ++i) // a quarter turn about x takes -z to y
        file.add_node(R"({"name":"lamp","translation":[1,2,3],"scale":[7,7,7],"rotation":)" +
                      json_array({half, 0, 0, half}) + R"(,"extensions":{"KHR_lights_punctual":{"light":)" +
                      std::to_string(i) + "}}}");
    const SceneDescription scene = parse(file);
    REQUIRE(scene.lights.size() == 4);
    CHECK(scene.lights[0].kind == LightDescription::Kind::directional);
    CHECK(scene.lights[0].name == "sun");
    CHECK(scene.lights[0].intensity == glm::vec3(4, 2, 0));
    CHECK(distance(scene.lights[0].direction, {0, 1, 0}) < few_roundings);
    CHECK(scene.lights[1].kind == LightDescription::Kind::point);
    CHECK(scene.lights[1].name == "lamp");
    CHECK(scene.lights[1].position == glm::vec3(1, 2, 3));
    CHECK(scene.lights[1].intensity == glm::vec3(2));
    CHECK(scene.lights[1].range == 8);
    CHECK(scene.lights[2].kind == LightDescription::Kind::spot);
    CHECK(scene.lights[2].intensity == glm::vec3(1));
    CHECK(scene.lights[2].cos_inner == float(std::cos(0.25)));
    CHECK(scene.lights[2].cos_outer == float(std::cos(0.5)));
    CHECK(std::isinf(scene.lights[2].range));
    CHECK(scene.lights[3].cos_outer < scene.lights[3].cos_inner); // equal angles: the edge is made a hair soft
}

TEST_CASE("glTF: lights and cameras that have no meaning are refused") {
    GltfFile file;
    const auto light = [&file](const std::string& json) {
        file.lights = {json};
        file.nodes = {R"({"extensions":{"KHR_lights_punctual":{"light":0}}})"};
        return problem_of(file);
    };
    check_problem(light(R"({"type":"moon"})"), "type \"moon\"");
    check_problem(light(R"({"type":"point","intensity":-1})"), "negative intensity");
    check_problem(light(R"({"type":"point","color":[1,1]})"), "color of 2 numbers");
    check_problem(light(R"({"type":"spot"})"), "Spot light");
    check_problem(light(R"({"type":"spot","spot":{"innerConeAngle":1,"outerConeAngle":0.5}})"), "cone angle");
    check_problem(light(R"({"type":"spot","spot":{"outerConeAngle":2}})"), "cone angle");
    file.nodes = {R"({"extensions":{"KHR_lights_punctual":{"light":1}}})"};
    check_problem(problem_of(file), "light 1, but the file has 1");
    file.lights = {R"({"type":"directional"})"};
    file.nodes = {R"({"scale":[0,0,0],"extensions":{"KHR_lights_punctual":{"light":0}}})"};
    check_problem(problem_of(file), "without a direction");

    const auto camera = [](const std::string& json) {
        GltfFile with_camera;
        with_camera.cameras = {json};
        with_camera.nodes = {R"({"camera":0})"};
        return problem_of(with_camera);
    };
    check_problem(camera(R"({"type":"perspective","perspective":{"yfov":4,"znear":1}})"), "yfov");
    check_problem(camera(R"({"type":"perspective","perspective":{"yfov":0,"znear":1}})"), "yfov");
    check_problem(camera(R"({"type":"orthographic","orthographic":{"xmag":0,"ymag":1,"zfar":2,"znear":1}})"), "size");
    check_problem(camera(R"({"type":"pinhole"})"), "camera type");
}

// Turned by a quarter about y, the camera looks along -x, with -z to its right.
TEST_CASE("glTF: cameras have orthonormal axes, and the lens of the file") {
    GltfFile file;
    file.cameras = {
        R"({"type":"perspective","perspective":{"yfov":0.5,"znear":1}})",
        R"({"type":"perspective","name":"wide","perspective":{"yfov":0.5,"aspectRatio":2,"znear":1}})",
        R"({"type":"orthographic","orthographic":{"xmag":3,"ymag":2,"zfar":100,"znear":1}})",
    };
    const double half = std::sqrt(0.5);
    for (int i = 0; i < 3; ++i)
        file.add_node(R"({"name":"eye","camera":)" + std::to_string(i) +
                      R"(,"translation":[1,2,3],"scale":[2,5,0.5],"rotation":)" + json_array({0, half, 0, half}) + "}");
    const SceneDescription scene = parse(file);
    REQUIRE(scene.cameras.size() == 3);
    for (const CameraDescription& camera : scene.cameras) {
        CHECK(camera.position == glm::vec3(1, 2, 3));
        CHECK(distance(camera.forward, {-1, 0, 0}) < few_roundings);
        CHECK(distance(camera.up, {0, 1, 0}) < few_roundings);
        CHECK(distance(camera.right, {0, 0, -1}) < few_roundings);
    }
    CHECK(scene.cameras[0].kind == CameraDescription::Kind::perspective);
    CHECK(scene.cameras[0].name == "eye");
    CHECK(scene.cameras[0].yfov == 0.5f);
    CHECK_FALSE(scene.cameras[0].aspect.has_value());
    CHECK(scene.cameras[1].name == "wide");
    CHECK(scene.cameras[1].aspect == 2);
    CHECK(scene.cameras[2].kind == CameraDescription::Kind::orthographic);
    CHECK(scene.cameras[2].xmag == 3);
    CHECK(scene.cameras[2].ymag == 2);
}

TEST_CASE("glTF: the caustic scene of the tests is what its description says") {
    const SceneDescription sun = parse(caustic_scene());
    REQUIRE(sun.meshes.size() == 2);
    CHECK(sun.materials.at(sun.meshes[1].material).transmission == 1);
    CHECK(sun.materials.at(sun.meshes[1].material).has_volume);
    CHECK(sun.materials.at(sun.meshes[0].material).metallic == 0);
    REQUIRE(sun.lights.size() == 1);
    CHECK(distance(sun.lights[0].direction, {0, -1, 0}) < few_roundings);
    CHECK(sun.lights[0].intensity == glm::vec3(3));
    for (const glm::vec3& p : sun.meshes[1].positions)
        CHECK(distance(p, {0, 1, 0}) == doctest::Approx(0.5).epsilon(few_roundings));
    CHECK(volume(sun.meshes[1]) > 0);
    REQUIRE(sun.cameras.size() == 1);
    CHECK(distance(sun.cameras[0].forward, glm::normalize(glm::vec3(0, -2, -5))) < few_roundings);

    const SceneDescription quad = parse(caustic_scene(TestLight::quad, TestSphere::mirror));
    REQUIRE(quad.meshes.size() == 3);
    CHECK(quad.lights.empty());
    CHECK(quad.materials.at(quad.meshes[1].material).roughness == 0);
    CHECK(quad.materials.at(quad.meshes[2].material).emission == glm::vec3(40));
    CHECK(distance(quad.meshes[2].normals.at(0), {0, -1, 0}) < few_roundings);
    CHECK(parse(caustic_scene(TestLight::none, TestSphere::diffuse)).lights.empty());
}

} // namespace nephroid::examples::gltf_test
