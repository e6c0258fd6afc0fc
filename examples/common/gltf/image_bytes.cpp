// SPDX-License-Identifier: MIT
#include "common/gltf/image_bytes.hpp"

#include "common/gltf/accessor.hpp"
#include "common/gltf/report.hpp"

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace nephroid::examples::gltf {
namespace {

namespace fs = std::filesystem;

std::vector<unsigned char> from_base64(std::string_view text) {
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> bytes;
    unsigned bits = 0, count = 0;
    for (const char c : text) {
        if (c == '=')
            break;
        const std::size_t digit = digits.find(c);
        if (digit == std::string_view::npos)
            fail({"its data URI is not base64"});
        bits = bits << 6 | static_cast<unsigned>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<unsigned char>(bits >> count & 0xFFu));
        }
    }
    return bytes;
}

/// A URI with its percent escapes decoded.
std::string decoded(std::string_view uri) {
    const auto digit = [](char c) {
        constexpr std::string_view digits = "0123456789abcdefABCDEF";
        const std::size_t place = digits.find(c);
        return place == std::string_view::npos ? -1 : static_cast<int>(place < 16 ? place : place - 6);
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
            path += static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

ImageBytes bytes_of_file(const fs::path& folder, std::string_view uri) {
    const std::string name = decoded(uri);
    const fs::path path = folder / name;
    std::error_code error;
    if (fs::path(name).is_absolute() || !fs::is_regular_file(path, error))
        fail({"there is no file '", one_line(name), "' beside the scene's"});
    constexpr std::uintmax_t most = std::uintmax_t{1} << 28;
    const std::uintmax_t size = fs::file_size(path, error);
    if (error || size > most)
        fail({"'", one_line(name), "' ", error ? "cannot be read" : "is larger than 256 MiB"});
    std::ifstream file(path, std::ios::binary);
    if (!file)
        fail({"'", one_line(name), "' cannot be read"});
    return {{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()},
            std::string(uri),
            fs::path(name).lexically_normal()};
}

std::string text_in(const tinygltf::Value& object, const char* name) {
    return object.IsObject() && object.Has(name) && object.Get(name).IsString() ? object.Get(name).Get<std::string>()
                                                                                : std::string();
}
} // namespace

std::size_t image_count(const tinygltf::Model& model) {
    return model.extras.IsArray() ? model.extras.ArrayLen() : std::size_t{0};
}

ImageBytes bytes_of_image(const tinygltf::Model& model, std::size_t image, const fs::path& folder) {
    const tinygltf::Value& description = model.extras.Get<tinygltf::Value::Array>()[image];
    const std::string uri = text_in(description, "uri"), type = text_in(description, "mimeType");
    if (description.IsObject() && description.Has("bufferView") && description.Get("bufferView").IsInt())
        return {bytes_of_view(model, description.Get("bufferView").GetNumberAsInt(), "its image"), type};
    if (uri.empty())
        fail({"its image has neither a buffer view nor a uri"});
    if (uri.rfind("data:", 0) != 0)
        return bytes_of_file(folder, uri);
    const std::size_t comma = uri.find(";base64,");
    if (comma == std::string::npos)
        fail({"its data URI is not base64"});
    return {from_base64(std::string_view(uri).substr(comma + 8)), type.empty() ? uri.substr(5, comma - 5) : type};
}

} // namespace nephroid::examples::gltf
