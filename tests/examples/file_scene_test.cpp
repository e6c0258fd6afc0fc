// SPDX-License-Identifier: MIT
// Files as people write them, through the whole program: what a picture shows where a formula says what it must.
#include "common/caustics/file_scene.hpp"
#include "support/gltf_writer.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace nephroid::examples::file_scene_test {

using namespace nephroid::tests;

namespace {

/// A floor that is white, the sun of irradiance 1 across its beam, at an angle from straight above towards +x, and an
/// orthographic camera 0.4 above the floor that sees [-half, half]^2 of it.
struct World {
    GltfFile file;

    World(double angle, double half) {
        file.materials = {R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":1}})"};
        show(horizontal_square(8), 0, "");
        file.lights.emplace_back(R"({"type":"directional","intensity":1})");
        // Its light goes along -z: turned about x to go down, and then about z.
        const double s = std::sin(angle), c = std::cos(angle);
        file.add_node(R"({"matrix":)" + json_array({0, 0, -1, 0, c, s, 0, 0, s == 0 ? 0 : -s, c, 0, 0, 0, 9, 0, 1}) +
                      R"(,"extensions":{"KHR_lights_punctual":{"light":0}}})");
        file.cameras.emplace_back(R"({"type":"orthographic","orthographic":{"xmag":)" + json_number(half) +
                                  R"(,"ymag":)" + json_number(half) + R"(,"znear":0.001,"zfar":100}})");
        file.add_node(R"({"camera":0,"matrix":)" + json_array({1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0.4, 0, 1}) +
                      "}");
    }

    void show(const TestMesh& mesh, int material, const std::string& placed) {
        file.add_node(R"({"mesh":)" + std::to_string(add_mesh(file, mesh, "", material)) + placed + "}");
    }
    int add_material(const std::string& json) {
        file.materials.push_back(json);
        return static_cast<int>(file.materials.size()) - 1;
    }
};

/// Glass of this transmissionFactor.
std::string glass(double transmission, bool has_volume) {
    return R"({"name":"glass","pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{)"
           R"("KHR_materials_transmission":{"transmissionFactor":)" +
           json_number(transmission) + "}" +
           (has_volume ? R"(,"KHR_materials_volume":{"thicknessFactor":1})" : std::string()) + "}}";
}

/// A box, closed, its front outside.
TestMesh box(float half, float low, float high) {
    TestMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 4 ? half : -half, i & 2 ? high : low, i & 1 ? half : -half);
    mesh.indices = {0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1,
                    2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3};
    return mesh;
}

Rendering render(const GltfFile& file, std::uint64_t photons = 20'000, std::size_t size = 32,
                 Layer layer = Layer::caustics) {
    const TemporaryFolder folder;
    Options options;
    options.scene = (folder.path() / "scene.glb").string();
    write_bytes(options.scene, file.glb());
    options.photons = photons;
    options.width = options.height = size;
    options.threads = 2;
    options.layer = layer;
    return render_file(options);
}

/// The irradiance on the floor, the mean of a part of the columns, 0 to 1 from left to right.
double irradiance(const Rendering& r, double from = 0, double to = 1) {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t y = 0; y < r.picture.height; ++y)
        for (std::size_t x = 0; x < r.picture.width; ++x)
            if (const double at = (double(x) + 0.5) / double(r.picture.width); at > from && at < to) {
                sum += double(r.picture.samples[3 * (y * r.picture.width + x)]);
                ++count;
            }
    return std::numbers::pi * sum / double(count);
}

bool notes(const Rendering& r, const char* part) {
    return std::any_of(r.report.notes.begin(), r.report.notes.end(),
                       [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

/// Fresnel's reflectance of glass of index 1.5 at 45 degrees, and straight on.
constexpr double r45 = 0.0502397, r0 = 0.04;

} // namespace

// ((1 - R) t)^2 (1 + R^2 + ...), as in mixture_test.cpp; within 2%: some 20,000 photons over the picture.
TEST_CASE("file scene: a slab of glass that transmits in part lets that part through, twice") {
    for (const double t : {0.3, 0.6, 1.0}) {
        World world(0, 0.5);
        world.show(box(3, 1, 2), world.add_material(glass(t, true)), "");
        const Rendering rendering = render(world.file);
        CHECK(irradiance(rendering) == doctest::Approx(std::pow((1 - r0) * t, 2) / (1 - r0 * r0)).epsilon(0.02));
        CHECK(rendering.report.notes.empty());
    }
}

// (1 - R)/(1 + R) cos 45 where the sun falls through the quad without being displaced: x from 0 to 2, with the camera
// over -1 to 1. Left of 0 there is nothing.
TEST_CASE("file scene: one quad of glass without volume is a thin window") {
    World world(std::numbers::pi / 4, 1);
    world.show(horizontal_square(1), world.add_material(glass(1, false)), R"(,"translation":[0,1,0])");
    const Rendering rendering = render(world.file, 40'000);
    const double expected = (1 - r45) / (1 + r45) * std::sqrt(0.5);
    CHECK(irradiance(rendering, 0.55, 1) == doctest::Approx(expected).epsilon(0.01));
    CHECK(irradiance(rendering, 0, 0.45) < 0.01 * expected);
    CHECK(notes(rendering, "thin window"));
}

TEST_CASE("file scene: glass by opacity lets the rest of the light pass, unbent, as glTF says") {
    World world(std::numbers::pi / 4, 1);
    world.show(horizontal_square(1),
               world.add_material(R"({"name":"pane","alphaMode":"BLEND","pbrMetallicRoughness":)"
                                  R"({"baseColorFactor":[1,1,1,0.2],"metallicFactor":0,"roughnessFactor":0}})"),
               R"(,"translation":[0,1,0])");
    const Rendering rendering = render(world.file, 40'000);
    CHECK(irradiance(rendering, 0.55, 1) == doctest::Approx(0.8 * std::sqrt(0.5)).epsilon(0.01));
    CHECK(notes(rendering, "is there by 0.2 (its opacity)"));
}

// The same scene under a node that moves it. What is moved back is the same but for the rounding of positions: a part
// in 10^7 of them. What that makes of photons near edges is below 2% of the mean.
TEST_CASE("file scene: far from the origin the picture is what it is there") {
    const auto picture_at = [](double x) {
        GltfFile file = caustic_scene();
        file.add_node(R"({"children":[0,1,2,3],"translation":)" + json_array({x, x / 2, -x}) + "}");
        file.roots = {4};
        return render(file, 5000, 48, Layer::all).picture.samples;
    };
    const std::vector<float> home = picture_at(0);
    double mean = 0;
    for (const float sample : home)
        mean += double(sample) / double(home.size());
    for (const double x : {1e3, 1e4, 1e5}) {
        const std::vector<float> moved = picture_at(x);
        double sum = 0;
        for (std::size_t i = 0; i < home.size(); ++i)
            sum += std::pow(double(moved[i]) - double(home[i]), 2);
        CAPTURE(x);
        CHECK(std::sqrt(sum / double(home.size())) < 0.02 * mean);
    }
}

TEST_CASE("file scene: a file of glass alone renders something, and says what it assumed") {
    GltfFile file;
    file.materials = {glass(1, true)};
    file.add_node(R"({"mesh":)" + std::to_string(add_mesh(file, uv_sphere(1), "ball", 0)) + "}");
    const Rendering rendering = render(file, 5000, 48, Layer::all);
    CHECK(notes(rendering, "assumed --sun"));
    CHECK(notes(rendering, "assumed --ground"));
    CHECK(notes(rendering, "no camera in the file"));
    const auto [low, high] = std::minmax_element(rendering.picture.samples.begin(), rendering.picture.samples.end());
    // The ground in the sun has a radiance of 0.8 times the cosine, 0.85; the focus is far brighter; there is a shadow.
    CHECK(*high > 2);
    CHECK(*low < 0.1f);
    std::size_t in_the_sun = 0;
    for (const float sample : rendering.picture.samples)
        in_the_sun += std::abs(double(sample) - 0.8 * 1 / std::hypot(0.5, 1, 0.35)) < 0.01;
    CHECK(in_the_sun > rendering.picture.samples.size() / 4);
}

} // namespace nephroid::examples::file_scene_test
