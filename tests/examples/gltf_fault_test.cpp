// SPDX-License-Identifier: MIT
#include "common/gltf.hpp"
#include "support/gltf_reading.hpp"
#include "support/gltf_writer.hpp"
#include "support/is_sanitized.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::examples::gltf_fault_test {

namespace {

namespace fs = std::filesystem;
using nephroid::examples::read_gltf;
using namespace nephroid::tests;

} // namespace

// Files ---------------------------------------------------------------------------------------------------------------

TEST_CASE("glTF: a buffer may be in the binary chunk, in the text, or in a file beside it") {
    const TemporaryFolder folder;
    const GltfFile file = file_with(uv_sphere(1));
    const std::size_t vertices = uv_sphere(1).positions.size();
    write_bytes(folder / "a.glb", file.glb());
    write_bytes(folder / "b.gltf", file.json("data:application/octet-stream;base64," + base64(file.binary)));
    write_bytes(folder / "c.gltf", "\xEF\xBB\xBF" + file.json("my%20mesh.bin"));
    write_bytes(folder / "my mesh.bin", file.binary);
    write_bytes(folder / "no_extension", file.glb());
    for (const char* name : {"a.glb", "b.gltf", "c.gltf", "no_extension"})
        CHECK(read_gltf(folder.path() / name).meshes.at(0).positions.size() == vertices);

    fs::remove(folder / "my mesh.bin");
    CHECK_THROWS_WITH_AS(static_cast<void>(read_gltf(folder / "c.gltf")), doctest::Contains("my mesh.bin"),
                         std::runtime_error);
}

TEST_CASE("glTF: what is no file, or no glTF, is refused in one line that names it") {
    const TemporaryFolder folder;
    CHECK_THROWS_WITH_AS(static_cast<void>(read_gltf(folder / "none.glb")), doctest::Contains("none.glb: no such file"),
                         std::runtime_error);
    CHECK_THROWS_WITH_AS(static_cast<void>(read_gltf(folder.path())), doctest::Contains("not a file"),
                         std::runtime_error);
    check_problem(problem_of(std::string()), "an empty file");
    check_problem(problem_of("solid teapot"), "neither a .glb nor JSON");
    check_problem(problem_of("{ \"asset\": "), "parse error");
    check_problem(problem_of("{}  "), "asset");
    check_problem(problem_of(R"({"asset":{"version":"1.0"}})"), "version \"1.0\"");
    check_problem(problem_of(R"({"asset":{"version":"2.0","minVersion":"2.1"}})"), "2.1");
    std::string old = caustic_scene().glb();
    old[4] = 1;
    check_problem(problem_of(old), "version 1");
}

TEST_CASE("glTF: only the images that materials use are opened, and animations are not read") {
    GltfFile file;
    file.materials = {R"({"name":"wood","pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}}})"};
    file.more = R"(,"images":[{"uri":"missing.png"},{"bufferView":99,"mimeType":"image/png"}],)"
                R"("textures":[{"source":0}],"animations":[{"channels":[],"samplers":[]}],"extras":{"a":1})";
    const SceneDescription scene = parse(file);
    CHECK(warns(scene, "wood"));
    CHECK(warns(scene, "animations"));
    CHECK(scene.warnings.size() == 2);
}

TEST_CASE("glTF: an extension that is not read is refused if it is required, else warned of") {
    GltfFile file = file_with(horizontal_square(1));
    file.more = R"(,"extensionsUsed":["KHR_draco_mesh_compression"])";
    CHECK(warns(parse(file), "KHR_draco_mesh_compression"));
    file.more += R"(,"extensionsRequired":["KHR_draco_mesh_compression"])";
    check_problem(problem_of(file), "requires the extension KHR_draco_mesh_compression");
    file.accessors[2] = R"({"componentType":5125,"count":6,"type":"SCALAR"})"; // as Draco's files have them
    check_problem(problem_of(file), "requires the extension KHR_draco_mesh_compression");
    file.more = R"(,"extensionsRequired":["KHR_texture_transform","KHR_materials_ior"])";
    file.accessors[2] = R"({"bufferView":2,"componentType":5125,"count":6,"type":"SCALAR"})";
    CHECK(problem_of(file).empty());
}

// Files packed by meshoptimizer have a second buffer without a uri, for readers that know where its bytes come from.
TEST_CASE("glTF: what is packed by meshoptimizer is refused by that name, whatever else is strange about the file") {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        GltfFile file = file_with(horizontal_square(1));
        file.more = std::string(R"(,"extensionsUsed":[")") + name + R"("],"extensionsRequired":[")" + name + "\"]";
        std::string json = file.json();
        json.replace(json.find(R"("buffers":[)"), 11, R"("buffers":[{"byteLength":4},)");
        check_problem(problem_of(glb_bytes(json, file.binary)), std::string("requires the extension ") + name);
    }
}

TEST_CASE("glTF: what was noticed before the fault comes with it") {
    GltfFile file = file_with(horizontal_square(1));
    file.materials = {R"({"name":"wood","pbrMetallicRoughness":{"baseColorFactor":[2,1,1,1]}})"};
    file.more = R"(,"extensionsUsed":["KHR_materials_clearcoat"])";
    file.add_node(R"({"mesh":7})");
    try {
        static_cast<void>(parse(file));
        FAIL("the file was read");
    } catch (const nephroid::examples::UnreadableGltf& error) {
        check_problem(error.what(), "mesh 7");
        REQUIRE(error.warnings.size() == 2);
        CHECK(contains(error.warnings[0], "KHR_materials_clearcoat"));
        CHECK(contains(error.warnings[1], "clamped"));
    }
}

// Faults --------------------------------------------------------------------------------------------------------------

TEST_CASE("glTF: nodes that form a cycle, or have two parents, are refused") {
    GltfFile file;
    file.add_node(R"({"children":[0]})");
    check_problem(problem_of(file), "cycle");
    file.nodes = {R"({"children":[1]})", R"({"children":[0]})"};
    check_problem(problem_of(file), "cycle");
    file.nodes = {R"({"children":[2]})", R"({"children":[2]})", "{}"};
    check_problem(problem_of(file), "node 2 has two parents");
    file.nodes = {R"({"children":[1,1]})", "{}"};
    check_problem(problem_of(file), "two parents");
    file.nodes = {R"({"children":[1]})", "{}"};
    check_problem(problem_of(file), "scene 0 starts from node 1, which is a child of node 0");
    file.nodes = {R"({"children":[7]})"};
    check_problem(problem_of(file), "node 0 refers to node 7, but the file has 1");
    file.nodes = {R"({"children":[-1]})"};
    check_problem(problem_of(file), "node -1");
    file.nodes = {"{}"};
    file.scenes = R"([{"nodes":[0,0]}])";
    check_problem(problem_of(file), "twice");
    file.scenes = R"([{"nodes":[0]}],"scene":3)";
    check_problem(problem_of(file), "scene 3");
}

TEST_CASE("glTF: the broken files of the tests are refused, naming mesh and vertex") {
    check_problem(problem_of(glb_with_nan()), "mesh 0 (\"sphere\") has a position that is not finite at vertex 40");
    check_problem(problem_of(truncated_glb()), "truncated");
    check_problem(problem_of(glb_with_bad_index()), "mesh 0 (\"square\") has the index 4 at place 5, but only 4");
}

TEST_CASE("glTF: positions and normals that are not finite are refused") {
    for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        TestMesh square = horizontal_square(1);
        square.normals[2].z = bad;
        check_problem(problem_of(file_with(square)), "normal that is not finite at vertex 2");
        square.positions[1].x = bad;
        check_problem(problem_of(file_with(square)), "position that is not finite at vertex 1");
    }
    const std::string big = R"(,"scale":[1e30,1e30,1e30])";
    check_problem(problem_of(file_with(horizontal_square(1e20f), big)), "too large at vertex 0");
    GltfFile nested = file_with(horizontal_square(1), big);
    nested.add_node(R"({"children":[0],"scale":[1e30,1e30,1e30]})");
    nested.roots = {1};
    check_problem(problem_of(nested), "transform that becomes too large");
}

TEST_CASE("glTF: a primitive that makes no triangles is refused") {
    check_problem(problem_of(file_with_primitive({{0, 0, 0}, {1, 0, 0}})), "no triangle");
    check_problem(problem_of(file_with_primitive(four_points)), "no whole number of triangles");
    check_problem(problem_of(file_with_primitive(four_points, R"(,"mode":9)")), "mode 9");
    check_problem(problem_of(file_with_primitive(four_points, R"(,"indices":0)")), "SCALAR");
    GltfFile file = file_with_primitive(four_points);
    file.meshes = {R"({"primitives":[]})"};
    check_problem(problem_of(file), "mesh 0 has no primitives");
    file.meshes = {R"({"primitives":[{"attributes":{"NORMAL":0}}]})"};
    check_problem(problem_of(file), "no positions");
    file.meshes = {R"({"primitives":[{}]})"};
    check_problem(problem_of(file), "attributes");
    file.meshes = {R"({"primitives":[{"attributes":{"POSITION":5}}]})"};
    check_problem(problem_of(file), "accessor 5, but the file has 1");
    file.meshes = {R"({"primitives":[{"attributes":{"POSITION":0},"mode":5,"material":2}]})"};
    check_problem(problem_of(file), "material 2, but the file has 0");
    file.nodes = {R"({"name":"n","mesh":1})"};
    check_problem(problem_of(file), "node 0 (\"n\") refers to mesh 1");
}

TEST_CASE("glTF: accessors and buffer views beyond their bytes are refused") {
    const auto with_accessor = [](const std::string& accessor) {
        GltfFile file = file_with_primitive(four_points, R"(,"mode":5)");
        file.accessors = {R"({"type":"VEC3",)" + accessor + "}"};
        return problem_of(file);
    };
    CHECK(with_accessor(R"("bufferView":0,"componentType":5126,"count":4)").empty());
    check_problem(with_accessor(R"("bufferView":0,"componentType":5126,"count":5)"), "beyond its buffer view");
    check_problem(with_accessor(R"("bufferView":0,"componentType":5126,"count":4,"byteOffset":1)"), "beyond");
    check_problem(with_accessor(R"("bufferView":0,"componentType":5126,"count":18446744073709551615)"), "beyond");
    check_problem(with_accessor(R"("bufferView":0,"componentType":5126,"count":4,"byteOffset":18446744073709551608)"),
                  "beyond");
    check_problem(with_accessor(R"("bufferView":1,"componentType":5126,"count":4)"), "buffer view 1");
    check_problem(with_accessor(R"("bufferView":0,"componentType":5126,"count":0)"), "no elements");
    check_problem(with_accessor(R"("bufferView":0,"componentType":5125,"count":4)"), "32-bit integers");
    check_problem(with_accessor(R"("bufferView":0,"componentType":5124,"count":4)"), "VEC3");
    check_problem(with_accessor(R"("bufferView":0,"componentType":7,"count":4)"), "componentType");
    check_problem(with_accessor(R"("componentType":5126,"count":4000000000000000000)"), "vertices");
    check_problem(with_accessor(R"("componentType":5126,"count":4000000000)"), "proportion");

    const auto with_view = [](const std::string& view) {
        GltfFile file = file_with_primitive(four_points, R"(,"mode":5)");
        file.views = {"{" + view + "}"};
        return problem_of(file);
    };
    CHECK(with_view(R"("buffer":0,"byteLength":48)").empty());
    check_problem(with_view(R"("buffer":0,"byteLength":49)"), "beyond its buffer");
    check_problem(with_view(R"("buffer":0,"byteLength":40,"byteOffset":18446744073709551608)"), "beyond its buffer");
    check_problem(with_view(R"("buffer":1,"byteLength":48)"), "buffer 1, but the file has 1");
    check_problem(with_view(R"("buffer":-1,"byteLength":48)"), "buffer -1");
    check_problem(with_view(R"("buffer":0,"byteLength":48,"byteStride":8)"), "8 apart");

    const auto with_sparse = [](const std::string& count, const std::string& indices, const std::string& values) {
        GltfFile file = file_with_primitive(four_points, R"(,"mode":5)");
        file.add_view(GltfFile::bytes_of(std::vector<std::uint16_t>{1, 9}));
        file.accessors = {R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":)" + count +
                          R"(,"indices":{"bufferView":1)" + indices + R"(},"values":{"bufferView":0)" + values + "}}}"};
        return problem_of(file);
    };
    const std::string u16 = R"(,"componentType":5123)";
    CHECK(with_sparse("1", u16, "").empty());
    check_problem(with_sparse("2", u16, ""), "replaces number 9");
    check_problem(with_sparse("3", u16, ""), "beyond");
    check_problem(with_sparse("5", u16, ""), "replaces 5");
    check_problem(with_sparse("-1", u16, ""), "replaces -1");
    check_problem(with_sparse("1", R"(,"componentType":5126)", ""), "sparse indices");
    check_problem(with_sparse("1", u16 + R"(,"byteOffset":-2)", ""), "byteOffset is negative");
    check_problem(with_sparse("1", u16, R"(,"byteOffset":40)"), "beyond");

    GltfFile noted = file_with_primitive(four_points, R"(,"mode":5)");
    noted.more = R"(,"asset2":{"byteOffset":-1})"; // an offset of something else
    noted.nodes = {R"({"mesh":0,"extras":{"byteOffset":-1}})"};
    CHECK(problem_of(noted).empty());

    GltfFile file = file_with(horizontal_square(1));
    file.accessors[1] = R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"})";
    check_problem(problem_of(file), "4 positions, but 3 normals");
}

TEST_CASE("glTF: transforms that are none are refused") {
    const auto with_node = [](const std::string& properties) {
        return problem_of(file_with(horizontal_square(1), properties));
    };
    check_problem(with_node(R"(,"matrix":[1,0,0])"), "matrix of 3 numbers; 16");
    check_problem(with_node(R"(,"rotation":[0,0,0,0])"), "rotation of length zero");
    check_problem(with_node(R"(,"scale":[1,1])"), "scale of 2 numbers");
    check_problem(with_node(R"(,"translation":[1e300,0,0])"), "not finite in float");
    check_problem(with_node(R"(,"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1])"), "last row");
}

TEST_CASE("glTF: a small file cannot ask for much memory") {
    GltfFile shown = file_with(uv_sphere(1, 100, 100));
    for (int i = 0; i < 10000; ++i)
        shown.add_node(R"({"mesh":0})");
    check_problem(problem_of(shown), "proportion");

    GltfFile named = file_with(horizontal_square(1), R"(,"name":")" + std::string(100000, 'n') + "\"");
    named.meshes = {R"({"primitives":[)" +
                    GltfFile::joined(std::vector<std::string>(50000, R"({"attributes":{"POSITION":0},"mode":5})")) +
                    "]}"};
    check_problem(problem_of(named), "proportion");

    GltfFile copied = file_with(horizontal_square(1));
    std::string json = copied.json();
    json.replace(json.find(R"("buffers":[)"), 11, R"("buffers":[{"byteLength":4},)");
    check_problem(problem_of(glb_bytes(json, copied.binary)), "2 buffers without a uri");

    const std::string materials = GltfFile::joined(std::vector<std::string>(70000, "{}"));
    check_problem(problem_of(R"({"asset":{"version":"2.0"},"materials":[)" + materials + "]}"), "materials");
    check_problem(problem_of(R"({"asset":{"version":"2.0"},"extras":)" + std::string(100000, '[')), "nested");
    check_problem(problem_of(R"({"asset":{"version":"2.0"},"im\u0061ges":[]})"), "escapes");
}

TEST_CASE("glTF: a file cut off anywhere is refused") {
    const std::string whole = file_with(horizontal_square(1)).glb();
    REQUIRE(problem_of(whole).empty());
    for (std::size_t size = 0; size < whole.size(); ++size)
        CHECK_FALSE(problem_of(whole.substr(0, size)).empty());
}

TEST_CASE("glTF: a file with any one byte changed is read or refused in one line") {
    const std::string whole = caustic_scene(TestLight::quad).glb();
    const std::size_t json_end = whole.find("BIN");
    std::size_t number = 0;
    for (std::size_t i = 0; i < json_end; ++i) {
        for (const char byte : {'\0', '\xFF', '"', '}', '9', '-'}) {
            if (tests::is_sanitized && ++number % 5 != 0) // which takes ten times as long: another byte at each place
                continue;
            std::string changed = whole;
            changed[i] = byte;
            const std::string problem = problem_of(changed);
            CHECK_FALSE(contains(problem, "\n"));
            CHECK(problem.size() < 500);
        }
    }
}

} // namespace nephroid::examples::gltf_fault_test
