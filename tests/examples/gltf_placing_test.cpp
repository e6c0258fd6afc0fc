// SPDX-License-Identifier: MIT
#include "common/gltf/enclosure.hpp"
#include "support/gltf_reading.hpp"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace nephroid::examples::gltf_placing_test {

namespace {

using nephroid::examples::MeshDescription;
using nephroid::examples::gltf::enclosure_of;
using namespace nephroid::tests;

constexpr double few_roundings = 1e-6; // of numbers about 1, in float

/// A square shown with EXT_mesh_gpu_instancing by attributes that are already accessors, as JSON.
GltfFile instanced(GltfFile file, const std::string& attributes) {
    file.add_node(R"({"mesh":0,"translation":[0,10,0],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{)" +
                  attributes + "}}}}");
    file.more = R"(,"extensionsUsed":["EXT_mesh_gpu_instancing"],"extensionsRequired":["EXT_mesh_gpu_instancing"])";
    return file;
}

} // namespace

// Instances -----------------------------------------------------------------------------------------------------------

// A half turn about y takes x to -x; the node then moves all by (0, 10, 0).
TEST_CASE("glTF: an instanced mesh is shown once at each place") {
    GltfFile file;
    add_mesh(file, horizontal_square(1), "square");
    const std::size_t places = file.add_vectors({{5, 0, 0}, {0, 0, 7}});
    const std::size_t turns = file.add_accessor(
        file.add_view(GltfFile::bytes_of(std::vector<float>{0, 1, 0, 0, 0, 0, 0, 1})), 5126, 2, "VEC4");
    const std::size_t sizes = file.add_vectors({{2, 1, 1}, {1, 1, 3}});
    const auto scene = parse(instanced(file, R"("TRANSLATION":)" + std::to_string(places) + R"(,"ROTATION":)" +
                                                 std::to_string(turns) + R"(,"SCALE":)" + std::to_string(sizes)));
    REQUIRE(scene.meshes.size() == 2);
    CHECK(scene.warnings.empty());
    // The square's first corner is (-1, 0, -1).
    CHECK(double(glm::distance(scene.meshes[0].positions[0], glm::vec3(5 + 2, 10, 1))) < 10 * few_roundings);
    CHECK(double(glm::distance(scene.meshes[1].positions[0], glm::vec3(-1, 10, 7 - 3))) < 10 * few_roundings);
}

TEST_CASE("glTF: turns of instances may be quantized, and what is missing is left as it is") {
    GltfFile file;
    add_mesh(file, horizontal_square(1), "square");
    const std::size_t turns =
        file.add_accessor(file.add_view(GltfFile::bytes_of(std::vector<std::int16_t>{0, 32767, 0, 0})), 5122, 1, "VEC4",
                          R"(,"normalized":true)");
    const auto scene = parse(instanced(file, R"("ROTATION":)" + std::to_string(turns)));
    REQUIRE(scene.meshes.size() == 1);
    CHECK(double(glm::distance(scene.meshes[0].positions[0], glm::vec3(1, 10, 1))) < 10 * few_roundings);
}

TEST_CASE("glTF: instancing attributes that do not fit are refused") {
    GltfFile file;
    add_mesh(file, horizontal_square(1), "square");
    const std::string two = std::to_string(file.add_vectors({{5, 0, 0}, {0, 0, 7}}));
    const std::string three = std::to_string(file.add_vectors({{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}));
    const auto problem = [&](const std::string& attributes) { return problem_of(instanced(file, attributes)); };
    check_problem(problem(R"("TRANSLATION":)" + two + R"(,"SCALE":)" + three), "of 2 and of 3 elements");
    check_problem(problem(R"("ROTATION":)" + two), "wants VEC4");
    check_problem(problem(R"("TRANSLATION":99)"), "accessor 99");
    check_problem(problem(R"("TRANSLATION":"here")"), "not an index");
    GltfFile without = file;
    without.add_node(R"({"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{}}})");
    check_problem(problem_of(without), "without attributes");
}

// Far from the origin -------------------------------------------------------------------------------------------------

// Nodes far off, and vertices about their own origin, as modellers write them: in double nothing is lost. The places
// are multiples of the sphere's radius, and so of the grid that the origin is moved to.
TEST_CASE("glTF: a scene far from the origin has the same vertices as at the origin, to the last bit") {
    const auto moved = [](double x) {
        GltfFile file = caustic_scene();
        file.add_node(R"({"children":[0,1,2,3],"translation":)" + json_array({x, 2 * x, -x}) + "}");
        file.roots = {4};
        return parse(file);
    };
    const auto at_home = moved(0);
    CHECK(at_home.origin == glm::dvec3(0));
    for (const double x : {1e3, 1e4, 1e5, 1e7}) {
        const auto far_off = moved(x);
        CHECK(warns(far_off, "far from the origin"));
        const glm::vec3 shift(glm::dvec3(x, 2 * x, -x) - far_off.origin);
        CHECK(double(glm::length(shift)) < 2); // about the sphere's size
        REQUIRE(far_off.meshes.size() == at_home.meshes.size());
        for (std::size_t m = 0; m < at_home.meshes.size(); ++m)
            for (std::size_t i = 0; i < at_home.meshes[m].positions.size(); ++i) {
                // Of coordinates up to 3 after the shift, from a matrix of products in double.
                const glm::vec3 expected = at_home.meshes[m].positions[i] + shift;
                CHECK(double(glm::distance(far_off.meshes[m].positions[i], expected)) < 4 * few_roundings);
            }
        CHECK(double(glm::distance(far_off.cameras.at(0).position, at_home.cameras.at(0).position + shift)) <
              6 * few_roundings);
    }
}

TEST_CASE("glTF: a scene is moved by what is specular in it, however large its floor is") {
    GltfFile file;
    file.materials = {"{}", R"({"pbrMetallicRoughness":{"roughnessFactor":0}})"};
    add_mesh(file, horizontal_square(1e5f), "floor", 0);
    add_mesh(file, uv_sphere(1), "mirror", 1);
    file.add_node(R"({"mesh":0})");
    file.add_node(R"({"mesh":1,"translation":[5000,1,0]})");
    CHECK(parse(file).origin == glm::dvec3(5000, 1, 0));
    file.nodes[1] = R"({"mesh":1,"translation":[5,1,0]})";
    CHECK(parse(file).origin == glm::dvec3(0));
}

// Enclosures ----------------------------------------------------------------------------------------------------------

TEST_CASE("glTF: a mesh is closed where every edge has two sides, also if its vertices are split there") {
    const MeshDescription sphere = parse(file_with(uv_sphere(2))).meshes.at(0); // a seam, and poles of many vertices
    const auto whole = enclosure_of(sphere);
    CHECK(whole.is_closed);
    const double exact = 4.0 / 3 * std::numbers::pi * 8;
    CHECK(whole.volume > 0.96 * exact); // of 32 by 16 facets, inscribed
    CHECK(whole.volume < exact);

    MeshDescription inside_out = sphere;
    for (auto& t : inside_out.triangles)
        std::swap(t[0], t[1]);
    CHECK(enclosure_of(inside_out).is_closed);
    CHECK(enclosure_of(inside_out).volume == doctest::Approx(-whole.volume));

    MeshDescription open = sphere;
    open.triangles.pop_back();
    CHECK_FALSE(enclosure_of(open).is_closed);
    CHECK_FALSE(enclosure_of(parse(file_with(horizontal_square(1))).meshes.at(0)).is_closed);
    // Exporters compute the pole's vertices one by one, each with a radius of sin(pi): 1e-16 in double, 9e-8 in float.
    for (const double radius : {1.2e-16, 8.7e-8}) {
        MeshDescription noisy = sphere;
        for (std::size_t i = 0; i <= 32; ++i) {
            glm::vec3& pole = noisy.positions.at(noisy.positions.size() - 1 - i);
            pole += glm::vec3(2 * radius * glm::dvec3(std::cos(double(i)), 0, std::sin(double(i))));
        }
        CHECK(enclosure_of(noisy).is_closed);
        noisy.triangles.pop_back();
        CHECK_FALSE(enclosure_of(noisy).is_closed);
        noisy.positions.back().x += 1e-4f; // a gap that is none of rounding
        CHECK_FALSE(enclosure_of(noisy).is_closed);
    }
    MeshDescription point = sphere; // of no size at all
    for (glm::vec3& position : point.positions)
        position = glm::vec3(0);
    CHECK_FALSE(enclosure_of(point).is_closed);
    MeshDescription turned = sphere; // one triangle the wrong way round
    std::swap(turned.triangles[40][0], turned.triangles[40][1]);
    CHECK_FALSE(enclosure_of(turned).is_closed);
}

} // namespace nephroid::examples::gltf_placing_test
