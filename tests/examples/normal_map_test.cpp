// SPDX-License-Identifier: MIT
#include "common/normal_map.hpp"

#include "support/painted_square.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>

namespace nephroid::examples::normal_map_test {

namespace {

using namespace nephroid::tests;

std::string mirror(const std::string& more = "") {
    return R"({"pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0},"normalTexture":{"index":0)" + more +
           "}}";
}

/// Bumps that differ from texel to texel.
std::string bumps(std::uint32_t side) {
    std::vector<std::array<std::uint8_t, 4>> texels;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x)
            texels.push_back({static_cast<std::uint8_t>(128 + 60 * std::sin(0.7 * x)),
                              static_cast<std::uint8_t>(128 + 50 * std::cos(0.5 * x + 0.9 * y)), 230, 255});
    return png_bytes(side, side, texels);
}

/// The vector that a component of 8 bits stands for.
double component(int level) { return 2 * level / 255.0 - 1; }

} // namespace

// A map that has one colour is a plane that is tilted: towards +x here for its red, towards the image's upper edge, -z,
// for its green.
TEST_CASE_TEMPLATE("normal map: a map of one colour tilts the surface by its angle", T, float, double) {
    const auto normal = [](const std::array<std::uint8_t, 4>& texel, const std::string& more) {
        const auto scene = PaintedSquare(mirror(more), png_bytes(1, 1, {texel})).scene<T>();
        const auto hit = hit_below(scene, 0.3, -0.2);
        CHECK(hit.geometric_normal == Vec3<T>(0, 1, 0));
        CHECK(length(hit.curvature(Vec3<T>(1, 0, 0))) < 1e-6);
        return hit.shading_normal;
    };
    const auto expected = [](double x, double y, double z) { return Vec3<T>(normalize(Vec3<double>(x, z, -y))); };
    const double a = component(200), zero = component(128), up = 1;
    CHECK(length(normal({200, 128, 255, 255}, "") - expected(a, zero, up)) < 1e-6);
    CHECK(length(normal({128, 200, 255, 255}, "") - expected(zero, a, up)) < 1e-6);
    CHECK(length(normal({200, 128, 255, 255}, R"(,"scale":0.5)") - expected(0.5 * a, 0.5 * zero, up)) < 1e-6);
    // Turned by a quarter, the image's right is the square's +z: u' = v.
    const std::string quarter = R"(,"extensions":{"KHR_texture_transform":{"rotation":1.5707963267948966}})";
    CHECK(length(normal({200, 128, 255, 255}, quarter) - expected(zero, -a, up)) < 1e-6);
    // An image that is mirrored tilts to the other side.
    const std::string mirrored = R"(,"extensions":{"KHR_texture_transform":{"scale":[-1,1]}})";
    CHECK(length(normal({200, 140, 255, 255}, mirrored) - expected(-a, component(140), up)) < 1e-6);
}

TEST_CASE("normal map: the file's own tangents are used, also in a mirrored node") {
    const std::string png = png_bytes(1, 1, {{200, 230, 255, 255}});
    const double a = component(200), b = component(230);
    const auto normal = [&](const glm::vec4& tangent, const std::string& node) {
        PaintedSquare square(mirror(), png);
        const std::vector<glm::vec4> tangents(4, tangent);
        const std::size_t view = square.file.add_view(GltfFile::bytes_of(tangents));
        square.show(R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TANGENT":)" +
                    std::to_string(square.file.add_accessor(view, 5126, 4, "VEC4")));
        square.file.nodes = {R"({"mesh":0)" + node + "}"};
        const auto scene = square.scene();
        return hit_below(scene, 0.3, -0.2).shading_normal;
    };
    const auto expected = [](double x, double y, double z) { return glm::normalize(glm::dvec3(x, y, z)); };
    CHECK(glm::length(normal({1, 0, 0, 1}, "") - expected(a, 1, -b)) < 1e-6);
    CHECK(glm::length(normal({1, 0, 0, -1}, "") - expected(a, 1, b)) < 1e-6);
    CHECK(glm::length(normal({0, 0, 3, 1}, "") - expected(b, 1, a)) < 1e-6); // of any length
    // What a mirroring node shows is the mirror image.
    CHECK(glm::length(normal({1, 0, 0, 1}, R"(,"scale":[-1,1,1])") - expected(-a, 1, -b)) < 1e-6);
    CHECK(glm::length(normal({1, 0, 0, 1}, R"(,"scale":[1,1,-1])") - expected(a, 1, b)) < 1e-6);
}

TEST_CASE("normal map: computed tangents are those of the file's, where these belong to the coordinates") {
    const std::string png = bumps(16);
    PaintedSquare computed(mirror(), png), given(mirror(), png);
    const std::vector<glm::vec4> tangents(4, glm::vec4(1, 0, 0, 1));
    const std::size_t view = given.file.add_view(GltfFile::bytes_of(tangents));
    given.show(R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TANGENT":)" +
               std::to_string(given.file.add_accessor(view, 5126, 4, "VEC4")));
    for (const char* node : {"", R"(,"scale":[-1,1,1])", R"(,"scale":[1,1,-2])", R"(,"rotation":[0,0.6,0,0.8])"}) {
        computed.file.nodes = given.file.nodes = {R"({"mesh":0)" + std::string(node) + "}"};
        const auto a = computed.scene(), b = given.scene();
        for (const double x : {-0.4, 0.1, 0.35})
            CHECK(glm::length(hit_below(a, x, 0.2).shading_normal - hit_below(b, x, 0.2).shading_normal) < 1e-6);
    }
}

// Exporters that turn the normals inside out keep the tangents' sign in step, so that B is still the image's up.
TEST_CASE("normal map: normals against the winding leave the image's directions as they are") {
    const std::string png = png_bytes(1, 1, {{200, 230, 255, 255}});
    const auto normal = [&](float sign, const std::string& node) {
        PaintedSquare square(mirror(), png);
        const std::size_t down = square.file.add_vectors(std::vector<glm::vec3>(4, glm::vec3(0, -1, 0)));
        std::string attributes = R"("POSITION":0,"TEXCOORD_0":2,"NORMAL":)" + std::to_string(down);
        if (sign != 0) {
            const std::vector<glm::vec4> tangents(4, glm::vec4(1, 0, 0, sign));
            const std::size_t view = square.file.add_view(GltfFile::bytes_of(tangents));
            attributes += R"(,"TANGENT":)" + std::to_string(square.file.add_accessor(view, 5126, 4, "VEC4"));
        }
        square.show(attributes);
        square.file.nodes = {R"({"mesh":0)" + node + "}"};
        const auto scene = square.scene();
        return hit_below(scene, 0.3, -0.2).shading_normal;
    };
    const double a = component(200), b = component(230);
    const auto expected = [](double x, double y, double z) { return glm::normalize(glm::dvec3(x, y, z)); };
    CHECK(glm::length(normal(-1, "") - expected(a, 1, -b)) < 1e-6); // -1 times (-y) × x is -z, the image's up
    CHECK(glm::length(normal(1, "") - expected(a, 1, b)) < 1e-6);
    CHECK(glm::length(normal(0, "") - expected(a, 1, -b)) < 1e-6); // computed
    CHECK(glm::length(normal(-1, R"(,"scale":[-1,1,1])") - expected(-a, 1, -b)) < 1e-6);
    CHECK(glm::length(normal(0, R"(,"scale":[-1,1,1])") - expected(-a, 1, -b)) < 1e-6);
}

// Between normals that spread, the interpolated one is shorter: 0.8 in the middle here. The tilt is the map's all the
// same. The tangent leans out of the surface by the same angle, and is made perpendicular.
TEST_CASE("normal map: the tilt does not depend on the length of interpolated normals and tangents") {
    PaintedSquare square(mirror(), png_bytes(1, 1, {{200, 230, 255, 255}}));
    std::vector<glm::vec3> spread;
    for (const glm::vec3& p : horizontal_square(1).positions)
        spread.emplace_back(0, 0.8f, 0.6f * p.z);
    const std::vector<glm::vec4> tangents(4, glm::vec4(0.8f, 0.6f, 0, 1));
    const std::size_t normals = square.file.add_vectors(spread);
    const std::size_t view = square.file.add_view(GltfFile::bytes_of(tangents));
    square.show(R"("POSITION":0,"TEXCOORD_0":2,"NORMAL":)" + std::to_string(normals) + R"(,"TANGENT":)" +
                std::to_string(square.file.add_accessor(view, 5126, 4, "VEC4")));
    const auto scene = square.scene();
    const double a = component(200), b = component(230);
    for (const double z : {0.0, 0.25, -0.7}) {
        const glm::dvec3 n = glm::normalize(glm::dvec3(0, 0.8, 0.6 * z)), t(0.8, 0.6, 0);
        const glm::dvec3 x = glm::normalize(t - glm::dot(t, n) * n), y = glm::cross(n, x);
        const auto hit = hit_below(scene, 0.3, z);
        CHECK(glm::length(hit.shading_normal - glm::normalize(a * x + b * y + n)) < 1e-6); // floats in the file
    }
}

// Models that are symmetric often have one half of an image on both halves, which meet in common vertices.
TEST_CASE("normal map: where an image meets its mirror image, both sides have the map up to the seam") {
    const std::string png = png_bytes(1, 1, {{200, 230, 255, 255}});
    PaintedSquare square(mirror(), png);
    std::vector<glm::vec3> positions;
    std::vector<glm::vec2> uv;
    for (const float z : {-1.0f, 1.0f})
        for (const float x : {-1.0f, 0.0f, 1.0f}) {
            positions.emplace_back(x, 0, z);
            uv.emplace_back(std::abs(x), (z + 1) / 2);
        }
    const std::string position = std::to_string(square.file.add_vectors(positions));
    const std::string normal = std::to_string(square.file.add_vectors(std::vector<glm::vec3>(6, glm::vec3(0, 1, 0))));
    const std::string coordinate =
        std::to_string(square.file.add_accessor(square.file.add_view(GltfFile::bytes_of(uv)), 5126, 6, "VEC2"));
    const std::string indices =
        std::to_string(square.file.add_indices(std::vector<std::uint8_t>{0, 3, 1, 1, 3, 4, 1, 4, 2, 2, 4, 5}));
    for (const std::string& normals : {R"(,"NORMAL":)" + normal, std::string()}) {
        square.file.meshes = {R"({"primitives":[{"attributes":{"POSITION":)" + position + R"(,"TEXCOORD_0":)" +
                              coordinate + normals + R"(},"indices":)" + indices + R"(,"material":0}]})"};
        const auto description = parse(square.file);
        CHECK(description.warnings.empty());
        REQUIRE(description.meshes.size() == 1);
        CHECK(description.meshes[0].positions.size() == 8); // the two vertices at the seam twice
        const auto scene = square.scene();
        const double a = component(200), b = component(230);
        for (const double x : {0.01, 0.5, 0.9})
            for (const double side : {-1.0, 1.0}) {
                const auto hit = hit_below(scene, side * x, 0.3);
                CHECK(glm::length(hit.shading_normal - glm::normalize(glm::dvec3(side * a, 1, -b))) < 1e-6);
            }
    }
}

TEST_CASE("normal map: without coordinates, tangents or a steep enough map the surface stays as it is") {
    const auto check_flat = [](const PaintedSquare& square) {
        const auto scene = square.scene();
        CHECK(hit_below(scene, 0.3, -0.2).shading_normal == glm::dvec3(0, 1, 0));
    };
    PaintedSquare square(mirror(), bumps(4));
    square.show(R"("POSITION":0,"NORMAL":1)");
    check_flat(square);
    PaintedSquare degenerate(mirror(), bumps(4));
    const std::vector<glm::vec2> uv(4, glm::vec2(0.3f, 0.4f)); // one point for the whole square
    const std::size_t same =
        degenerate.file.add_accessor(degenerate.file.add_view(GltfFile::bytes_of(uv)), 5126, 4, "VEC2");
    degenerate.show(R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":)" + std::to_string(same));
    check_flat(degenerate);
    CHECK(warns(parse(degenerate.file), "has 4 vertices without a tangent"));
    check_flat(PaintedSquare(mirror(), png_bytes(1, 1, {{200, 128, 0, 255}}))); // z = -1: the map looks backwards
}

TEST_CASE("normal map: the curvature is how the normal changes along the surface") {
    const auto scene = PaintedSquare(mirror(), bumps(16)).scene();
    for (const glm::dvec2& at : {glm::dvec2(0.3, 0.2), glm::dvec2(-0.61, 0.44), glm::dvec2(0.05, -0.77)})
        for (const glm::dvec3& along : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.6, 0, -0.8)}) {
            const double h = 1e-5; // its square times the map's third derivative, (2π/period)³ about 500
            const auto normal_at = [&](double step) {
                return hit_below(scene, at.x + step * along.x, at.y + step * along.z).shading_normal;
            };
            const glm::dvec3 difference = (normal_at(h) - normal_at(-h)) / (2 * h);
            const glm::dvec3 said = hit_below(scene, at.x, at.y).curvature(along);
            CHECK(glm::length(said) > 0.01);
            CHECK(glm::length(said - difference) < 1e-4 * (1 + glm::length(difference)));
        }
}

// On a globe normals and tangents turn as well, and triangles face any direction.
TEST_CASE("normal map: the curvature on a curved mesh is a difference of normals, within each triangle") {
    const TestMesh globe = uv_sphere(1, 16, 8);
    GltfFile file;
    std::vector<glm::vec2> uv;
    for (std::size_t i = 0; i <= 8; ++i)
        for (std::size_t k = 0; k <= 16; ++k)
            uv.emplace_back(float(k) / 16, float(i) / 8);
    file.add_vectors(globe.positions);
    file.add_vectors(globe.normals);
    file.add_accessor(file.add_view(GltfFile::bytes_of(uv)), 5126, uv.size(), "VEC2");
    file.add_indices(globe.indices);
    file.meshes = {
        R"({"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0}]})"};
    file.add_node(R"({"mesh":0})");
    file.materials = {mirror(R"(,"scale":0.7,"extensions":{"KHR_texture_transform":{"rotation":0.3,"scale":[2,1]}})")};
    const std::size_t view = file.add_view(bumps(8));
    file.more = R"(,"images":[{"mimeType":"image/png","bufferView":)" + std::to_string(view) +
                R"(}],"textures":[{"source":0}])";
    const auto scene = scene_from<double>(parse(file)).scene;

    int checked = 0;
    for (const glm::dvec3& start : {glm::dvec3(0.3, 0.4, 2), glm::dvec3(2, 0.3, 0.1), glm::dvec3(-0.2, -0.6, -2),
                                    glm::dvec3(-2, 0.5, 0.4), glm::dvec3(0.4, 1.3, 1.3)}) {
        const auto hit = scene.intersect(start, -glm::normalize(start), 0, 10).value();
        const glm::dvec3 n = hit.geometric_normal;
        CHECK(glm::dot(hit.shading_normal, n) > 0);
        const glm::dvec3 x = glm::normalize(glm::cross(n, glm::dvec3(0.3, 0.5, -0.7))), y = glm::cross(n, x);
        for (const glm::dvec3& along : {x, y}) {
            const double h = 1e-6;
            const auto beside = [&](double step) {
                return scene.intersect(hit.position + n + step * along, -n, 0, 10).value();
            };
            const auto ahead = beside(h), behind = beside(-h);
            REQUIRE(ahead.primitive == hit.primitive);
            REQUIRE(behind.primitive == hit.primitive);
            const glm::dvec3 difference = (ahead.shading_normal - behind.shading_normal) / (2 * h);
            // Two roundings of 1e-16 over 2h, and h² of the third derivative, about 1e4.
            CHECK(glm::length(hit.curvature(along) - difference) < 1e-6 * (1 + glm::length(difference)));
            ++checked;
        }
    }
    CHECK(checked == 10);
}

TEST_CASE("normal map: a note says that a diffuse surface has it for direct light alone") {
    const auto warnings_of = [](const std::string& material) {
        return scene_from<float>(parse(PaintedSquare(material, bumps(4)).file)).warnings;
    };
    const auto matt =
        warnings_of(R"({"name":"wall","pbrMetallicRoughness":{"metallicFactor":0},"normalTexture":{"index":0}})");
    REQUIRE(matt.size() == 1);
    CHECK(contains(matt[0], "\"wall\": has a normal map, which counts for light straight from lamps"));
    CHECK(warnings_of(mirror()).empty());
}

} // namespace nephroid::examples::normal_map_test
