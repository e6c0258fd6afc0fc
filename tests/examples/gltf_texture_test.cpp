// SPDX-License-Identifier: MIT
#include "common/eye_paths.hpp"
#include "support/painted_square.hpp"
#include "support/temporary_folder.hpp"

#include "nephroid/execution/executor.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace nephroid::examples::gltf_texture_test {

namespace {

using namespace nephroid::tests;

/// The left half red, the right half green.
const std::string red_green = png_bytes(2, 1, {{255, 0, 0, 255}, {0, 255, 0, 255}});
constexpr const char* nearest = R"({"magFilter":9728})";

/// Random numbers that are not random.
struct NearlyOne {
    template <class Number>
    [[nodiscard]] Number next() {
        return Number(0.99);
    }
};

/// A PNG of 8 bits for red, green, blue and opacity, whose data are zeros, packed 150 to 1. Its checksums are 0, which
/// the decoder does not look at.
///
/// @param bytes  to unpack: height * (4 * width + 1) for a whole image
std::string packed_png(std::uint32_t width, std::uint32_t height, std::size_t bytes) {
    std::string packed = "\x78\x01";
    unsigned bits = 0, count = 0;
    const auto write = [&](const char* code) { // bit by bit, in the order of the stream
        for (; *code != '\0'; ++code) {
            bits |= (*code == '1' ? 1u : 0u) << count;
            if (++count == 8) {
                packed += static_cast<char>(static_cast<unsigned char>(bits));
                bits = count = 0;
            }
        }
    };
    // RFC 1951, section 3.2.6: the last block, with fixed codes; the literal 0; then copies from one byte before.
    write("110");
    std::size_t written = 0;
    for (; written == 0 || written % 258 != bytes % 258; ++written)
        write("00110000");
    for (; written < bytes; written += 258)
        write("1100010100000");
    write("0000000");
    write("0000000"); // fills the last byte
    const auto big_endian = [](std::size_t value) {
        std::string text;
        for (int shift = 24; shift >= 0; shift -= 8)
            text += static_cast<char>(static_cast<unsigned char>(value >> shift & 0xFFu));
        return text;
    };
    const auto chunk = [&](const char* type, const std::string& content) {
        return big_endian(content.size()) + type + content + std::string(4, '\0');
    };
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT", packed + std::string(4, '\0')) + chunk("IEND", "");
}

/// The colour of a square with that image at a point: 'r' or 'g'.
char color_at(const PaintedSquare& square, double x, double z) {
    const auto scene = square.scene();
    return scene.color(hit_below(scene, x, z)).y > 0.5 ? 'g' : 'r';
}

} // namespace

TEST_CASE_TEMPLATE("glTF textures: a receiver has the colour of its texture, times its factor", T, float, double) {
    const std::string png = png_bytes(2, 1, {{255, 0, 0, 255}, {188, 188, 0, 255}});
    const PaintedSquare square(painted_matt(), png);
    const auto scene = square.scene<T>();
    CHECK(length(scene.color(hit_below(scene, -0.5, 0)) - Vec3<T>(T(0.5), 0, 0)) < 1e-5);
    const double grey = 0.502886; // of 188 in sRGB, to six digits
    CHECK(length(scene.color(hit_below(scene, 0.5, 0.3)) - Vec3<T>(T(grey / 2), T(grey), 0)) < 1e-5);
    CHECK(parse(square.file).warnings.empty());
}

TEST_CASE("glTF textures: the camera sees them") {
    const auto scene = PaintedSquare(painted_matt(), red_green, nearest).scene();
    const Camera<double>::Pose above{{0, 2, 0}, {1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
    const auto eye = trace_eye_paths(scene, Camera<double>::orthographic(above, 0.9, 8, 8), {}, SerialExecutor());
    REQUIRE(eye.vertices.size() == 64);
    for (const auto& vertex : eye.vertices) {
        const bool is_left = vertex.position.x < 0;
        CHECK(vertex.weight.x * std::numbers::pi == doctest::Approx(is_left ? 0.5 : 0));
        CHECK(vertex.weight.y * std::numbers::pi == doctest::Approx(is_left ? 0 : 1));
    }
}

TEST_CASE("glTF textures: light through glass and off a mirror has the colour of the texture") {
    NearlyOne sampler; // no reflection: Fresnel's is 0.04
    const std::string texture = R"("roughnessFactor":0,"baseColorTexture":{"index":0}})";
    const auto glass = PaintedSquare(R"({"pbrMetallicRoughness":{"metallicFactor":0,)" + texture +
                                         R"(,"extensions":{"KHR_materials_transmission":{"transmissionFactor":1},)"
                                         R"("KHR_materials_volume":{"thicknessFactor":1}}})",
                                     red_green)
                           .scene();
    const auto mirror =
        PaintedSquare(R"({"pbrMetallicRoughness":{"metallicFactor":1,)" + texture + "}", red_green).scene();
    for (const auto* scene : {&glass, &mirror})
        for (const double x : {-0.5, 0.5}) {
            const auto bounce = scene->scatter(hit_below(*scene, x, 0.2), {0, -1, 0}, sampler);
            CHECK(bounce.event == (scene == &glass ? Event::refract : Event::reflect));
            CHECK(length(bounce.weight - (x < 0 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0))) < 1e-6);
        }
}

TEST_CASE("glTF textures: a material without textures has none to look up") {
    const auto scene = scene_from<float>(parse(caustic_scene())).scene;
    for (const auto& material : scene.materials())
        CHECK(material.textures == nullptr);
}

TEST_CASE("glTF textures: images may be in data URIs, and in files beside with escaped names") {
    const std::string png = png_bytes(1, 1, {{255, 255, 0, 255}});
    PaintedSquare square(painted_matt(), png);
    const TemporaryFolder folder;
    write_bytes(folder / "my map.png", png);
    for (const std::string& uri : {std::string("my%20map.png"), "data:image/png;base64," + base64(png)}) {
        square.file.more = R"(,"images":[{"uri":")" + uri + R"("}],"textures":[{"source":0}])";
        write_bytes(folder / "scene.glb", square.file.glb());
        const auto description = read_gltf(folder / "scene.glb");
        CHECK(description.warnings.empty());
        REQUIRE(description.textures.size() == 1);
        CHECK(description.textures[0]->image.rgba == std::vector<std::uint8_t>{255, 255, 0, 255});
    }
}

TEST_CASE("glTF textures: what cannot be read is left out, with a warning that names the value") {
    const std::string png = png_bytes(1, 1, {{255, 255, 0, 255}});
    const auto check_left_out = [&](const std::string& more, const char* why) {
        PaintedSquare square(painted_matt(), png);
        square.file.more = "," + more;
        const auto description = parse(square.file);
        CAPTURE(more);
        CAPTURE(GltfFile::joined(description.warnings));
        CHECK(warns(description, why));
        CHECK(warns(description, "texture 0 is left out"));
        CHECK_FALSE(description.materials.at(0).color_texture.has_value());
    };
    check_left_out(R"("images":[{"uri":"missing.png"}],"textures":[{"source":0}])", "no file 'missing.png'");
    check_left_out(R"("images":[{"uri":"/etc/passwd"}],"textures":[{"source":0}])", "no file '/etc/passwd'");
    check_left_out(R"("images":[{"bufferView":99}],"textures":[{"source":0}])", "buffer view 99");
    check_left_out(R"("images":[{"bufferView":0,"mimeType":"image/webp"}],"textures":[{"source":0}])",
                   "(image/webp) is neither PNG nor JPEG");
    check_left_out(R"("images":[{"uri":"data:image/ktx2;base64,AAAA"}],"textures":[{"source":0}])",
                   "(image/ktx2) is neither PNG nor JPEG");
    check_left_out(R"("images":[{"name":"x"}],"textures":[{"source":0}])", "neither a buffer view nor a uri");
    check_left_out(R"("images":[],"textures":[{"source":0}])", "image 0, but the file has 0");
    check_left_out(R"("textures":[{"source":0}])", "image 0, but the file has 0");
    check_left_out(R"("textures":[{}])", "has no image");
    check_left_out(R"("images":[{"uri":"data:image/png;base64,*"}],"textures":[{"source":0}])", "not base64");
    check_left_out(R"("images":[{"uri":"data:image/png;base64,)" + base64(png.substr(0, 60)) +
                       R"("}],"textures":[{"source":0}])",
                   "can be read");
    check_left_out(R"("textures":[{"extensions":{"KHR_texture_basisu":{"source":0}}}])", "KHR_texture_basisu");
    check_left_out(R"("textures":[{"extensions":{"EXT_texture_webp":{"source":0}}}])", "EXT_texture_webp");
    CHECK(warns(parse(PaintedSquare(painted_matt(R"(,"texCoord":2)"), png).file), "TEXCOORD_2, which is left out"));

    PaintedSquare broken(painted_matt(), png);
    broken.file.more = "";
    check_problem(problem_of(broken.file), "texture 0, but the file has 0");
    // tinygltf would skip these images, and the next one would take their place.
    broken.file.more = R"(,"images":[{},{"uri":"a.png"}],"textures":[{"source":1}])";
    check_problem(problem_of(broken.file), "images cannot be told apart: 2 objects, 1 read");
    broken.file.more = R"(,"images":[{"uri":"a.png"}],"images":[{"uri":"b.png"}],"textures":[{"source":0}])";
    check_problem(problem_of(broken.file), "images cannot be told apart: 2 objects, 1 read");
    broken.file.more = R"(,"images":[{"uri":"a.png"},5],"textures":[{"source":0}])";
    check_problem(problem_of(broken.file), "images cannot be told apart: 1 objects, 2 read");
    broken.file.more = R"(,"images":[{"uri":"a.png"},null,{"uri":"b.png"}],"textures":[{"source":1}])";
    check_problem(problem_of(broken.file), "image 1 is not an object");
}

TEST_CASE("glTF textures: a Radiance picture is refused, as it would lose its range") {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n";
    const std::string hdr = header + std::string("\x80\x80\x80\x81", 4);
    const auto description = parse(PaintedSquare(painted_matt(), hdr).file);
    CHECK(warns(description, "is neither PNG nor JPEG"));
    CHECK(description.textures.empty());
    const auto* bytes = reinterpret_cast<const unsigned char*>(hdr.data());
    CHECK_THROWS_WITH_AS(static_cast<void>(decode_image({bytes, hdr.size()})),
                         doctest::Contains("neither PNG nor JPEG"), std::runtime_error);
}

// The image has 24 bytes a pixel, 404 MiB, to ask for while it is decoded. Its file of 0.45 MB allows 256 MiB and
// 109 MiB, and 1 GiB more where 4 MiB are appended, which the decoder does not read.
TEST_CASE("glTF textures: images may be large as far as their files are, inside the scene's or beside it") {
    const std::uint32_t side = 4200;
    const TemporaryFolder folder;
    const auto with_image = [&folder](const std::string& image) {
        PaintedSquare square(painted_matt(), png_bytes(1, 1, {{9, 9, 9, 255}}));
        write_bytes(folder / "large.png", image);
        square.file.more = R"(,"images":[{"uri":"large.png"}],"textures":[{"source":0}])";
        write_bytes(folder / "scene.glb", square.file.glb());
        return read_gltf(folder / "scene.glb");
    };
    const std::string small = packed_png(side, side, std::size_t{side} * (4 * side + 1));
    const auto refused = with_image(small);
    CHECK(warns(refused, "has 17640000 pixels in " + std::to_string(small.size()) + " bytes"));
    CHECK(refused.textures.empty());
    const auto read = with_image(small + std::string(std::size_t{4} << 20, '\0'));
    CHECK(read.warnings.empty());
    REQUIRE(read.textures.size() == 1);
    CHECK(read.textures[0]->image.rgba.size() == std::size_t{4} * side * side);
}

TEST_CASE("glTF textures: an image whose data unpack to far more than its pixels is refused") {
    const auto description = parse(PaintedSquare(painted_matt(), packed_png(1, 1, std::size_t{64} << 20)).file);
    CHECK(warns(description, "unpacks to far more than its 1 x 1 pixels need"));
    CHECK(description.textures.empty());
    CHECK(parse(PaintedSquare(painted_matt(), packed_png(1, 1, 5)).file).warnings.empty());
}

TEST_CASE("glTF textures: those of roughness, emission and thickness are named as not read") {
    const auto description =
        parse(PaintedSquare(
                  R"({"pbrMetallicRoughness":{"metallicRoughnessTexture":{"index":0}},"emissiveTexture":{"index":0},)"
                  R"("extensions":{"KHR_materials_volume":{"thicknessFactor":1,"thicknessTexture":{"index":0}}}})",
                  red_green)
                  .file);
    CHECK(warns(description, "not read, only their factors: metallicRoughnessTexture, emissiveTexture, "
                             "thicknessTexture"));
}

TEST_CASE("glTF textures: samplers say how they wrap, and unknown modes are warned of by their number") {
    const std::string further = R"(,"extensions":{"KHR_texture_transform":{"scale":[2,1]}})";
    // At x = 0.4 the first coordinate is 1.4: 0.4 repeated, 0.6 mirrored, 1 clamped. At x = -0.9 it is 0.1.
    const auto at = [&](const char* sampler, double x) {
        return color_at(PaintedSquare(painted_matt(further), red_green, sampler), x, 0);
    };
    CHECK(at(R"({"magFilter":9728,"wrapS":10497})", 0.4) == 'r');
    CHECK(at(R"({"magFilter":9728,"wrapS":33648})", 0.4) == 'g');
    CHECK(at(R"({"magFilter":9728,"wrapS":33071})", 0.8) == 'g');
    CHECK(at(R"({"magFilter":9728,"wrapS":33648})", 0.8) == 'r');
    CHECK(at(R"({"magFilter":9728,"wrapT":33071})", 0.4) == 'r'); // wrapS is repeat, when it is missing
    for (const char* sampler : {R"({"wrapS":33069})", R"({"wrapT":33069})"})
        CHECK(warns(parse(PaintedSquare(painted_matt(), red_green, sampler).file), "of 33069, taken for 10497"));
    CHECK(warns(parse(PaintedSquare(painted_matt(), red_green, R"({"magFilter":9987})").file),
                "magFilter of 9987, taken for 9729"));
}

// A quarter turn takes (u, v) to (v, -u): what lies below on the square then shows what is on the right in the image.
// The extension's GLSL has the transpose; its text, its example and its test model have this.
TEST_CASE("glTF textures: coordinates are scaled, turned and moved as KHR_texture_transform says") {
    const auto shown = [&](const std::string& transform, double x, double z) {
        return color_at(PaintedSquare(painted_matt(R"(,"extensions":{"KHR_texture_transform":{)" + transform + "}}"),
                                      red_green, nearest),
                        x, z);
    };
    CHECK(shown("", -0.5, 0) == 'r');
    CHECK(shown(R"("offset":[0.5,0])", -0.5, 0) == 'g');
    CHECK(shown(R"("scale":[2,1])", -0.4, 0) == 'g'); // u = 0.3 becomes 0.6
    CHECK(shown(R"("scale":[2,1])", 0.4, 0) == 'r');  // 0.7 becomes 1.4, repeated 0.4
    const std::string quarter = R"("rotation":)" + json_number(std::numbers::pi / 2);
    CHECK(shown(quarter, -0.9, 0.5) == 'g');
    CHECK(shown(quarter, -0.9, -0.5) == 'r');
    CHECK(shown(quarter, 0.9, 0.5) == 'g');

    // The extension's example shows "only the lower left quadrant of the source image".
    const std::string quadrants =
        png_bytes(2, 2, {{255, 0, 0, 255}, {255, 0, 0, 255}, {0, 255, 0, 255}, {255, 0, 0, 255}});
    const PaintedSquare example(
        painted_matt(R"(,"extensions":{"KHR_texture_transform":{"offset":[0,1],"scale":[0.5,0.5],)" + quarter + "}}"),
        quadrants, nearest);
    for (const double x : {-0.9, 0.1, 0.9})
        for (const double z : {-0.9, 0.1, 0.9})
            CHECK(color_at(example, x, z) == 'g');
}

TEST_CASE("glTF textures: a transform that is not made of numbers is refused by name") {
    const auto problem = [&](const std::string& transform) {
        return problem_of(
            PaintedSquare(painted_matt(R"(,"extensions":{"KHR_texture_transform":{)" + transform + "}}"), red_green)
                .file);
    };
    check_problem(problem(R"("offset":[1])"), "offset is not 2 numbers");
    check_problem(problem(R"("scale":["a",1])"), "scale is not 2 numbers");
    check_problem(problem(R"("rotation":"x")"), "rotation is not 1 number");
    CHECK(problem(R"("rotation":1)").empty());
}

TEST_CASE("glTF textures: either set of coordinates may be used, of any component type") {
    // The second set is turned around: its left is the right of the first.
    const auto square = [&](const std::string& more) {
        PaintedSquare painted(painted_matt(more), red_green, nearest);
        const std::vector<std::uint16_t> uv{65535, 65535, 65535, 0, 0, 0, 0, 65535};
        const std::size_t second = painted.file.add_accessor(painted.file.add_view(GltfFile::bytes_of(uv)), 5123, 4,
                                                             "VEC2", R"(,"normalized":true)");
        painted.show(R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":2,"TEXCOORD_1":)" + std::to_string(second));
        return painted;
    };
    CHECK(color_at(square(""), -0.5, 0.1) == 'r');
    CHECK(color_at(square(R"(,"texCoord":1)"), -0.5, 0.1) == 'g');
    CHECK(color_at(square(R"(,"extensions":{"KHR_texture_transform":{"texCoord":1}})"), -0.5, 0.1) == 'g');
    CHECK(color_at(square(R"(,"texCoord":1,"extensions":{"KHR_texture_transform":{"texCoord":0}})"), -0.5, 0.1) == 'r');
}

TEST_CASE("glTF textures: meshes without coordinates, and broken ones, are told") {
    PaintedSquare square(painted_matt(), red_green);
    square.show(R"("POSITION":0,"NORMAL":1)");
    CHECK(warns(parse(square.file), "has no TEXCOORD_0"));
    CHECK(color_at(square, 0.5, 0) == 'r'); // the image's corner, which is half of each
    square.show(R"("POSITION":0,"NORMAL":1,"TEXCOORD_0":0)");
    check_problem(problem_of(square.file), "VEC2");
    PaintedSquare infinite(painted_matt(), red_green);
    const std::vector<glm::vec2> uv(4, glm::vec2(std::numeric_limits<float>::infinity()));
    const std::size_t bad = infinite.file.add_accessor(infinite.file.add_view(GltfFile::bytes_of(uv)), 5126, 4, "VEC2");
    infinite.show(R"("POSITION":0,"TEXCOORD_0":)" + std::to_string(bad));
    check_problem(problem_of(infinite.file), "TEXCOORD_0 that is not finite");
    PaintedSquare colored(painted_matt(), red_green);
    colored.show(R"("POSITION":0,"TEXCOORD_0":2,"COLOR_0":1)");
    CHECK(warns(parse(colored.file), "vertex colours (COLOR_0), which are not read"));
}

TEST_CASE("glTF textures: opacity and transmission change from texel to texel") {
    const std::string png = png_bytes(2, 1, {{255, 255, 255, 0}, {51, 255, 255, 204}});
    const auto scene_with = [&](const std::string& alpha) {
        return PaintedSquare(
                   R"({"pbrMetallicRoughness":{"metallicFactor":0,"baseColorTexture":{"index":0}},)" + alpha + "}", png)
            .scene();
    };
    const auto blended = scene_with(R"("alphaMode":"BLEND")");
    CHECK(blended.coverage(hit_below(blended, -0.5, 0)) == doctest::Approx(0));
    CHECK(blended.coverage(hit_below(blended, 0.5, 0)) == doctest::Approx(0.8));
    CHECK(blended.materials()[0].is_mixture());
    for (const auto& [cutoff, left, right] : {std::array{0.6, 0.0, 1.0}, {0.9, 0.0, 0.0}, {0.0, 1.0, 1.0}}) {
        const auto masked = scene_with(R"("alphaMode":"MASK","alphaCutoff":)" + json_number(cutoff));
        CHECK(masked.coverage(hit_below(masked, -0.5, 0)) == left);
        CHECK(masked.coverage(hit_below(masked, 0.5, 0)) == right);
    }
    const auto opaque = scene_with(R"("alphaMode":"OPAQUE")");
    CHECK(opaque.coverage(hit_below(opaque, -0.5, 0)) == 1);
    CHECK_FALSE(opaque.materials()[0].is_mixture());

    const auto partly =
        PaintedSquare(R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":)"
                      R"({"KHR_materials_volume":{"thicknessFactor":1},"KHR_materials_transmission":)"
                      R"({"transmissionFactor":0.5,"transmissionTexture":{"index":0}}}})",
                      png)
            .scene();
    CHECK(partly.transmission(hit_below(partly, -0.5, 0)) == doctest::Approx(0.5));
    CHECK(partly.transmission(hit_below(partly, 0.5, 0)) == doctest::Approx(0.1));
    CHECK(partly.materials()[0].is_mixture());
}

} // namespace nephroid::examples::gltf_texture_test
