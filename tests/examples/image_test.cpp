// SPDX-License-Identifier: MIT
#include "common/image/exr.hpp"
#include "common/image/file.hpp"
#include "common/image/image.hpp"
#include "common/image/pfm.hpp"
#include "common/image/png.hpp"
#include "common/image/write.hpp"
#include "support/temporary_folder.hpp"

#include <doctest/doctest.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#if defined(__unix__) || defined(__APPLE__)
#define NEPHROID_TESTS_HAVE_POSIX
#include <sys/resource.h>

#include <csignal>
#include <unistd.h>
#endif

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#elif defined(_MSC_VER)
#pragma warning(push, 0)
#endif
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif
#if defined(NEPHROID_EXAMPLES_HAS_OPENEXR)
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#elif defined(_MSC_VER)
#pragma warning(pop)
#endif

namespace nephroid::examples::image_test {

namespace fs = std::filesystem;

namespace {

std::string bytes_of(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void put(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/// The message of what a call throws, or nothing.
template <class Call>
std::string message_of(Call call) {
    try {
        call();
    } catch (const std::exception& error) {
        return error.what();
    }
    return {};
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Values that any conversion on the way would change: signs of zero, the ends of the range, neighbours of 1.
const std::vector<float> hard_values{0.0f,
                                     -0.0f,
                                     1.0f,
                                     std::numeric_limits<float>::denorm_min(),
                                     std::numeric_limits<float>::max(),
                                     std::numeric_limits<float>::lowest(),
                                     1 + std::numeric_limits<float>::epsilon(),
                                     0.1f,
                                     -65536.5f,
                                     1e-30f,
                                     3e10f,
                                     12345.678f};

/// Equality of bits, which tells -0 from 0.
bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](float x, float y) {
        return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    });
}

struct DecodedPng {
    int width = 0, height = 0, channels = 0;
    std::vector<int> values; // top row first
};

DecodedPng decode_png(const fs::path& path) {
    DecodedPng result;
    unsigned char* const data = stbi_load(path.string().c_str(), &result.width, &result.height, &result.channels, 0);
    if (data)
        result.values.assign(data, data + result.width * result.height * result.channels);
    stbi_image_free(data);
    return result;
}

} // namespace

static_assert(ColourPixel<Rgb> && ColourPixel<std::array<double, 3>> && ColourPixel<glm::vec3>);
static_assert(!ColourPixel<std::array<double, 2>> && !ColourPixel<float> && !GreyPixel<int>);

TEST_CASE("Image: row 0 comes first in memory, and grey, double and colour images turn into samples") {
    Image<double> grey(3, 2, 0.5);
    grey(2, 1) = 7;
    CHECK(grey.pixels == std::vector<double>{0.5, 0.5, 0.5, 0.5, 0.5, 7});
    const Samples grey_samples = grey;
    CHECK(grey_samples.channels == 1);
    CHECK(grey_samples.samples == std::vector<float>{0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 7});

    Image<Rgb> colour(1, 2);
    colour(0, 1) = {1, 2, 3};
    const Samples colour_samples = colour;
    CHECK(colour_samples.width == 1);
    CHECK(colour_samples.height == 2);
    CHECK(colour_samples.channels == 3);
    CHECK(colour_samples.samples == std::vector<float>{0, 0, 0, 1, 2, 3});
    CHECK(Samples(Image<glm::vec3>(1, 1, {1, 2, 3})).samples == std::vector<float>{1, 2, 3});
}

TEST_CASE("write_pfm: a grey file is, byte for byte, header, bottom row, top row, little endian") {
    const nephroid::tests::TemporaryFolder folder;
    Image<float> image(2, 2);
    image(0, 0) = 1;    // 0x3f800000
    image(1, 0) = -2;   // 0xc0000000
    image(0, 1) = 0.5f; // 0x3f000000
    write_pfm(folder / "a.pfm", image);
    const std::string expected("Pf\n2 2\n-1.0\n"
                               "\x00\x00\x80\x3f"
                               "\x00\x00\x00\xc0"
                               "\x00\x00\x00\x3f"
                               "\x00\x00\x00\x00",
                               12 + 16);
    CHECK(bytes_of(folder / "a.pfm") == expected);
    CHECK(folder.names() == std::vector<std::string>{"a.pfm"});
}

TEST_CASE("write_pfm: a colour file starts with PF and interleaves red, green, blue") {
    const nephroid::tests::TemporaryFolder folder;
    write_pfm(folder / "a.pfm", Image<Rgb>(1, 1, {1, -2, 0.5f}));
    const std::string expected("PF\n1 1\n-1.0\n"
                               "\x00\x00\x80\x3f"
                               "\x00\x00\x00\xc0"
                               "\x00\x00\x00\x3f",
                               12 + 12);
    CHECK(bytes_of(folder / "a.pfm") == expected);
}

TEST_CASE("read_pfm: gives back every bit that write_pfm was given, grey and colour") {
    const nephroid::tests::TemporaryFolder folder;
    for (const Samples& image : {Samples(4, 3, 1, hard_values), Samples(2, 2, 3, hard_values)}) {
        write_pfm(folder / "a.pfm", image);
        const Samples read = read_pfm(folder / "a.pfm");
        CHECK(read.width == image.width);
        CHECK(read.height == image.height);
        CHECK(read.channels == image.channels);
        CHECK(same_bits(read.samples, image.samples));
    }
}

TEST_CASE("read_pfm: reads big endian files and applies the scale") {
    const nephroid::tests::TemporaryFolder folder;
    put(folder / "big.pfm", std::string("Pf 2 1 1.0\n\x3f\x80\x00\x00\xc0\x00\x00\x00", 11 + 8));
    CHECK(read_pfm(folder / "big.pfm").samples == std::vector<float>{1, -2});
    put(folder / "scaled.pfm", std::string("Pf\n1 1\n-4\n\x00\x00\x80\x3f", 10 + 4));
    CHECK(read_pfm(folder / "scaled.pfm").samples == std::vector<float>{4});
}

TEST_CASE("read_pfm: a file that is no PFM image is refused with its path and what is wrong") {
    const nephroid::tests::TemporaryFolder folder;
    const auto refusal = [&](const std::string& bytes) {
        put(folder / "bad.pfm", bytes);
        const std::string message = message_of([&] { (void)read_pfm(folder / "bad.pfm"); });
        CHECK(contains(message, (folder / "bad.pfm").string()));
        return message;
    };
    CHECK(contains(refusal(""), "no PFM"));
    CHECK(contains(refusal("P6\n1 1\n255\n..."), "no PFM"));
    CHECK(contains(refusal("Pf\n0 1\n-1.0\n"), "width and height"));
    CHECK(contains(refusal("Pf\n-1 1\n-1.0\n"), "width and height"));
    CHECK(contains(refusal("Pf\n4000000000 4000000000\n-1.0\n"), "width and height")); // the product would wrap around
    CHECK(contains(refusal("Pf\n1 1\n0\n...."), "scale"));
    CHECK(contains(refusal("Pf\n1 1\n-1.0"), "scale"));
    CHECK(contains(refusal("Pf\n1 1\n-1.0\n..."), "3 bytes of samples, its header promises 4"));
    CHECK(contains(refusal("Pf\n1 1\n-1.0\n....."), "5 bytes of samples, its header promises 4"));
    CHECK_THROWS_AS((void)read_pfm(folder / "missing.pfm"), std::runtime_error);
    CHECK_THROWS_AS((void)read_pfm(folder / "."), std::runtime_error);
}

TEST_CASE("write_png: encodes by the sRGB curve, exposes, clips, and puts the top row first") {
    const nephroid::tests::TemporaryFolder folder;
    Image<float> grey(3, 2);
    grey.pixels = {-1, 0, 9, 0.25f, 0.5f, 0.09f}; // bottom row, top row
    write_png(folder / "grey.png", grey, 2);
    const DecodedPng read = decode_png(folder / "grey.png");
    CHECK(read.width == 3);
    CHECK(read.height == 2);
    CHECK(read.channels == 1);
    // 255 (1.055 x^(1/2.4) - 0.055) is 187.52 for x = 0.5 and 117.65 for x = 0.18.
    CHECK(read.values == std::vector<int>{188, 255, 118, 0, 0, 255});

    Image<Rgb> colour(1, 2);
    colour(0, 1) = {1, 0.5f, 0.001f}; // 255 * 12.92 * 0.001 = 3.29, on the straight part of the curve
    write_png(folder / "colour.png", colour);
    CHECK(decode_png(folder / "colour.png").channels == 3);
    CHECK(decode_png(folder / "colour.png").values == std::vector<int>{255, 188, 3, 0, 0, 0});
}

TEST_CASE("write_png: a larger picture survives compression and decoding") {
    const nephroid::tests::TemporaryFolder folder;
    Image<float> image(67, 45);
    std::vector<int> expected(67 * 45);
    for (std::size_t y = 0; y < 45; ++y)
        for (std::size_t x = 0; x < 67; ++x) {
            const bool lit = (x * x + 3 * y) % 7 < 3;
            image(x, y) = lit ? 1.0f : 0.0f;
            expected[(44 - y) * 67 + x] = lit ? 255 : 0;
        }
    write_png(folder / "a.png", image);
    CHECK(decode_png(folder / "a.png").values == expected);
}

TEST_CASE("write_png: an exposure that is not positive is refused") {
    const nephroid::tests::TemporaryFolder folder;
    const Image<float> image(1, 1);
    CHECK_THROWS_WITH_AS(write_png(folder / "a.png", image, 0),
                         "write_png: exposure is 0.000000, it must be positive and finite", std::invalid_argument);
    CHECK_THROWS_AS(write_png(folder / "a.png", image, std::numeric_limits<double>::infinity()), std::invalid_argument);
    CHECK(folder.names().empty());
}

#if defined(NEPHROID_EXAMPLES_HAS_OPENEXR)
TEST_CASE("write_exr: OpenEXR reads back every bit, grey as Y and colour as R, G, B, the top row first") {
    const nephroid::tests::TemporaryFolder folder;
    const auto channel_of = [&](const char* name, std::size_t width, std::size_t height) {
        Imf::InputFile file((folder / "a.exr").string().c_str());
        CHECK(file.header().dataWindow().max.x == static_cast<int>(width) - 1);
        CHECK(file.header().dataWindow().max.y == static_cast<int>(height) - 1);
        const Imf::Channel* const channel = file.header().channels().findChannel(name);
        REQUIRE(channel != nullptr);
        CHECK(channel->type == Imf::FLOAT);
        std::vector<float> values(width * height);
        Imf::FrameBuffer frame;
        frame.insert(
            name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), sizeof(float), width * sizeof(float)));
        file.setFrameBuffer(frame);
        file.readPixels(0, static_cast<int>(height) - 1);
        return values;
    };
    const auto expected_of = [](std::size_t channel, std::size_t channels, std::size_t width, std::size_t height) {
        std::vector<float> expected;
        for (std::size_t y = height; y-- > 0;)
            for (std::size_t x = 0; x < width; ++x)
                expected.push_back(hard_values[(y * width + x) * channels + channel]);
        return expected;
    };

    write_exr(folder / "a.exr", Samples(4, 3, 1, hard_values));
    CHECK(same_bits(channel_of("Y", 4, 3), expected_of(0, 1, 4, 3)));

    write_exr(folder / "a.exr", Samples(2, 2, 3, hard_values));
    CHECK(same_bits(channel_of("R", 2, 2), expected_of(0, 3, 2, 2)));
    CHECK(same_bits(channel_of("G", 2, 2), expected_of(1, 3, 2, 2)));
    CHECK(same_bits(channel_of("B", 2, 2), expected_of(2, 3, 2, 2)));

    const Samples colour(2, 2, 3, hard_values);
    write_exr_layers(folder / "a.exr", {{"", colour}, {"glow", colour}, {"glow.variance", Image<float>(2, 2, 0.5f)}});
    CHECK(same_bits(channel_of("G", 2, 2), expected_of(1, 3, 2, 2)));
    CHECK(same_bits(channel_of("glow.B", 2, 2), expected_of(2, 3, 2, 2)));
    CHECK(same_bits(channel_of("glow.variance.Y", 2, 2), std::vector<float>(4, 0.5f)));
    CHECK_THROWS_AS(write_exr_layers(folder / "b.exr", {}), std::invalid_argument);
    CHECK(contains(message_of([&] {
                       write_exr_layers(folder / "b.exr", {{"", colour}, {"wide", Image<float>(3, 2)}});
                   }),
                   "layer 'wide' has another size"));
    CHECK(folder.names() == std::vector<std::string>{"a.exr"});
}
#else
TEST_CASE("write_exr: a build without OpenEXR says so") {
    const nephroid::tests::TemporaryFolder folder;
    CHECK(contains(message_of([&] { write_exr(folder / "a.exr", Image<float>(1, 1)); }), "built without OpenEXR"));
    CHECK(contains(message_of([&] { require_writable_image(folder / "a.exr"); }), "built without OpenEXR"));
    CHECK(folder.names().empty());
}
#endif

TEST_CASE("write_image: the extension chooses the format, in either case") {
    const nephroid::tests::TemporaryFolder folder;
    const Image<float> image(2, 2, 0.5f);
    write_image(folder / "a.pfm", image);
    write_image(folder / "b.PNG", image, 2);
    CHECK(bytes_of(folder / "a.pfm").substr(0, 3) == "Pf\n");
    CHECK(decode_png(folder / "b.PNG").values == std::vector<int>(4, 255));
    if (has_openexr()) {
        write_image(folder / "c.exr", image);
        CHECK(bytes_of(folder / "c.exr").substr(0, 4) == "\x76\x2f\x31\x01"); // OpenEXR's magic number
    }
}

TEST_CASE("write_image: another extension is refused by its name, before and after the render") {
    const nephroid::tests::TemporaryFolder folder;
    const Image<float> image(2, 2, 0.5f);
    for (const auto& [name, complaint] : {std::pair{"a.jpg", "unknown extension '.jpg'"},
                                          std::pair{"a", "it has no extension"}, std::pair{"a.pfm.gz", "'.gz'"}}) {
        const fs::path path = folder / name;
        CHECK_THROWS_AS(write_image(path, image), std::invalid_argument);
        CHECK(contains(message_of([&] { write_image(path, image); }), complaint));
        CHECK(contains(message_of([&] { require_writable_image(path); }), complaint));
    }
    CHECK(folder.names().empty());
}

TEST_CASE("write_image: an image that is empty, misshapen or not finite is refused and leaves no file") {
    const nephroid::tests::TemporaryFolder folder;
    Image<Rgb> image(3, 2);
    image(1, 1) = {0, std::numeric_limits<float>::quiet_NaN(), 0};
    for (const char* const name : {"a.pfm", "a.png", has_openexr() ? "a.exr" : "b.pfm"}) {
        const fs::path path = folder / name;
        CHECK_THROWS_AS(write_image(path, image), std::invalid_argument);
        CHECK(contains(message_of([&] { write_image(path, image); }),
                       ": pixel (1, 1), counted from the bottom left, is nan, every pixel must be finite"));
        CHECK(contains(message_of([&] { write_image(path, Image<float>()); }), "empty, 0 x 0 pixels"));
        CHECK(contains(message_of([&] { write_image(path, Samples(2, 2, 1, {1, 2, 3})); }), "3 samples"));
        CHECK(contains(message_of([&] { write_image(path, Samples(1, 1, 2, {1, 2})); }), "2 channels"));
        CHECK(contains(message_of([&] { write_image(path, Image<double>(1, 1, 1e300)); }), "inf")); // beyond float
    }
    CHECK(folder.names().empty());
}

TEST_CASE("write_image: what cannot be written is refused with its path and the reason, also up front") {
    const nephroid::tests::TemporaryFolder folder;
    const Image<float> image(2, 2, 0.5f);
    fs::create_directory(folder / "folder.pfm");
    for (const char* const name : {"missing/a.pfm", "folder.pfm"}) {
        const fs::path path = folder / name;
        CHECK_THROWS_AS(write_image(path, image), std::runtime_error);
        CHECK_THROWS_AS(require_writable_image(path), std::runtime_error);
        const std::string message = message_of([&] { write_image(path, image); });
        CHECK(contains(message, "cannot write '" + path.string() + "': "));
        CHECK(message == message_of([&] { require_writable_image(path); }));
        CHECK(!contains(message, "\n"));
    }
    CHECK_THROWS_AS(require_writable(""), std::runtime_error);
    CHECK_THROWS_AS(require_writable(folder / ""), std::runtime_error);
    CHECK(folder.names() == std::vector<std::string>{"folder.pfm"});
}

TEST_CASE("require_writable: creates nothing, changes nothing") {
    const nephroid::tests::TemporaryFolder folder;
    require_writable(folder / "new.pfm");
    CHECK(folder.names().empty());

    put(folder / "old.pfm", "old");
    const fs::file_time_type before = fs::last_write_time(folder / "old.pfm");
    require_writable(folder / "old.pfm");
    CHECK(bytes_of(folder / "old.pfm") == "old");
    CHECK(fs::last_write_time(folder / "old.pfm") == before);
    CHECK(folder.names() == std::vector<std::string>{"old.pfm"});
}

TEST_CASE("write_file: replaces an old file whole, a longer one too") {
    const nephroid::tests::TemporaryFolder folder;
    put(folder / "a", "a longer old file");
    write_file(folder / "a", "new");
    CHECK(bytes_of(folder / "a") == "new");
    CHECK(folder.names() == std::vector<std::string>{"a"});
}

TEST_CASE("write_file: a path relative to the current folder works") {
    const nephroid::tests::TemporaryFolder folder;
    const fs::path before = fs::current_path();
    fs::current_path(folder / "");
    write_file("a", "new");
    fs::current_path(before);
    CHECK(bytes_of(folder / "a") == "new");
}

#if defined(NEPHROID_TESTS_HAVE_POSIX)

// The limit on a file's size stands in for a full disk: write() fails in the same way, with another errno.
TEST_CASE("write_image: when the disk takes only part of the file, the old one stays and nothing else is left") {
    const nephroid::tests::TemporaryFolder folder;
    put(folder / "a.pfm", "old");
    const Image<float> image(256, 256, 0.5f); // 256 kB

    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = before;
    limit.rlim_cur = 100 * 1024;
    REQUIRE(setrlimit(RLIMIT_FSIZE, &limit) == 0);
    const std::string over_old = message_of([&] { write_image(folder / "a.pfm", image); });
    const std::string over_none = message_of([&] { write_image(folder / "b.pfm", image); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);

    CHECK(contains(over_old, "cannot write '" + (folder / "a.pfm").string() + "': "));
    CHECK(contains(over_none, "cannot write '" + (folder / "b.pfm").string() + "': "));
    CHECK(bytes_of(folder / "a.pfm") == "old");
    CHECK(folder.names() == std::vector<std::string>{"a.pfm"});
}

TEST_CASE("write_file: follows symbolic links, to files that exist or not") {
    const nephroid::tests::TemporaryFolder folder;
    put(folder / "file", "old");
    fs::create_symlink("file", folder / "link");
    fs::create_symlink("link", folder / "link to link");
    fs::create_symlink("new", folder / "dangling");
    write_file(folder / "link to link", "changed");
    write_file(folder / "dangling", "created");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(fs::is_symlink(folder / "link to link"));
    CHECK(bytes_of(folder / "file") == "changed");
    CHECK(bytes_of(folder / "new") == "created");

    fs::create_symlink("loop", folder / "loop");
    CHECK(contains(message_of([&] { write_file(folder / "loop", "x"); }), "too many symbolic links"));
}

TEST_CASE("write_file: never replaces a device") {
    CHECK(contains(message_of([] { write_file("/dev/null", "x"); }), "'/dev/null': it is not a regular file"));
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("write_file: a file or folder without permission to write is refused and unchanged") {
    if (geteuid() == 0)
        return; // permissions do not bind root
    const nephroid::tests::TemporaryFolder folder;
    put(folder / "a", "old");
    fs::permissions(folder / "a", fs::perms::owner_read);
    CHECK_THROWS_AS(write_file(folder / "a", "new"), std::runtime_error);
    CHECK_THROWS_AS(require_writable(folder / "a"), std::runtime_error);
    CHECK(bytes_of(folder / "a") == "old");

    fs::permissions(folder / ".", fs::perms::owner_read | fs::perms::owner_exec);
    CHECK_THROWS_AS(write_file(folder / "b", "new"), std::runtime_error);
    fs::permissions(folder / ".", fs::perms::owner_all);
    CHECK(folder.names() == std::vector<std::string>{"a"});
}

#endif

} // namespace nephroid::examples::image_test
