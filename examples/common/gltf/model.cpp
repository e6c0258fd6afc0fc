// SPDX-License-Identifier: MIT
#include "common/gltf/model.hpp"

#include "common/gltf/image_bytes.hpp"
#include "common/gltf/json.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace nephroid::examples::gltf {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> read_extensions{
    "KHR_lights_punctual",   "KHR_mesh_quantization",    "KHR_materials_transmission",      "KHR_materials_ior",
    "KHR_materials_volume",  "KHR_materials_dispersion", "KHR_materials_emissive_strength", "EXT_mesh_gpu_instancing",
    "KHR_texture_transform",
};

/// These extensions are about how images are stored. Materials that use such an image do without it, with a warning.
constexpr std::array<std::string_view, 4> image_extensions{"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif",
                                                           "MSFT_texture_dds"};

bool is_read(std::string_view extension) {
    return std::find(read_extensions.begin(), read_extensions.end(), extension) != read_extensions.end() ||
           std::find(image_extensions.begin(), image_extensions.end(), extension) != image_extensions.end();
}

// The container ------------------------------------------------------------------------------------------------------

constexpr std::size_t header_size = 12;
constexpr std::size_t chunk_header_size = 8;

std::size_t u32_at(const std::vector<unsigned char>& bytes, std::size_t offset) {
    std::size_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | bytes[offset + i];
    return value;
}

void set_u32(std::vector<unsigned char>& bytes, std::size_t offset, std::size_t value) {
    for (std::size_t i = 0; i < 4; ++i)
        bytes[offset + i] = static_cast<unsigned char>(value >> 8 * i);
}

bool is_glb(std::span<const unsigned char> bytes) {
    constexpr std::string_view magic = "glTF";
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

/// A chunk of a .glb, which is known to end within the file.
struct Chunk {
    std::size_t offset = 0; ///< of its content
    std::size_t size = 0;
    std::size_t type = 0;
};

Chunk chunk_at(const std::vector<unsigned char>& bytes, std::size_t offset, std::size_t end) {
    if (end - offset < chunk_header_size)
        fail({"broken .glb: it ends within the header of a chunk"});
    const Chunk chunk{offset + chunk_header_size, u32_at(bytes, offset), u32_at(bytes, offset + 4)};
    if (chunk.size > end - chunk.offset)
        fail({"truncated .glb: a chunk of ", std::to_string(chunk.size), " bytes, but ",
              std::to_string(end - chunk.offset), " are left"});
    if (chunk.size % 4 != 0)
        fail({"broken .glb: a chunk of ", std::to_string(chunk.size), " bytes, not a multiple of 4"});
    return chunk;
}

/// Checks the chunks, and removes those that tinygltf cannot read: an empty binary chunk, and chunks of other types.
///
/// @return  the chunk of the JSON
Chunk prepare_glb(std::vector<unsigned char>& bytes) {
    if (bytes.size() < header_size + chunk_header_size)
        fail({"truncated .glb: ", std::to_string(bytes.size()), " bytes are less than its header"});
    if (const std::size_t version = u32_at(bytes, 4); version != 2)
        fail({"binary glTF of version ", std::to_string(version), "; only version 2 can be read"});
    const std::size_t end = u32_at(bytes, 8);
    if (end > bytes.size())
        fail({"truncated .glb: its header says ", std::to_string(end), " bytes, but there are ",
              std::to_string(bytes.size())});
    if (end < header_size + chunk_header_size)
        fail({"broken .glb: its header says ", std::to_string(end), " bytes, less than the header itself"});

    constexpr std::size_t json_type = 0x4E4F534A;
    constexpr std::size_t binary_type = 0x004E4942;
    const Chunk json = chunk_at(bytes, header_size, end);
    if (json.type != json_type)
        fail({"broken .glb: its first chunk is not JSON"});

    std::size_t used = json.offset + json.size;
    if (used < end) {
        const Chunk binary = chunk_at(bytes, used, end);
        if (binary.type == binary_type && binary.size > 0)
            used = binary.offset + binary.size;
    }
    bytes.resize(used);
    set_u32(bytes, 8, used);
    return json;
}

// The buffers that are files of their own ----------------------------------------------------------------------------

struct BufferFiles {
    std::string folder;                                  ///< ends with a slash
    std::uintmax_t bytes_left = std::uintmax_t{1} << 32; ///< a file can be named again and again
};

bool exists(const std::string& path, void* user) {
    const auto& files = *static_cast<const BufferFiles*>(user);
    std::error_code error;
    const bool beside = path.compare(0, files.folder.size(), files.folder) == 0; // tinygltf tries "." as well
    return beside && fs::is_regular_file(path, error);
}

std::string unexpanded(const std::string& path, void*) { return path; }

bool read_whole(std::vector<unsigned char>* out, std::string* error, const std::string& path, void* user) {
    auto& files = *static_cast<BufferFiles*>(user);
    std::error_code code;
    const std::uintmax_t size = fs::file_size(path, code);
    if (code || size > files.bytes_left) {
        *error += code ? code.message() : "the buffers are more than 4 GiB";
        return false;
    }
    files.bytes_left -= size;
    out->resize(static_cast<std::size_t>(size));
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(out->data()), static_cast<std::streamsize>(size));
    if (!file)
        *error += "it cannot be read";
    return static_cast<bool>(file);
}

bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }

[[maybe_unused]] bool size_of(std::size_t* bytes, std::string* error, const std::string& path, void*) {
    std::error_code code;
    const std::uintmax_t size = fs::file_size(path, code);
    if (code) {
        *error += code.message();
        return false;
    }
    *bytes = static_cast<std::size_t>(size);
    return true;
}

/// tinygltf asks for a file's size since 2.8.10; its header does not state a version.
template <class Callbacks>
Callbacks reading_callbacks(BufferFiles& files) {
    Callbacks callbacks{};
    callbacks.FileExists = &exists;
    callbacks.ExpandFilePath = &unexpanded;
    callbacks.ReadWholeFile = &read_whole;
    callbacks.WriteWholeFile = &write_nothing;
    if constexpr (requires { callbacks.GetFileSizeInBytes; })
        callbacks.GetFileSizeInBytes = &size_of;
    callbacks.user_data = &files;
    return callbacks;
}

bool skip_image(tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) {
    return true;
}

// ---------------------------------------------------------------------------------------------------------------------

void check_version(const tinygltf::Asset& asset) {
    const std::string_view version = asset.minVersion.empty() ? asset.version : asset.minVersion;
    if (version != "2" && version.substr(0, 2) != "2.")
        fail({"glTF of version \"", version, "\"; only version 2 can be read"});
    if (!asset.minVersion.empty() && asset.minVersion != "2.0")
        fail({"it needs a reader for glTF ", version, "; this one reads 2.0"});
}

void check_extensions(const JsonSurvey& survey, Warnings& warnings) {
    for (const std::string& extension : survey.required_extensions)
        if (!is_read(extension))
            fail({"it requires the extension ", one_line(extension), ", which is not read; export it without"});
    for (const std::string& extension : survey.used_extensions)
        if (!is_read(extension))
            warnings.add("the extension " + one_line(extension) + " is not read");
}
} // namespace

tinygltf::Model load_model(std::span<const unsigned char> file, const std::filesystem::path& folder,
                           Warnings& warnings) {
    if (file.size() > std::numeric_limits<std::uint32_t>::max())
        fail({"more than 4 GiB, which tinygltf does not read"});
    std::vector<unsigned char> bytes(file.begin(), file.end());
    const bool binary = is_glb(bytes);
    if (!binary) {
        constexpr std::array<unsigned char, 3> byte_order_mark{0xEF, 0xBB, 0xBF};
        if (bytes.size() >= 3 && std::equal(byte_order_mark.begin(), byte_order_mark.end(), bytes.begin()))
            bytes.erase(bytes.begin(), bytes.begin() + 3);
        const auto first = std::find_if(bytes.begin(), bytes.end(), [](int c) { return c > ' '; });
        if (first == bytes.end() || *first != '{')
            fail({bytes.empty() ? "an empty file, " : "", "not glTF: neither a .glb nor JSON"});
    }

    const Chunk json = binary ? prepare_glb(bytes) : Chunk{0, bytes.size(), 0};
    char* const text = reinterpret_cast<char*>(bytes.data() + json.offset);
    const JsonSurvey survey = prepare_json({text, json.size});
    check_extensions(survey, warnings); // what is not read may well be the reason for what follows
    if (survey.has_animations)
        warnings.add("animations are not read; the scene is as its nodes stand");
    if (survey.buffers_without_uri > 1)
        fail({std::to_string(survey.buffers_without_uri), " buffers without a uri; at most the first may be without"});

    BufferFiles files{folder.empty() ? "./" : folder.generic_string()};
    if (files.folder.back() != '/')
        files.folder += '/';
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(&skip_image, nullptr);
    loader.SetFsCallbacks(reading_callbacks<tinygltf::FsCallbacks>(files));

    tinygltf::Model model;
    std::string error, notes;
    const auto size = static_cast<unsigned>(binary ? bytes.size() : json.size);
    bool complete = false;
    try {
        complete = binary ? loader.LoadBinaryFromMemory(&model, &error, &notes, bytes.data(), size, files.folder)
                          : loader.LoadASCIIFromString(&model, &error, &notes, text, size, files.folder);
    } catch (const std::out_of_range&) {
        fail({"a buffer of 0 bytes"}); // tinygltf takes the address of its first byte
    }
    if (!model.asset.version.empty())
        check_version(model.asset);
    if (!complete || !error.empty()) // tinygltf leaves out broken primitives and goes on
        fail({"broken glTF: ", error.empty() ? "tinygltf does not say why" : error});
    if (survey.images != image_count(model)) // tinygltf skips empty ones, which would make others of their indices
        fail({"the file's images cannot be told apart: ", std::to_string(survey.images), " objects, ",
              std::to_string(image_count(model)),
              " read; there must be one list \"images\", of objects that each have a uri or a buffer view"});
    return model;
}

} // namespace nephroid::examples::gltf
